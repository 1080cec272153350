"""What is left out of the simulation changes nothing: against all starts of the grid, at all orientations."""

from math import pi, radians

import numpy as np
import pytest
import shapely

from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, carry_all
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.polygon_contacts import polygon_body
from palmar.mechanics.pushing.slider import moved_poses
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon
from palmar.models.outcome import Outcome
from palmar.regions.caging_core import caging_core
from palmar.regions.closing_sampled import COARSE, sampled_sets

MOTION = hand_motion(0.06, [0.244])
RECTANGLE = np.array([[-0.04, -0.027], [0.04, -0.027], [0.04, 0.027], [-0.04, 0.027]])
ODD = np.array([[-0.035, -0.025], [0.038, -0.03], [0.03, 0.028], [-0.022, 0.033]])


def by_asking_all(body, centre, thetas, step):
    """Areas of the cells of which all corners and their neighbours are caught, and of those of which any is."""
    reach = body.reach + np.hypot(*centre)
    width, height = 2.0 * (0.06 + 0.244 + reach), 0.244 + 2.0 * reach
    x, y = np.meshgrid(step * np.arange(-round(0.5 * width / step), round(0.5 * width / step) + 1),
                       step * np.arange(np.ceil(height / step) + 3))  # fmt: skip
    caught = np.ones(x.size, bool)
    for theta in thetas:
        starts = moved_poses(centre, np.column_stack([x.ravel(), y.ravel(), np.full(x.size, theta)]), 1.0)
        caught &= carry_all(MOTION, body, starts, tolerance=BATCH_TOLERANCE)[0] <= Outcome.CAGED.code
    nodes = np.pad(caught.reshape(x.shape), 2)
    corners = np.lib.stride_tricks.sliding_window_view(nodes, (4, 4))
    return step**2 * corners.all(axis=(2, 3)).sum(), step**2 * corners.any(axis=(2, 3)).sum()


@pytest.mark.parametrize(
    ("corners", "centre", "thetas"),
    [
        (RECTANGLE, (0.0, 0.0), np.linspace(0.0, 2.0 * pi, 12, endpoint=False)),
        (RECTANGLE, (0.0, 0.0), np.array([radians(20.0)])),
        (ODD, (0.004, -0.002), np.radians([0.0, 25.0, 50.0])),
    ],
)
def test_the_sets_are_those_of_all_starts(corners, centre, thetas):
    body = polygon_body(corners, 0.6)
    sets = sampled_sets(MOTION, body, centre, thetas, 0.02)
    inner, outer = by_asking_all(body, centre, thetas, sets.spacing)
    assert sets.spacing <= 0.02 and COARSE % 2 == 0
    assert sets.centre.area == pytest.approx(inner, rel=1e-9)
    assert sets.outer.area == pytest.approx(outer, rel=1e-9)
    assert sets.starts < len(thetas) * sets.outer.envelope.area / sets.spacing**2


def test_starts_known_to_be_caught_are_left_out_and_nothing_else_changes():
    thetas = np.linspace(0.0, 2.0 * pi, 12, endpoint=False)
    thing = ConvexPolygon(shape="polygon", vertices=tuple(map(tuple, ODD.tolist())))
    hand = Hand(palm_width=0.2, finger_links=(0.244,))
    motion, body = hand_motion(0.1, [0.244]), polygon_body(ODD, 0.6)
    certain = caging_core(hand, thing, motion.last, 0.0, 2.0 * pi)
    assert not certain.is_empty
    with_it, without = (sampled_sets(motion, body, (0.0, 0.0), thetas, 0.02, *known) for known in ((certain,), ()))
    assert with_it.starts < without.starts
    assert shapely.equals(with_it.centre, without.centre) and shapely.equals(with_it.outer, without.outer)
