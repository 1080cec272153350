"""What is certain although it is pushed: simulated at random orientations, and where its conditions fail."""

from math import pi

import numpy as np
import pytest
import shapely

from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.slider import polygon_slider, slider_body
from palmar.models.outcome import Outcome
from palmar.regions.pushed_core import pushed_core


def regular(corners, radius):
    angles = 2.0 * pi * np.arange(corners) / corners
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


HEXAGON, SQUARE = polygon_slider(regular(6, 0.04), (0.0, 0.0)), polygon_slider(regular(4, 0.042), (0.0, 0.0))


@pytest.mark.parametrize(("slider", "friction", "area"), [(HEXAGON, 0.7, 307e-4), (SQUARE, 0.3, 161e-4)])
def test_everything_in_it_is_caught_at_any_orientation(slider, friction, area):
    core = pushed_core(0.06, 0.244, 0.0, pi, slider, friction)
    assert core.area == pytest.approx(area, rel=0.01)
    rng = np.random.default_rng(0)
    edge = core.buffer(-1e-4).boundary
    places = [edge.interpolate(share, normalized=True) for share in rng.uniform(0.0, 1.0, 150)]
    starts = np.column_stack(
        [[point.x for point in places], [point.y for point in places], rng.uniform(0.0, 2.0 * pi, 150)]
    )
    codes, _, _ = carry_all(hand_motion(0.06, [0.244]), slider_body(slider, friction), starts)
    assert (codes <= Outcome.CAGED.code).all()


def test_less_friction_leaves_more():
    rough, smooth = (pushed_core(0.06, 0.244, 0.0, pi, HEXAGON, friction) for friction in (0.7, 0.1))
    assert smooth.buffer(1e-9).contains(rough)


def test_it_is_symmetric_and_above_the_palm():
    core = pushed_core(0.06, 0.244, 0.0, pi, SQUARE, 0.5)
    assert core.symmetric_difference(shapely.affinity.scale(core, -1.0, origin=(0.0, 0.0))).area < 1e-12
    assert core.bounds[1] == pytest.approx(0.042)


@pytest.mark.parametrize(
    ("half_palm", "last", "friction"),
    [(0.04, pi, 0.3), (0.06, 1.5, 0.3), (0.06, pi, 3.0), (0.3, pi, 0.3)],
    ids=["wider than the palm", "no cage", "jams on the palm", "never reached"],
)
def test_where_a_condition_fails_nothing_is_certain(half_palm, last, friction):
    assert pushed_core(half_palm, 0.244, 0.0, last, SQUARE, friction).is_empty
