"""The palm as a paddle: it stops the disk dead where the palm reflex loses it, and says what it cannot do."""

from __future__ import annotations

import pytest

from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.studies.run_behaviour import Circumstances, run_behaviour

TEXT = (
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n[contact]\nfriction = 0\n"
    "restitution = {e}\n[support]\nkind = 'free'\n[start]\nvelocity_mm_s = [5, {vy}]\n[sensors]\nlayout = 'palm'\n"
    "[behaviour]\nname = 'matched_return'\nspeed_mm_s = {speed}\nacceleration_mm_s2 = 2000\nreach_mm = {reach}\n"
)
START = (0.01, 0.15, 0.0)


def case_of(e: float = 0.9, vy: float = -120, speed: float = 200, reach: float = 1000) -> Case:
    return parse_case(TEXT.format(e=e, vy=vy, speed=speed, reach=reach), "x")


@pytest.mark.parametrize("e", [1.0, 0.9, 0.5, 0.0])
def test_it_leaves_the_disk_at_rest_and_catches_it(e: float) -> None:
    rows = run_behaviour(case_of(e), START, Circumstances(tick=0.02)).trace
    assert rows.outcome.caught
    struck = next(row for row in rows.rows if row.why.startswith("struck"))
    assert abs(struck.seen.track[3]) < 0.02 * 0.12


def test_the_palm_reflex_loses_that_disk() -> None:
    case = case_of()
    reflex = case.behaviour.model_copy(update={"name": BehaviourName.PALM_REFLEX})
    assert not run_behaviour(case.model_copy(update={"behaviour": reflex}), START).trace.outcome.caught


@pytest.mark.parametrize(
    ("given", "words"),
    [({"vy": 20}, "does not come"), ({"speed": 20}, "more than the arm's"), ({"reach": 50}, "reach of 50 mm")],
)
def test_it_says_what_it_cannot_do(given: dict[str, float], words: str) -> None:
    trace = run_behaviour(case_of(**given), START, Circumstances(tick=0.02)).trace
    assert words in trace.rows[-1].why
