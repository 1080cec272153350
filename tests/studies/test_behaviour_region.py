"""Regions of behaviours under feedback: of motions that feel nothing they are known, and a scoop is at least one of them."""

from __future__ import annotations

from concurrent.futures import Executor, ThreadPoolExecutor

import pytest

from palmar.errors import InputError, NotCoveredError
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case, with_layout
from palmar.models.guarantee import Guarantee
from palmar.regions.build import build_region
from palmar.studies import behaviour_region as module
from palmar.studies.behaviour_region import behaviour_region
from palmar.studies.run_behaviour import Circumstances
from palmar.worlds.planar.tracker import Tracker

CASE = parse_case(
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nfinger_rate_deg_s = 90\n[object]\nradius_mm = 38\n", "x"
)
SPACING = CASE.hand.finger_length / 8.0
COARSELY = Circumstances(tick=0.1)


@pytest.fixture
def pool() -> Executor:
    return ThreadPoolExecutor(1)


def doing(name: BehaviourName, layout: str = "none", **parameters: float) -> Case:
    behaviour = CASE.behaviour.model_copy(update={"name": name, **parameters})
    return with_layout(CASE.model_copy(update={"behaviour": behaviour}), layout, "x")


@pytest.mark.parametrize(
    "case", [doing(BehaviourName.CLOSE), doing(BehaviourName.MOVE_AND_GRAB, advance=0.12)], ids=["close", "grab"]
)
def test_of_a_motion_that_feels_nothing_it_is_the_known_region(case: Case, pool: Executor) -> None:
    heard: list[int] = []
    region, known = behaviour_region(case, pool, SPACING, COARSELY, heard.append), build_region(case)
    assert region.guarantee is Guarantee.SAMPLED
    assert region.outer is not None
    assert region.spacing is not None
    assert region.spacing <= SPACING
    inside = region.centre.difference(known.centre.buffer(0.25 * region.spacing))
    assert inside.area < 0.01 * known.area
    assert known.centre.difference(region.outer.buffer(0.25 * region.spacing)).area < 0.01 * known.area
    assert heard == sorted(heard)
    assert str(heard[-1]) in region.notes[0]


def test_a_scoop_catches_what_moving_as_far_and_grabbing_does(pool: Executor) -> None:
    """A flat hand pushes a disk straight: it does not matter where in front of it the palm comes to feel it."""
    scoop = behaviour_region(doing(BehaviourName.SCOOP, "palm", advance=0.12), pool, SPACING, COARSELY)
    grab = build_region(doing(BehaviourName.MOVE_AND_GRAB, advance=0.12))
    assert scoop.outer is not None
    assert scoop.outer.buffer(0.5 * SPACING).covers(grab.centre.buffer(-SPACING))
    assert grab.centre.buffer(SPACING).covers(scoop.centre)


def test_a_palm_reflex_that_waits_catches_nothing_that_does_not_come(pool: Executor) -> None:
    case = doing(BehaviourName.PALM_REFLEX, "palm", advance=0.0, patience=0.5)
    region = behaviour_region(case, pool, 2.0 * SPACING, COARSELY)
    assert region.centre.is_empty
    assert region.reason == "no start on the grid is caught"


def test_what_a_behaviour_needs_is_asked_for(pool: Executor) -> None:
    with pytest.raises(NotCoveredError, match="needs a sensor on the palm"):
        behaviour_region(doing(BehaviourName.SCOOP), pool)
    ranged = parse_case(
        "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n[contact]\nfriction = '0.2..0.4'\n",
        "x",
    )
    with pytest.raises(NotCoveredError, match="plain numbers"):
        behaviour_region(ranged, pool)


FREE = parse_case(
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nfinger_rate_deg_s = 90\n[object]\nradius_mm = 38\n"
    "[contact]\nfriction = 0\nrestitution = 0.5\n[support]\nkind = 'free'\n[start]\nvelocity_mm_s = [20, -30]\n"
    "[behaviour]\nname = 'match_velocity'\nspeed_mm_s = 400\nacceleration_mm_s2 = 3000\nreach_mm = 500\n"
    "place_mm = [0, 130]\npatience_s = 3\n", "x",
)  # fmt: skip


def test_with_several_draws_of_tracking_errors_it_is_what_all_of_them_leave(
    pool: Executor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "COARSE", 14)
    rough = Circumstances(tick=0.1, tracker=Tracker(0.05, 0.02, 0.005))
    one, three = (behaviour_region(FREE, pool, 1.0, rough, None, draws) for draws in (1, 3))
    assert one.outer is not None and three.outer is not None
    assert 0.0 < three.outer.area < one.outer.area
    assert one.outer.covers(three.outer)
    assert "one draw of its errors (seed 0), the same in all runs" in one.notes[1]
    assert "each of 3 draws of its errors (seeds 0 to 2)" in three.notes[1]
    assert "at least 0.368" in three.notes[1]  # 0.05 ** (1 / 3)
    with pytest.raises(InputError, match="needs a tracker with errors"):
        behaviour_region(FREE, pool, 1.0, Circumstances(tick=0.1, tracker=Tracker(0.05)), None, 2)
