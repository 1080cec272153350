"""The search by trial and error finds the edge that it is given, and goes on where it was cut off."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, radians, sin

import pytest

from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.regions.build import build_region
from palmar.studies.limits import Limit, Rules, Trial, left_to_do, limits, next_distance, reach

LENGTH = 0.244
RULES = Rules((0.0, 0.0), tuple(radians(each) for each in (30.0, 60.0, 90.0)), 1e-3, seed=3)


@pytest.fixture(scope="module")
def bed() -> Case:
    return parse_case("[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n")


@pytest.mark.parametrize("edge", [0.05, 0.15, 0.3])
def test_the_procedure_closes_in_on_an_edge(edge: float) -> None:
    made: list[Trial] = []
    while (distance := next_distance(LENGTH, RULES, 0, made)) is not None:
        made.append(Trial(0, distance, (0.0, 0.0), Outcome.FRICTIONAL if distance < edge else Outcome.MISSED))
    caught = max(each.distance for each in made if each.outcome.caught)
    assert edge - RULES.tolerance <= caught < edge
    assert len(made) < 20
    for before, after in pairwise(made):
        assert (after.distance > before.distance) == before.outcome.caught
    for number in (3, len(made) - 4, len(made) - 2):
        left = left_to_do(LENGTH, Rules((0.0, 0.0), (0.5,), RULES.tolerance, seed=RULES.seed), made[:number])
        assert abs(left - (len(made) - number)) <= 3
    assert left_to_do(LENGTH, Rules((0.0, 0.0), (0.5,), RULES.tolerance, seed=RULES.seed), made) == 0


def test_an_object_that_overlaps_the_hand_is_placed_further_out() -> None:
    first = next_distance(LENGTH, RULES, 0, [])
    assert first is not None
    further = next_distance(LENGTH, RULES, 0, [Trial(0, first, (0.0, 0.0), Outcome.INVALID)])
    assert further is not None and further > first
    assert next_distance(LENGTH, RULES, 0, [Trial(0, 0.01, (0.0, 0.0), Outcome.MISSED)]) is None


def found_in(case: Case, rules: Rules, past: tuple[Trial, ...] = ()) -> tuple[Limit, ...]:
    return limits(case, rules, build_region(case).centre, past=past)


def test_limits_are_the_edge_of_the_region(bed: Case) -> None:
    found = found_in(bed, RULES)
    for each in found:
        assert each.difference is not None
        assert -RULES.tolerance - 1e-5 <= each.difference <= 1e-5
    assert hypot(found[2].trials[0].placed[0]) < 1e-12


def test_a_run_that_was_cut_off_goes_on(bed: Case) -> None:
    whole = found_in(bed, RULES)
    some = tuple(trial for each in whole for trial in each.trials[:3])
    assert found_in(bed, RULES, some) == whole
    assert found_in(bed, Rules(RULES.about, RULES.angles, RULES.tolerance, seed=4)) != whole


def test_places_err_by_the_placing_error(bed: Case) -> None:
    rules = Rules((0.06, 0.0), (radians(40.0),), 1e-3, 2e-3, 3)
    (found,) = found_in(bed, rules)
    off = [
        hypot(x - 0.06 - each.distance * cos(rules.angles[0]), y - each.distance * sin(rules.angles[0]))
        for each in found.trials
        for x, y in [each.placed]
    ]
    assert 5e-4 < max(off) <= 2e-3
    assert len({round(each, 9) for each in off}) == len(off)
    assert found.difference is not None and abs(found.difference) < 3e-3 + 1e-3


def test_distances_of_the_first_contact(bed: Case) -> None:
    """With places a radius aside of rays from the joint a line finger at the ray's angle touches at the distance."""
    rules = Rules((0.06, 0.0), (radians(30.0),), 1e-3, aside=0.038)
    for trial in found_in(bed, rules)[0].trials:
        x, y = trial.placed[0] - 0.06, trial.placed[1]
        assert sin(radians(30.0)) * x - cos(radians(30.0)) * y == pytest.approx(-0.038)
        assert cos(radians(30.0)) * x + sin(radians(30.0)) * y == pytest.approx(trial.distance)


def test_what_counts_as_a_success(bed: Case) -> None:
    held = Outcome.STRUCTURAL, Outcome.FRICTIONAL
    usual, counted, none = (
        found_in(bed, Rules(RULES.about, RULES.angles[:1], 1e-3, wanted=each))[0].distance
        for each in (None, held, (Outcome.MISSED,))
    )
    assert usual == counted != none


def test_the_last_time_that_a_ray_leaves_a_set(bed: Case) -> None:
    centre = build_region(bed).centre
    assert reach(centre, (0.0, 0.0), radians(-90.0)) is None
    upward = reach(centre, (0.0, 0.0), radians(90.0))
    assert upward == pytest.approx(centre.intersection(centre.envelope).bounds[3], abs=2e-3)
