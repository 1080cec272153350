"""The section of a cylinder that a tilted hand meets, and what a tilt leaves of its region."""

import numpy as np
import pytest
import shapely

from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.shipped import open_case
from palmar.models.support import SupportKind
from palmar.studies.tilted_hand import TILTS, tilted_hand, tilted_section

RADIUS = 0.038


@pytest.mark.parametrize(("width", "angle"), [(0.0, 0.2), (0.05, 0.2), (0.05, 0.0)])
def test_the_section_holds_the_cylinder_at_every_height_of_the_hand(width, angle):
    """Points of the cylinder's surface, cut by planes across the hand's normal, seen in the hand."""
    section = shapely.Polygon(tilted_section(RADIUS, width, angle))
    around, along = np.linspace(0.0, 2.0 * np.pi, 181), np.linspace(-0.5, 0.5, 2001)
    axis = np.array([np.sin(angle), 0.0, np.cos(angle)])
    out = np.array([np.cos(angle), 0.0, -np.sin(angle)])
    circle = RADIUS * (np.cos(around)[:, None] * out + np.sin(around)[:, None] * np.array([0.0, 1.0, 0.0]))
    surface = (circle[:, None, :] + along[:, None] * axis).reshape(-1, 3)
    met = surface[np.abs(surface[:, 2]) <= 0.5 * width + 2.5e-4]
    assert len(met) > 100
    assert shapely.contains_xy(section.buffer(2.5e-4 * np.tan(angle) + 1e-9), met[:, :2]).all()
    assert np.ptp(met[:, 0]) == pytest.approx(section.bounds[2] - section.bounds[0], rel=3e-3, abs=2e-4)
    middle = shapely.Point(0.0, 0.0)
    assert section.exterior.distance(middle) == pytest.approx(RADIUS, rel=1e-9)


def test_a_tilt_leaves_less_of_both_and_a_wide_hand_less_still():
    _, case = open_case("testbed_table")
    thin, wide = tilted_hand(case, 0.0), tilted_hand(case, 0.05)
    assert [each.angle for each in wide] == list(TILTS)
    for found in (thin, wide):
        for name in ("certain", "estimate"):
            values = [getattr(each, name) for each in found]
            assert values == sorted(values, reverse=True) and values[-1] < values[0]
    assert wide[0] == thin[0]
    assert all(w.estimate < t.estimate and w.certain < t.certain for w, t in zip(wide[1:], thin[1:], strict=True))
    assert wide[2].estimate / wide[0].estimate == pytest.approx(0.944, abs=0.01)


def test_it_is_told_of_straight_fingers_and_disks_only():
    _, case = open_case("testbed_table")
    square = ConvexPolygon(shape="polygon", vertices=((0.0, 0.0), (0.02, 0.0), (0.02, 0.02), (0.0, 0.02)))
    assert tilted_hand(case.model_copy(update={"object": square}), 0.0) == ()
    free = case.model_copy(
        update={
            "support": case.support.model_copy(update={"kind": SupportKind.FREE}),
            "object": Disk(shape="disk", radius=0.038),
        }
    )
    assert tilted_hand(free, 0.0)[2].estimate is None and tilted_hand(free, 0.0)[2].certain > 0.0
