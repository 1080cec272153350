"""Belief operations and whole plans, for the test-bed hand with distributed sensors."""

from __future__ import annotations

import pytest
from shapely import Point, box

from palmar.behaviours.approach import Doubt, sweep
from palmar.behaviours.fewest import Fewest
from palmar.behaviours.placing import place
from palmar.behaviours.superposed import strips
from palmar.models.case_file import with_layout
from palmar.models.shipped import open_case
from palmar.regions.profile import profile
from palmar.studies.plan import plan, planner_of

CASE = with_layout(open_case("testbed_table")[1], "distributed", "sensors")
BELIEF = Point(0.0, 0.5).buffer(0.25)
DOUBT = Doubt(0.002, 0.001)


def test_profile(benchmark):
    stretches = CASE.sensors.stretches(CASE.hand)
    benchmark(profile, CASE.hand, 0.038, stretches, 0.5)


def test_sweep_of_a_disk(benchmark):
    planner, _ = planner_of(CASE)
    benchmark(sweep, BELIEF, planner.openings[0].profile, 0.0, DOUBT)


def test_place_of_a_sensor_region(benchmark):
    planner, _ = planner_of(CASE)
    felt = sweep(BELIEF, planner.openings[0].profile, 0.0, DOUBT)
    benchmark(place, planner.openings[0].target, felt.felt[0].belief)


@pytest.mark.parametrize(
    "uncertainty", [Point(0.0, 0.0).buffer(0.25), box(-0.45, -0.1, 0.45, 0.1)], ids=["disk", "wide"]
)
def test_plan(benchmark, uncertainty):
    """Regions and profiles of four openings, and the search."""
    benchmark.pedantic(plan, (CASE, uncertainty, (0.0, 0.5), 3), rounds=3, warmup_rounds=1)


@pytest.mark.parametrize("approaches", [1, 2])
def test_bound_over_all_offsets(benchmark, approaches):
    """No plan within so many approaches, for a palm that alone feels."""
    planner, _ = planner_of(with_layout(CASE, "palm", "sensors"))
    benchmark.pedantic(lambda: Fewest(planner).rules_out(BELIEF, approaches), rounds=5, warmup_rounds=1)


def test_strips(benchmark):
    planner, _ = planner_of(CASE)
    benchmark.pedantic(strips, (planner, box(-1.0, 0.5, 1.0, 1.5), 2), rounds=5, warmup_rounds=1)
