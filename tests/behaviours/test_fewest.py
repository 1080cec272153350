"""Lower bounds against plans found, and against brute force on clouds of places with touches by sphere tracing."""

from __future__ import annotations

from dataclasses import replace
from math import inf, radians

import numpy as np
import pytest
import shapely
from shapely import Point, affinity, box
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.fewest import Fewest
from palmar.behaviours.passing import Passing, View
from palmar.behaviours.planner import Planner
from palmar.behaviours.policy import is_guaranteed
from palmar.behaviours.search import Search, fewest_approaches
from palmar.behaviours.unfitting import outer_of, surely_unfit
from palmar.geometry.planar_set import areal
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.sensors import SensorLayout, Sensors, Stretch
from palmar.studies.plan import planner_of
from palmar.studies.plan_trial import drawn_starts
from palmar.worlds.planar.feeling import NOTHING, UNFELT, go_until_touched

HAND, RADIUS = Hand(palm_width=0.12, finger_links=(0.137, 0.107)), 0.038
LAYOUTS = {
    "distributed": SensorLayout.DISTRIBUTED,
    "tips": SensorLayout.TIPS,
    "palm": SensorLayout.PALM,
    "right only": (Stretch(body="right_1"), Stretch(body="right_2")),
}


def case_of(layout: str) -> Case:
    return Case(hand=HAND, object=Disk(radius=RADIUS), sensors=Sensors(layout=LAYOUTS[layout]))


def drawn_belief(rng: np.random.Generator, size: float = 1.0) -> BaseGeometry:
    """One to three boxes and disks before the hand."""
    parts: list[BaseGeometry] = []
    for _ in range(rng.integers(1, 4)):
        x, y = rng.uniform((-0.4, 0.4), (0.4, 0.9)) * (size, 1.0)
        w, h = size * rng.uniform((0.02, 0.02), (0.5, 0.4))
        parts.append(box(x, y, x + w, y + h) if rng.integers(0, 2) else Point(x, y).buffer(0.5 * min(w, h)))
    return shapely.union_all(parts)


@pytest.mark.parametrize(
    ("layout", "size", "most"), [("distributed", 2.0, 2), ("tips", 0.4, 2), ("palm", 0.4, 2), ("right only", 0.6, 2)]
)
def test_a_search_that_knows_no_bound_finds_nothing_below_it(
    layout: str, size: float, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a grid of its own; where there is a plan, the bound is met in most cases."""
    planner, _ = planner_of(case_of(layout))
    planner = replace(planner, offsets=37, most_sweeps=150)
    rng, met = np.random.default_rng(3), 0
    for _ in range(10):
        belief = drawn_belief(rng, size)
        least = Fewest(planner).least(belief, most)
        with monkeypatch.context() as patch:
            patch.setattr(Fewest, "rules_out", lambda self, *_: False)
            search = Search(planner, Fewest(planner))
            for depth in range(least + 1):
                found = search.solve(belief, depth, 0.0)
                assert found is None or depth >= least
                met += found is not None and depth > 0
    assert met >= 3


@pytest.mark.parametrize(("layout", "seed"), [("distributed", 1), ("tips", 2), ("palm", 5), ("right only", 4)])
def test_what_is_ruled_out_brute_force_does_not_find(layout: str, seed: int) -> None:
    """One approach: 25 distances at each of 61 offsets, clouds of places, and closings put anywhere on a grid of 4 mm."""
    case = case_of(layout)
    planner, stretches = planner_of(case)
    planner = replace(planner, openings=planner.openings[:1])
    rng, ruled, found = np.random.default_rng(seed), 0, 0
    for _ in range(12):
        belief = drawn_belief(rng)
        cloud = drawn_starts(belief, 600, seed)
        if Fewest(planner).rules_out(belief, 0):
            assert not _fits(planner, cloud)
        possible = _one_approach(planner, stretches, cloud)
        if Fewest(planner).rules_out(belief, 1):
            ruled += 1
            assert not possible
        found += possible
    assert ruled >= 1
    assert ruled + found <= 12


def _one_approach(planner: Planner, stretches: tuple[Stretch, ...], cloud: np.ndarray) -> bool:
    profile = planner.openings[0].profile
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    for x in np.linspace(low[0] - profile.right, high[0] - profile.left, 61):
        seen = cloud - (x, low[1] - 0.5)
        touch = go_until_touched(HAND, stretches, planner.openings[0].angle, RADIUS, seen, 5.0)
        touched = touch.sensors != NOTHING
        ways = np.where(touched, touch.ways, inf)
        for way in np.linspace(0.0, 0.7 + high[1] - low[1], 25):
            here = ways <= way
            if (touch.sensors[here] == UNFELT).any() or not here.any():
                continue
            groups = [seen[here & (touch.sensors == each)] for each in np.unique(touch.sensors[here])]
            after = [each - np.column_stack([np.zeros(len(each)), ways[here & (touch.sensors == s)]])
                     for each, s in zip(groups, np.unique(touch.sensors[here]), strict=True)]  # fmt: skip
            if all(_fits(planner, each) for each in (seen[~here], *after)):
                return True
    return False


def _fits(planner: Planner, cloud: np.ndarray) -> bool:
    if len(cloud) == 0:
        return True
    region = planner.openings[0].target.region
    left, bottom, right, top = region.bounds
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    if (high - low > (right - left, top - bottom)).any():
        return False
    shapely.prepare(region)
    hull = shapely.get_coordinates(shapely.convex_hull(shapely.multipoints(cloud)))
    x, y = (np.arange(a, b + 1e-3, 4e-3) for a, b in zip((left - low[0], bottom - low[1]),
                                                         (right - high[0], top - high[1]), strict=True))  # fmt: skip
    shifts = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 1, 2)
    return bool(_inside(region, hull + shifts).any())


def _inside(region: BaseGeometry, places: np.ndarray) -> np.ndarray:
    """Which of the sets of places (N, K, 2) lie in the region."""
    return shapely.contains_xy(region, places[..., 0], places[..., 1]).all(axis=1)


def test_a_palm_alone_is_proved_to_feel_nothing_of_use() -> None:
    planner, _ = planner_of(case_of("palm"))
    found = fewest_approaches(planner, Point(0.0, 0.5).buffer(0.25), 3)
    assert found.least == 4 and not found.minimal and not is_guaranteed(found.policy)


def test_a_bound_follows_the_directions_that_are_allowed() -> None:
    """A box too wide to be swept at once, but not from its side."""
    belief = box(-0.6, 0.9, 0.6, 1.1)
    case = case_of("distributed")
    ahead, _ = planner_of(case)
    around, _ = planner_of(case, directions=(0.0, radians(90.0)))
    assert Fewest(ahead).least(belief, 3) == 2
    assert Fewest(around).least(belief, 3) == 1
    assert fewest_approaches(around, belief, 3).minimal


@pytest.mark.parametrize("seed", range(8))
def test_what_surely_is_left_is_left_at_every_offset(seed: int) -> None:
    """Touches by sphere tracing at offsets drawn from the interval."""
    case = case_of("tips")
    planner, stretches = planner_of(case)
    opening = planner.openings[seed % len(planner.openings)]
    rng = np.random.default_rng(seed)
    belief = drawn_belief(rng)
    passing, view = Passing.of(opening.profile, 1e-5), View.of(belief)
    begin = rng.uniform(*passing.offsets(view, 1)[0])
    between = begin, begin + rng.uniform(0.0, 0.1)
    places = drawn_starts(belief, 3000, seed)
    dead = passing.dead_by(view, between)
    for height in (dead, inf if dead == inf else dead - 0.05, rng.uniform(0.3, 0.8)):
        left = passing.left(view, between, height)
        inside = places[shapely.contains_xy(left, places)]
        for x in rng.uniform(*between, 12):
            way = 5.0 if height == inf else height + 2.0
            touch = go_until_touched(HAND, stretches, opening.angle, RADIUS, inside - (x, -2.0), way)
            assert (touch.sensors == NOTHING).all()
    if dead < inf:
        for x in rng.uniform(*between, 12):
            touch = go_until_touched(HAND, stretches, opening.angle, RADIUS, places - (x, -2.0), dead + 2.0 + 5e-3)
            assert (touch.sensors == UNFELT).any()


@pytest.mark.parametrize("seed", range(8))
def test_what_a_sensor_surely_may_feel_it_does_at_every_offset(seed: int) -> None:
    planner, stretches = planner_of(case_of("distributed"))
    opening = planner.openings[seed % len(planner.openings)]
    rng = np.random.default_rng(seed)
    belief = drawn_belief(rng)
    passing, view = Passing.of(opening.profile, 1e-5), View.of(belief)
    first, last = passing.offsets(view, 1)[0]
    begin = rng.uniform(0.8 * first + 0.2 * last, 0.2 * first + 0.8 * last)
    between = begin, begin + 0.01
    places = drawn_starts(belief, 40_000, seed)
    checked = 0
    for sensor in passing.sensors:
        for height in (inf, *passing.heights(view, between, sensor)[::16]):
            marks = passing.felt(view, between, sensor, float(height), 48)
            if not marks:
                continue
            felt = passing.places(marks, 48)
            for x in rng.uniform(*between, 3):
                way = 5.0 if height == inf else float(height) + 2.0
                touch = go_until_touched(HAND, stretches, opening.angle, RADIUS, places - (x, -2.0), way)
                here = touch.sensors == sensor
                after = places[here] - np.column_stack([np.full(here.sum(), x), touch.ways[here] - 2.0])
                known = shapely.multipoints(after)
                reached = [
                    Point(each).distance(known) for each in shapely.get_coordinates(shapely.segmentize(felt, 5e-3))
                ]
                assert max(reached) < 4e-3
                checked += 1
    assert checked > 3


@pytest.mark.parametrize("seed", range(12))
def test_a_belief_said_not_to_fit_has_no_place(seed: int) -> None:
    """Against all places on a fine grid."""
    rng = np.random.default_rng(seed)
    region = areal(shapely.union_all([Point(*rng.uniform(-1, 1, 2)).buffer(rng.uniform(0.3, 0.8)) for _ in range(3)]))
    belief = affinity.rotate(box(0.0, 0.0, rng.uniform(0.2, 1.6), rng.uniform(0.05, 0.9)), rng.uniform(0, 180))
    corners = shapely.get_coordinates(belief)
    shifts = np.stack(np.meshgrid(np.linspace(-3, 3, 241), np.linspace(-3, 3, 241)), axis=-1).reshape(-1, 1, 2)
    likely = shifts[_inside(region, corners + shifts), 0]
    if any(region.covers(affinity.translate(belief, *shift)) for shift in likely):
        assert not surely_unfit(outer_of(region, 1e-9), belief)


def test_a_belief_just_too_large_is_seen_to_be() -> None:
    outer = outer_of(areal(box(0.0, 0.0, 1.0, 0.5)), 1e-9)
    assert surely_unfit(outer, box(5.0, 5.0, 6.001, 5.1))
    assert surely_unfit(outer, affinity.rotate(box(0.0, 0.0, 1.1, 0.1), 5.0))
    assert not surely_unfit(outer, box(5.0, 5.0, 5.999, 5.499))
    disk = outer_of(areal(Point(0.0, 0.0).buffer(1.0, quad_segs=64)), 1e-9)
    assert surely_unfit(disk, box(0.0, 0.0, 1.43, 1.43))
    assert not surely_unfit(disk, box(0.0, 0.0, 1.41, 1.41))
