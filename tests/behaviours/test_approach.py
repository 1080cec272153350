"""Sensor regions against touches found by going there, and placements against places drawn."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
import shapely
from shapely import Point, Polygon, affinity, box

from palmar.behaviours.approach import Doubt, farthest, sweep
from palmar.behaviours.placing import around, place, target
from palmar.geometry.planar_set import areal
from palmar.models.hand import Hand
from palmar.models.sensors import SensorLayout, Sensors, Stretch
from palmar.regions.profile import profile
from palmar.studies.plan_trial import drawn_starts
from palmar.worlds.planar.feeling import NOTHING, UNFELT, go_until_touched

HAND, RADIUS = Hand(palm_width=0.12, finger_links=(0.137, 0.107), finger_thickness=0.01), 0.038
BELIEFS = {
    "disk": Point(0.05, 0.4).buffer(0.25),
    "wider than the hand": box(-0.6, 0.3, 0.5, 0.5),
    "two parts": shapely.union_all([box(-0.2, 0.3, -0.1, 0.5), box(0.1, 0.25, 0.3, 0.3)]),
    "curve": Polygon([(-0.2, 0.3), (0.2, 0.35), (0.2, 0.3501), (-0.2, 0.3001)]),
}


@pytest.mark.parametrize("name", BELIEFS)
@pytest.mark.parametrize("layout", [SensorLayout.DISTRIBUTED, SensorLayout.FULL])
@pytest.mark.parametrize(
    ("opening", "x", "distance"), [(0.0, 0.0, None), (0.7, 0.13, 0.2), (1.2, -0.05, None), (0.0, 0.1, 0.12)]
)
def test_the_object_is_where_the_sensor_says(
    name: str, layout: SensorLayout, opening: float, x: float, distance: float | None
) -> None:
    """Every place ends in the region of the sensor that it touches, or in that of none; without errors, and with them."""
    stretches = Sensors(layout=layout).stretches(HAND)
    seen = profile(HAND, RADIUS, stretches, opening)
    rng, starts = np.random.default_rng(1), drawn_starts(BELIEFS[name], 3000, 1)
    for doubt in (Doubt(), Doubt(displacement=0.004, pose_error=0.003)):
        swept = sweep(BELIEFS[name], seen, x, doubt, distance)
        assert swept is not None
        off, pushed = (_shifts(rng, each, len(starts)) for each in (doubt.pose_error, doubt.displacement))
        touches = go_until_touched(HAND, stretches, opening, RADIUS, starts - (x, swept.y) + off, swept.distance)
        assert not (touches.sensors == UNFELT).any()
        known = {NOTHING if each.sensor is None else each.sensor: each.belief for each in swept.felt}
        assert set(touches.sensors.tolist()) <= set(known)
        after = starts - np.column_stack([np.full(len(starts), x), swept.y + touches.ways])
        after[touches.sensors != NOTHING] += pushed[touches.sensors != NOTHING]
        for sensor, belief in known.items():
            here = after[touches.sensors == sensor]
            assert shapely.contains_xy(shapely.buffer(belief, 1e-9), here).all()


def test_a_larger_object_is_where_the_sensor_says_too() -> None:
    """Radii between that of the profile and a spread more: the place is in the region of the sensor that it touches."""
    stretches = Sensors(layout=SensorLayout.DISTRIBUTED).stretches(HAND)
    seen, spread = profile(HAND, RADIUS, stretches, 0.7), 0.004
    starts = drawn_starts(BELIEFS["disk"], 2000, 1)
    swept = sweep(BELIEFS["disk"], seen, 0.13, Doubt(spread=spread), 0.2)
    assert swept is not None
    known = {NOTHING if each.sensor is None else each.sensor: each.belief for each in swept.felt}
    for radius in (RADIUS, RADIUS + 0.5 * spread, RADIUS + spread):
        touches = go_until_touched(HAND, stretches, 0.7, radius, starts - (0.13, swept.y), swept.distance)
        assert not (touches.sensors == UNFELT).any()
        after = starts - np.column_stack([np.full(len(starts), 0.13), swept.y + touches.ways])
        for sensor in np.unique(touches.sensors).tolist():
            here = after[touches.sensors == sensor]
            assert shapely.contains_xy(shapely.buffer(known[sensor], 1e-9), here).all()


def test_a_sensor_region_is_no_larger_than_it_must_be() -> None:
    """Without errors: as wide as what is touched there, and thinner than a third of a millimetre."""
    stretches = Sensors(layout=SensorLayout.DISTRIBUTED).stretches(HAND)
    seen = profile(HAND, RADIUS, stretches, 0.5)
    swept = sweep(BELIEFS["disk"], seen, 0.0, Doubt())
    assert swept is not None
    starts = drawn_starts(BELIEFS["disk"], 20_000, 2)
    touches = go_until_touched(HAND, stretches, 0.5, RADIUS, starts - (0.0, swept.y), swept.distance)
    for each in swept.felt:
        x = starts[touches.sensors == each.sensor, 0]
        left, _, right, _ = each.belief.bounds
        assert left == pytest.approx(x.min(), abs=1e-3)
        assert right == pytest.approx(x.max(), abs=1e-3)
        assert each.belief.area <= 0.3e-3 * 0.5 * each.belief.length


def test_an_approach_that_may_touch_a_dead_part_is_refused() -> None:
    stretches = (Stretch(body="palm"),)
    seen = profile(HAND, RADIUS, stretches, 0.0)
    assert sweep(box(-0.02, 0.3, 0.02, 0.4), seen, 0.0, Doubt()) is not None
    assert sweep(box(-0.02, 0.3, 0.08, 0.4), seen, 0.0, Doubt()) is None
    assert sweep(box(-0.02, 0.3, 0.059, 0.4), seen, 0.0, Doubt(pose_error=0.002)) is None


def _shifts(rng: np.random.Generator, most: float, number: int) -> np.ndarray:
    angle = rng.uniform(0.0, 2.0 * np.pi, number)
    return most * np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize("seed", range(12))
def test_a_placed_belief_lies_in_the_region(seed: int) -> None:
    rng = np.random.default_rng(seed)
    region = areal(shapely.union_all([Point(*rng.uniform(-1, 1, 2)).buffer(rng.uniform(0.5, 1.0)) for _ in range(4)]))
    belief = affinity.rotate(box(0.0, 0.0, rng.uniform(0.1, 1.2), rng.uniform(0.05, 0.3)), rng.uniform(0, 180))
    belief = affinity.translate(belief, *rng.uniform(-5, 5, 2))
    found = place(target(region), belief)
    assert found is not None
    at_place = affinity.translate(belief, -found.x, -found.y)
    assert region.covers(at_place)
    assert found.margin > 0.0
    for angle in np.linspace(0.0, 2.0 * np.pi, 16):
        moved = affinity.translate(at_place, found.margin * np.cos(angle), found.margin * np.sin(angle))
        assert region.covers(moved)


def test_a_belief_too_large_has_no_place() -> None:
    goal = target(areal(Point(0.0, 0.0).buffer(1.0)))
    assert place(goal, box(0.0, 0.0, 1.45, 1.45)) is None
    assert place(goal, box(0.0, 0.0, 1.3, 1.3)) is not None
    assert place(target(areal(Polygon())), Point(0, 0).buffer(0.1)) is None


def test_few_corners_are_around_many() -> None:
    belief = affinity.rotate(affinity.scale(Point(0, 0).buffer(1.0), 3.0, 0.2), 33.0)
    assert around(belief).covers(belief)
    assert len(around(belief).exterior.coords) <= 13
    assert around(belief).area < 1.5 * belief.area


def test_a_place_is_proved_whatever_the_erosion_says(monkeypatch: pytest.MonkeyPatch) -> None:
    """A wrong set of places does not become a wrong proof."""
    monkeypatch.setattr("palmar.behaviours.placing.shrunk", lambda region, uncertainty: region)
    assert place(target(areal(box(0.0, 0.0, 1.0, 1.0))), box(0.3, 0.3, 1.2, 1.2)) is None


@pytest.mark.parametrize("seed", range(10))
def test_an_approach_may_go_on_until_a_dead_part_would_touch(seed: int) -> None:
    """By sphere tracing: nothing unfelt is touched by then, and something is a millimetre later."""
    rng = np.random.default_rng(seed)
    stretches = (*Sensors(layout=SensorLayout.TIPS).stretches(HAND), Stretch(body="palm"))
    opening, x = (0.0, 0.3, 1.1, 1.2)[seed % 4], float(rng.uniform(-0.1, 0.1))
    seen = profile(HAND, RADIUS, stretches, opening)
    belief = affinity.rotate(box(-0.2, 0.4, 0.15, 0.6), rng.uniform(0.0, 90.0))
    doubt = Doubt(displacement=0.004, pose_error=0.003)
    way = farthest(belief, seen, x, doubt)
    assert way < inf
    swept = sweep(belief, seen, x, doubt, way)
    assert swept is not None and swept.distance == pytest.approx(way)
    assert sweep(belief, seen, x, doubt, way + 1e-3) is None
    starts = drawn_starts(belief, 40_000, seed)
    off = _shifts(rng, doubt.pose_error, len(starts))
    for distance, some in ((way, False), (way + 4e-3, True)):
        touches = go_until_touched(HAND, stretches, opening, RADIUS, starts - (x, swept.y) + off, distance)
        assert (touches.sensors == UNFELT).any() == some


def test_without_dead_parts_an_approach_may_go_on_for_ever() -> None:
    seen = profile(HAND, RADIUS, Sensors(layout=SensorLayout.FULL).stretches(HAND), 0.3)
    assert farthest(BELIEFS["disk"], seen, 0.0, Doubt()) == inf
