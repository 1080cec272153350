"""Behaviours in free space: each does there what it says, from a disk at rest and from one in motion."""

from __future__ import annotations

from concurrent.futures import Executor, Future
from typing import Any

import numpy as np
import pytest

from palmar.behaviours.verdict import Verdict
from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture_all
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case, Start
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.sensors import SensorLayout, Sensors
from palmar.models.support import Support, SupportKind
from palmar.studies.behaviour_region import behaviour_region
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.worlds.planar.free import free_world
from palmar.worlds.planar.tracker import Tracker
from palmar.worlds.run import Ended

HAND = Hand(palm_width=0.12, finger_links=(0.137, 0.107))
COARSE = Circumstances(tick=0.02)


def case_of(name: BehaviourName, e: float = 0.7, velocity: tuple[float, float] = (0.0, 0.0), **given: Any) -> Case:
    return Case(
        hand=HAND, object=Disk(radius=0.038), contact=Contact(friction=0.0, restitution=e),
        support=Support(kind=SupportKind.FREE), sensors=Sensors(layout=SensorLayout.DISTRIBUTED),
        start=Start(velocity=velocity), behaviour=Behaviour(name=name, **given),
    )  # fmt: skip


@pytest.mark.parametrize("name", [BehaviourName.MOVE_AND_GRAB, BehaviourName.MOVE_WHILE_CLOSING])
def test_moves_end_as_the_kernel_does_in_the_frame_of_the_hand(name: BehaviourName) -> None:
    """Move and grab of an untouched disk is closing from nearer; closing on the move that never ends, one at -V."""
    rng, tried = np.random.default_rng(6), 0
    forever = name is BehaviourName.MOVE_WHILE_CLOSING
    case = case_of(name, speed=0.02, advance=0.2 if forever else 0.06)
    hand = free_world(case_of(BehaviourName.CLOSE)).hand
    seconds = 10.0 if forever else 3.0
    while tried < 16:
        x, y = rng.uniform(-0.2, 0.2), rng.uniform(0.1, 0.3)
        done = run_behaviour(case, (x, y, 0.0), COARSE)
        if not forever and any(any(row.seen.bits) for row in done.trace.rows if row.seen.time <= seconds):
            continue
        tried += 1
        place, velocity = ((x, y), (0.0, -0.02)) if forever else ((x, y - 0.06), (0.0, 0.0))
        found = capture_all(hand, [place], velocity, 0.7)
        expected = Outcome.from_code(int(found.codes[0]))
        assert done.trace.ended is Ended.STOPPED
        assert done.trace.outcome.caught == expected.caught


def test_the_palm_reflex_closes_after_the_impact_and_its_delay_only_then() -> None:
    """At e = 0 the disk rests on the palm and is caught; at e = 1 it is away at its speed before the fingers come round."""
    for e, caught in ((0.0, True), (1.0, False)):
        case = case_of(BehaviourName.PALM_REFLEX, e, (0.0, -0.2), advance=0.0, delay=0.1)
        done = run_behaviour(case, (0.01, 0.2, 0.0), Circumstances(tick=0.01))
        felt = next(each.time for each in done.trace.happenings if each.what == "palm")
        closes = next(each.time for each in done.trace.happenings if each.what.endswith(": close"))
        assert felt == pytest.approx(0.81, abs=0.0101)
        assert closes - felt == pytest.approx(0.1, abs=1e-9)
        assert done.trace.outcome.caught is caught
    never = run_behaviour(case_of(BehaviourName.PALM_REFLEX, advance=0.0, patience=0.5), (0.0, 0.2, 0.0), COARSE)
    assert (never.trace.outcome, never.trace.ended) == (Outcome.MISSED, Ended.STOPPED)
    assert never.trace.rows[-1].seen.time == pytest.approx(0.5)


@pytest.mark.parametrize("e", [0.0, 0.4])
def test_scooping_up_a_disk_at_rest(e: float) -> None:
    """The palm meets it at 0.1 m/s; the arm then stops and the disk goes on, faster than fingers close."""
    done = run_behaviour(case_of(BehaviourName.SCOOP, e, speed=0.1, advance=0.3), (0.0, 0.2, 0.0), COARSE)
    felt = next(each.time for each in done.trace.happenings if each.what == "palm")
    assert felt == pytest.approx(1.62, abs=0.021)
    assert done.trace.ended is Ended.STOPPED
    assert not done.trace.outcome.caught
    slow = run_behaviour(case_of(BehaviourName.SCOOP, e, speed=0.02, advance=0.3), (0.0, 0.2, 0.0), COARSE)
    assert slow.trace.outcome.caught and slow.verdict is Verdict.CAUGHT


def test_the_jointed_reflex_runs_in_free_space() -> None:
    done = run_behaviour(case_of(BehaviourName.JOINTED, 0.0), (0.02, 0.12, 0.0), COARSE)
    assert done.trace.ended is Ended.STOPPED
    assert done.trace.outcome.caught
    assert max(row.seen.right[1] for row in done.trace.rows) > 0.1


def test_matching_the_velocity_catches_what_closing_cannot() -> None:
    start, velocity = (0.3, 0.25, 0.0), (0.15, 0.05)
    alone = run_behaviour(case_of(BehaviourName.CLOSE, 1.0, velocity), start, COARSE)
    case = case_of(
        BehaviourName.MATCH_VELOCITY, 1.0, velocity, speed=0.5, reach=3.0, acceleration=4.0, place=(0.0, 0.13)
    )
    matched = run_behaviour(case, start, COARSE)
    assert not alone.trace.outcome.caught
    assert matched.trace.outcome.caught and matched.trace.ended is Ended.STOPPED
    assert matched.trace.rows[0].seen.track == (0.3, 0.25, 0.15, 0.05)
    late = run_behaviour(case, start, Circumstances(tick=0.02, tracker=Tracker(delay=1.5)))
    assert not late.trace.outcome.caught


def test_matching_is_refused_on_a_table_and_beyond_the_limits() -> None:
    case = case_of(BehaviourName.MATCH_VELOCITY, place=(0.0, 0.13))
    with pytest.raises(NotCoveredError, match="free space"):
        run_behaviour(case.model_copy(update={"support": Support()}), (0.0, 0.2, 0.0))
    quick = run_behaviour(case_of(BehaviourName.MATCH_VELOCITY, 1.0, (0.3, 0.0), place=(0.0, 0.13)), (0.0, 0.2, 0.0))
    assert "more than the arm's 100 mm/s" in quick.trace.rows[-1].why
    assert quick.trace.rows[-1].seen.arm == (0.0, 0.0, 0.0)


def test_the_place_is_the_middle_of_the_region_unless_stated() -> None:
    from palmar.behaviours.build import reflex_of

    reflex = reflex_of(case_of(BehaviourName.MATCH_VELOCITY, 1.0, (0.5, 0.0)))
    assert reflex.place[0] == pytest.approx(0.0, abs=2e-3)
    assert 0.08 < reflex.place[1] < 0.25
    assert reflex_of(case_of(BehaviourName.MATCH_VELOCITY, place=(0.01, 0.13))).place == (0.01, 0.13)


class AtOnce(Executor):
    """Runs in this process."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        found: Future[Any] = Future()
        found.set_result(fn(*args, **kwargs))
        return found


def test_the_region_of_closing_on_a_moving_disk_is_that_of_the_kernel() -> None:
    case = case_of(BehaviourName.CLOSE, 0.7, (0.0, -0.01))
    found = behaviour_region(case, AtOnce(), 0.03, Circumstances(tick=0.1))
    hand = free_world(case).hand
    for inside, region in ((True, found.centre), (False, found.outer)):
        rng, places = np.random.default_rng(1), []
        while len(places) < 200:
            x, y = rng.uniform(-0.3, 0.3), rng.uniform(0.04, 0.4)
            from shapely import Point

            if region.contains(Point(x, y)) is inside:
                places.append((x, y))
        held = capture_all(hand, places, (0.0, -0.01), 0.7).codes <= Outcome.CAGED.code
        # The grid is coarse: what lies between its nodes is not bounded.
        assert held.mean() > 0.9 if inside else held.mean() < 0.1
    assert found.spacing is not None
