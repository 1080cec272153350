"""The true pre-image of free disks: known area and radii, the constructions inside it, starts drawn in and outside."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import shapely

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions import captured as module
from palmar.regions.build import build_region
from palmar.regions.region import Model, Region
from palmar.studies.compare import compare_regions
from palmar.studies.plan_trial import drawn_starts

CASE = open_case("zero_g_example")[1]
TEXT = (
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n{hand}[object]\nradius_mm = 38\n"
    "[contact]\nfriction = {friction}\nrestitution = {restitution}\n[support]\nkind = 'free'\n[start]\n{start}"
)
COARSE = 0.244 / 64.0
"""Spacing (m) that keeps a test short; the region claims no less of its inside for that."""
KNOWN = (0.0614, 0.0856, 0.1135, 0.1546, 0.2075, 0.2434)


def asked(hand: str = "", friction: str = "0", restitution: str = "1", start: str = "") -> Case:
    return parse_case(TEXT.format(hand=hand, friction=friction, restitution=restitution, start=start), "x")


@cache
def exact() -> Region:
    """Of the known hand."""
    return build_region(CASE)


def is_caught(case: Case, starts: np.ndarray, e: float) -> np.ndarray:
    ends = capture_all(capture_hand_of(case), starts, case.start.velocity, e, law=impact_law_of(case))
    return ends.codes <= Outcome.CAGED.code


def test_it_has_the_known_area_and_radii() -> None:
    region = exact()
    assert region.guarantee is Guarantee.SAMPLED
    assert region.area == pytest.approx(0.04003, abs=5e-5)
    assert region.outer is not None
    assert region.outer.area == pytest.approx(0.04003, abs=7e-5)
    reaches = {round(np.degrees(each.angle)): each.distances[0] for each in compare_regions(
        CASE, [Model.EXACT, Model.CORRECTED], Closure.FRICTIONAL).reaches}  # fmt: skip
    assert [reaches[angle] for angle in (15, 30, 45, 60, 75, 90)] == pytest.approx(KNOWN, abs=7e-4)
    assert reaches[0] == pytest.approx(0.0426, abs=1.5e-3)


@pytest.mark.parametrize("model", [Model.PUBLISHED, Model.CORRECTED])
def test_the_constructions_lie_inside_it(model: Model) -> None:
    outer = exact().outer
    assert outer is not None
    assert build_region(CASE, model).centre.difference(outer).area < 1e-8


@pytest.mark.parametrize(
    "case",
    [
        asked(restitution="1"),
        asked(restitution="'0.4..1'"),
        asked("finger_thickness_mm = 25\nfingers = 'colliding'\n", restitution="0.7"),
        asked("open_deg = 40\n", restitution="0.5"),
        asked("finger_mass_kg = 4\n", restitution="0.8"),
        asked(friction="0.3", restitution="0.6"),
        asked(restitution="0.9", start="velocity_mm_s = [15, -40]\n"),
    ],
    ids=["elastic", "range", "thick", "opened", "finite mass", "friction", "moving"],
)
def test_starts_inside_are_caught_and_starts_outside_are_not(case: Case) -> None:
    coarse = case.ranges or case.start.velocity != (0.0, 0.0)
    region = build_region(case, tolerance=2.0 * COARSE if coarse else COARSE)
    starts = drawn_starts(region.centre, 3000, 7)
    es = (0.4, 0.55, 0.83, 1.0) if case.ranges else (case.contact.restitution,)
    for e in es:
        assert is_caught(case.settled([e]) if case.ranges else case, starts, e).mean() > 0.999
    left, low, right, high = region.centre.bounds
    outside = np.random.default_rng(1).uniform([left, low], [right, high], (4000, 2))
    assert region.outer is not None
    outside = outside[~shapely.contains_xy(region.outer, *outside.T)]
    missed = np.zeros(len(outside), bool)
    for e in es if not case.ranges else np.linspace(0.4, 1.0, 9):
        missed |= ~is_caught(case.settled([e]) if case.ranges else case, outside, float(e))
    assert missed.mean() > 0.99


def test_no_start_beside_the_outline_is_caught() -> None:
    """Corners of the set that chords of the outline cut off are put back."""
    outer = build_region(CASE, tolerance=COARSE).outer
    assert outer is not None
    starts = drawn_starts(outer.buffer(0.02).difference(outer), 20_000, 3)
    assert not is_caught(CASE, starts, 1.0).any()


def test_lost_places_that_no_corner_mends_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    place = np.array([[0.02, 0.15]])
    monkeypatch.setattr(module, "refined", lambda ring, *_: (ring, place))
    centre = build_region(CASE, tolerance=2.0 * COARSE).centre
    assert not shapely.contains_xy(centre, [0.02, -0.02], [0.15, 0.15]).any()
    assert shapely.contains_xy(centre, [0.025, -0.025], [0.15, 0.15]).all()


def test_it_does_not_depend_on_the_rate_but_for_moving_disks() -> None:
    quick = CASE.model_copy(update={"hand": CASE.hand.model_copy(update={"finger_rate": 5.0})})
    assert build_region(quick).centre.equals_exact(exact().centre, 1e-7)


def test_a_faster_hand_meets_a_faster_disk_alike() -> None:
    slow = asked(start="velocity_mm_s = [10, -20]\n")
    hand = slow.hand.model_copy(update={"finger_rate": 3.0 * slow.hand.finger_rate})
    start = slow.start.model_copy(update={"velocity": (0.03, -0.06)})
    fast = slow.model_copy(update={"hand": hand, "start": start})
    one, other = (build_region(each, tolerance=4.0 * COARSE).centre for each in (slow, fast))
    assert one.symmetric_difference(other).area < 1e-4 * one.area


def test_it_shrinks_where_more_restitutions_are_asked_about() -> None:
    both, low, high = (
        build_region(asked(restitution=each), tolerance=2.0 * COARSE) for each in ("'0.5..1'", "0.5", "1")
    )
    assert both.area < min(low.area, high.area)
    assert both.centre.difference(low.centre.buffer(1e-4)).is_empty
    assert "9 values from 0.5 to 1" in both.notes[0]


def test_what_is_not_covered_says_so() -> None:
    with pytest.raises(NotCoveredError, match="only the restitution"):
        build_region(asked(friction="'0..0.4'"))
    polygon = 'shape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
    text = TEXT.format(hand="", friction=0, restitution=1, start="").replace("radius_mm = 38\n", polygon)
    with pytest.raises(NotCoveredError, match="only disks"):
        build_region(parse_case(text, "x"))


def test_structural_closure_takes_contacts_as_frictionless() -> None:
    rough = build_region(asked(friction="0.5"), closure=Closure.STRUCTURAL)
    assert rough.closure is Closure.STRUCTURAL
    assert rough.centre.equals(exact().centre)
