"""Regions of curling first and of coupled closing: against straight closing, and against the reflexes under feedback."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import Support, SupportKind
from palmar.regions.build import build_region
from palmar.regions.exact import exact_region
from palmar.regions.jointed_closing import Carried
from palmar.studies.run_behaviour import Circumstances, run_behaviour

BED = Hand(palm_width=0.12, finger_links=(0.137, 0.107))
FREE = Support(kind=SupportKind.FREE)
CURL, COUPLED = BehaviourName.CURL_AND_CLOSE, BehaviourName.CLOSE_COUPLED
SPACING = BED.finger_length / 24.0


def case_of(name: BehaviourName, hand: Hand = BED, **given: object) -> Case:
    parts = {key: given.pop(key) for key in ("support", "contact") if key in given}
    return Case(hand=hand, object=Disk(radius=0.038), behaviour=Behaviour(name=name, **given), **parts)


@pytest.mark.parametrize(("name", "given"), [(CURL, {"preshape": 0.0}), (COUPLED, {"ratio": 0.0})])
def test_without_a_second_motion_it_is_straight_closing(name: BehaviourName, given: dict[str, float]) -> None:
    exact = exact_region(case_of(BehaviourName.CLOSE)).centre
    found = build_region(case_of(name, **given), tolerance=SPACING).centre
    assert exact.buffer(1e-6).covers(found)
    assert found.buffer(1.5 * SPACING).covers(exact)


def test_the_preshape_without_rolling_catches_from_more_than_less_or_more_curl() -> None:
    areas = [build_region(case_of(CURL, preshape=radians(each)), tolerance=SPACING).area for each in (0.0, 20.3, 60.0)]
    assert areas[1] > 1.05 * areas[0] > 1.05 * areas[2]


@pytest.mark.parametrize(
    ("hand", "name", "given"),
    [
        (BED, CURL, {"preshape": 0.5}),
        (BED, COUPLED, {"ratio": 0.6}),
        (BED.model_copy(update={"finger_thickness": 0.025, "fingers": Fingers.COLLIDING}), CURL, {"preshape": 0.45}),
    ],
    ids=["curl", "coupled", "thick"],
)
def test_the_reflex_under_feedback_ends_alike_on_the_table(
    hand: Hand, name: BehaviourName, given: dict[str, float]
) -> None:
    case = case_of(name, hand, **given)
    starts = np.random.default_rng(4).uniform([-0.3, 0.06, 0.0], [0.3, 0.26, 0.0], (6, 3))
    expected = Carried(case).outcomes(starts)
    for start, code in zip(starts, expected, strict=True):
        done = run_behaviour(case, (float(start[0]), float(start[1]), 0.0), Circumstances(tick=0.1))
        assert done.trace.outcome.caught == Outcome.from_code(int(code)).caught
    assert 1 < (expected <= Outcome.CAGED.code).sum() < 6


def test_the_curl_takes_along_what_lies_beside_the_distal_link() -> None:
    """Starts that the curled finger would overlap, were it curled before they are there."""
    case = case_of(CURL, preshape=0.5)
    starts = np.array([[0.2592, 0.0439, 0.0], [-0.2782, 0.052, 0.0], [0.2132, 0.0519, 0.0]])
    assert (Carried(case).outcomes(starts) <= Outcome.CAGED.code).all()
    for x, y, _ in starts[:2]:
        assert run_behaviour(case, (float(x), float(y), 0.0), Circumstances(tick=0.1)).trace.outcome.caught


@pytest.mark.parametrize(("name", "given"), [(CURL, {"preshape": 0.9}), (COUPLED, {"ratio": 0.6})])
@pytest.mark.parametrize("restitution", [1.0, 0.3])
def test_the_reflex_under_feedback_ends_alike_in_free_space(name, given, restitution: float) -> None:
    case = case_of(name, support=FREE, contact=Contact(friction=0.0, restitution=restitution), **given)
    starts = np.random.default_rng(5).uniform([-0.25, 0.06], [0.25, 0.24], (12, 2))
    codes = capture_all(capture_hand_of(case), starts, restitution=restitution, law=impact_law_of(case)).codes
    for start, code in zip(starts, codes, strict=True):
        done = run_behaviour(case, (float(start[0]), float(start[1]), 0.0), Circumstances(tick=0.05))
        assert done.trace.outcome.caught == Outcome.from_code(int(code)).caught
    assert 2 < (codes == Outcome.CAGED.code).sum() < 12


def test_curling_first_catches_free_disks_from_a_third_more() -> None:
    free = {"support": FREE, "contact": Contact(friction=0.0)}
    straight = build_region(case_of(BehaviourName.CLOSE, **free), tolerance=SPACING).area
    curled = build_region(case_of(CURL, preshape=radians(57.5), **free), tolerance=SPACING)
    assert curled.area > 1.3 * straight
    assert not any("kept straight" in each for each in curled.notes)


@pytest.mark.parametrize(
    ("case", "said"),
    [
        (case_of(CURL, Hand(palm_width=0.12, finger_links=(0.2,))), "fingers of two links, not 1"),
        (case_of(COUPLED, Hand(palm_width=0.12, finger_links=(0.1, 0.1, 0.1))), "fingers of two links, not 3"),
        (
            case_of(CURL, BED.model_copy(update={"joint_limits": ((0.0, 3.0), (0.0, 0.3))}), preshape=0.5),
            "the distal joint goes to 17.19",
        ),
        (case_of(CURL, support=Support(wall=0.4)), "without a wall"),
        (case_of(CURL, BED.model_copy(update={"finger_mass": 0.1}), support=FREE), "taken as heavy"),
    ],
)
def test_what_is_not_covered_is_said(case: Case, said: str) -> None:
    with pytest.raises(NotCoveredError, match=said):
        build_region(case, tolerance=SPACING)


def test_a_coupled_finger_ends_with_its_distal_joint() -> None:
    limited = BED.model_copy(update={"joint_limits": ((0.0, 3.0), (0.0, 0.4))})
    case = case_of(COUPLED, limited, ratio=0.5)
    done = run_behaviour(case, (0.0, 0.6, 0.0), Circumstances(tick=0.1))
    assert done.trace.rows[-1].seen.right == pytest.approx((0.8, 0.4), abs=1e-6)
