"""Reflexes step by step on observations made by hand: no world, no time but what they are told."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians

import pytest
from shapely import box

from palmar.behaviours.build import reflex_of
from palmar.behaviours.close import Closing
from palmar.behaviours.descriptions import DESCRIPTIONS
from palmar.behaviours.follow_policy import FollowPolicy, Grab, Move
from palmar.behaviours.jointed import JointedReflex, Phase
from palmar.behaviours.move_and_grab import MoveAndGrab
from palmar.behaviours.move_while_closing import MoveWhileClosing
from palmar.behaviours.palm_reflex import PalmReflex
from palmar.behaviours.placing import Place
from palmar.behaviours.policy import Approach, Branch, Close, Lost
from palmar.behaviours.reflex import Advance, Drive
from palmar.behaviours.scoop import Scoop
from palmar.behaviours.sensor_places import places_of
from palmar.behaviours.verdict import Verdict, verdict
from palmar.errors import NotCoveredError
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.hand import Hand
from palmar.models.motion import Command, Observation
from palmar.models.objects import Disk
from palmar.models.sensors import SensorLayout, Sensors, Stretch

DRIVE = Drive(2, 0.5)
AHEAD = Advance(0.2, 0.1, pi / 2)
BODIES = ("palm", "right_1", "right_2", "left_1", "left_2")
PLACES = places_of([Stretch(body=each) for each in BODIES], 2)
NOTHING = Observation(0.0, (0.0, 0.0), (0.0, 0.0), (False,) * 5)
CLOSES = ((0.5, 0.0), (0.5, 0.0))


def at(time: float, *felt: str, stalled: tuple[bool, bool] = (False, False)) -> Observation:
    return replace(NOTHING, time=time, bits=tuple(each in felt for each in BODIES), stalled=stalled)


def rates(command: Command) -> tuple[tuple[float, ...], tuple[float, ...]]:
    return command.right, command.left


def test_close_closes_until_both_fingers_are_held_up() -> None:
    reflex = Closing(DRIVE)
    _, command = reflex.step(None, at(1.0, stalled=(True, False)))
    assert (rates(command), command.velocity, command.stop) == (CLOSES, (0.0, 0.0), False)
    assert reflex.step(None, at(2.0, stalled=(True, True)))[1].stop


def test_move_and_grab_moves_for_exactly_its_time() -> None:
    reflex = MoveAndGrab(DRIVE, AHEAD)
    state = reflex.begin(at(3.0))
    state, command = reflex.step(state, at(4.5))
    assert command.velocity == (0.0, 0.1)
    assert command.longest == pytest.approx(0.5)
    assert not command.moves_fingers
    state, command = reflex.step(state, at(5.0))
    assert (rates(command), command.velocity) == (CLOSES, (0.0, 0.0))


def test_move_while_closing_opens_with_its_first_stretch() -> None:
    reflex = MoveWhileClosing(DRIVE, AHEAD, 0.05)
    state = reflex.begin(at(0.0))
    _, command = reflex.step(state, at(0.4))
    assert (command.moves_fingers, command.longest) == (False, pytest.approx(0.1))
    _, command = reflex.step(state, at(0.5))
    assert (rates(command), command.velocity, command.longest) == (CLOSES, (0.0, 0.1), pytest.approx(1.5))
    _, command = reflex.step(state, at(1.0, stalled=(True, True)))
    assert not command.stop
    assert reflex.step(state, at(2.0, stalled=(True, True)))[1].stop


@pytest.mark.parametrize(
    ("time", "felt", "closes"),
    [(1.0, (), False), (1.0, ("right_2",), False), (1.0, ("palm",), True), (2.0, (), True)],
)
def test_scoop_closes_on_the_palm_or_at_the_end_of_the_way(time: float, felt: tuple[str, ...], closes: bool) -> None:
    reflex = Scoop(DRIVE, AHEAD, PLACES)
    state, command = reflex.step(reflex.begin(at(0.0)), at(time, *felt))
    assert command.moves_fingers == closes
    assert (command.velocity == (0.0, 0.0)) == closes
    assert reflex.step(state, at(time + 0.1))[1].moves_fingers == closes


def test_the_palm_reflex_waits_for_the_bit_and_the_delay() -> None:
    reflex = PalmReflex(DRIVE, PLACES, None, patience=2.0, delay=0.3)
    waiting, command = reflex.step(reflex.begin(at(0.0)), at(1.0, "left_1"))
    assert (command.moves_fingers, command.longest) == (False, pytest.approx(1.0))
    assert reflex.step(waiting, at(2.0))[1].stop
    felt, command = reflex.step(waiting, at(1.5, "palm"))
    assert (command.moves_fingers, command.longest) == (False, pytest.approx(0.3))
    assert rates(reflex.step(felt, at(1.8))[1]) == CLOSES
    advancing = PalmReflex(DRIVE, PLACES, AHEAD)
    assert advancing.step(advancing.begin(at(0.0)), at(1.9))[1].velocity == (0.0, 0.1)
    assert advancing.step(advancing.begin(at(0.0)), at(2.0))[1].stop


def test_each_jointed_finger_goes_by_the_link_that_feels_first() -> None:
    reflex = JointedReflex(DRIVE, PLACES, radians(20.0))
    state, command = reflex.step(reflex.begin(NOTHING), at(1.0, "right_1", "left_2"))
    assert state == (Phase.WRAP, Phase.CURL)
    assert rates(command) == ((0.0, 0.5), (0.0, 0.5))
    assert command.longest == pytest.approx(radians(20.0) / 0.5)
    curled = replace(at(2.0), left=(0.4, radians(20.0)))
    state, command = reflex.step(state, curled)
    assert state == (Phase.WRAP, Phase.HOLD)
    assert rates(command) == ((0.0, 0.5), (0.5, 0.0))
    state, command = reflex.step(state, replace(curled, bits=at(0.0, "right_2").bits))
    assert (state, rates(command)) == ((Phase.HOLD, Phase.HOLD), CLOSES)
    assert reflex.step(state, replace(curled, stalled=(True, True)))[1].stop


def test_the_palm_bit_is_for_both_fingers() -> None:
    reflex = JointedReflex(DRIVE, PLACES, 0.3)
    state, _ = reflex.step(reflex.begin(NOTHING), at(1.0, "palm"))
    assert state == (Phase.WRAP, Phase.WRAP)


def policy() -> Approach:
    """From one metre below: the palm's bit leads to a grasp, the right finger's to the plan's end."""
    belief = box(-0.1, 0.9, 0.1, 1.1)
    grasp = Branch(0, belief, Close(belief, Place(0.02, -0.01, 0.0), 0.4))
    return Approach(belief, 0.1, 0.3, 0.5, 0.0, (grasp, Branch(1, belief, Lost(belief))))


def followed(*steps: tuple[tuple[float, float], tuple[str, ...]]) -> tuple[object, Command]:
    """The last state and command after the arm has been at these places and felt that."""
    reflex = FollowPolicy(DRIVE, policy(), 0.1, 0.4, 3.0)
    state, command = reflex.begin(NOTHING), Command((), ())
    for time, ((x, y), felt) in enumerate(steps):
        state, command = reflex.step(state, replace(at(float(time), *felt), arm=(x, y, 0.0)))
    return state, command


def test_a_plan_is_followed_sideways_then_forward_until_a_sensor_fires() -> None:
    _, command = followed(((0.0, 0.0), ()))
    assert command.velocity == pytest.approx((0.1, 0.0))
    assert command.longest == pytest.approx(1.0)
    _, command = followed(((0.0, 0.0), ()), ((0.1, 0.0), ()))
    assert (command.velocity, command.longest) == (pytest.approx((0.0, 0.1)), pytest.approx(3.0))
    to_approach = ((0.0, 0.0), ()), ((0.1, 0.0), ()), ((0.1, 0.3), ())
    _, command = followed(*to_approach)
    assert (command.velocity, command.longest) == (pytest.approx((0.0, 0.1)), pytest.approx(5.0))
    state, command = followed(*to_approach, ((0.1, 0.45), ("palm",)))
    assert isinstance(state.node, Close)
    assert command.velocity == pytest.approx((0.0, -0.1))
    assert state.legs[-2].to == pytest.approx((0.12, 0.44))


def test_a_plan_in_which_the_hand_turns_is_refused() -> None:
    with pytest.raises(NotCoveredError, match="does not turn"):
        FollowPolicy(DRIVE, replace(policy(), turn=0.1), 0.1, 0.4, 3.0)


def test_a_closing_on_nothing_is_followed_by_what_comes_after() -> None:
    """Both fingers at their last angle: back until below all that is left, then sideways; one held up before: the end."""
    island, other = box(-0.05, 0.5, 0.05, 0.6), box(0.9, 0.2, 1.0, 0.3)
    after = Close(other, Place(0.95, -0.3, 0.0), 0.0)
    reflex = FollowPolicy(DRIVE, Close(island, Place(0.0, 0.0, 0.0), 0.0, otherwise=after), 0.1, 0.4, 3.0)
    closed = replace(NOTHING, right=(3.0, 0.0), left=(3.0, 0.0), stalled=(True, True))
    state = reflex.begin(NOTHING)
    assert [leg.to[1] for leg in state.legs if isinstance(leg, Move)] == pytest.approx([-0.2, -0.2, 0.0])
    state = replace(state, legs=(Grab(),))
    state, command = reflex.step(state, closed)
    assert state.node == after
    assert command.velocity == pytest.approx((0.0, -0.1))
    held = replace(closed, right=(2.0, 0.0))
    assert reflex.step(replace(state, node=reflex.policy, legs=(Grab(),)), held)[1].stop


def test_a_plan_ends_where_it_knows_no_way() -> None:
    way = ((0.0, 0.0), ()), ((0.1, 0.0), ()), ((0.1, 0.3), ())
    for last, words in (
        (((0.1, 0.45), ("right_1",)), "without a grasp"),
        (((0.1, 0.45), ("left_1",)), "does not know of"),
        (((0.1, 0.8), ()), "does not know of"),
        (((0.1, 0.3), ()), "held up"),
    ):
        _, command = followed(*way, last)
        assert command.stop
        assert words in command.why


def test_the_verdict_needs_a_hold_up_and_two_bodies_or_an_empty_end() -> None:
    last, held = 3.0, replace(NOTHING, stalled=(True, True))
    between = replace(held, right=(2.0, 0.0), left=(3.0, 0.0))
    assert verdict(replace(between, bits=at(0.0, "right_1", "palm").bits), PLACES, last, False) is Verdict.CAUGHT
    assert verdict(replace(between, bits=at(0.0, "right_1", "right_2").bits), PLACES, last, False) is Verdict.UNKNOWN
    empty = replace(held, right=(3.0, 0.0), left=(3.0, 0.0))
    assert verdict(empty, PLACES, last, False) is Verdict.MISSED
    assert verdict(empty, PLACES, last, True) is Verdict.UNKNOWN


def test_every_behaviour_is_described_with_parameters_that_exist() -> None:
    assert list(DESCRIPTIONS) == list(BehaviourName)
    for each in DESCRIPTIONS.values():
        assert set(each.parameters) <= set(Behaviour.model_fields)
        assert each.steps


@pytest.mark.parametrize(("name", "links", "layout", "words"), [
    ("scoop", (0.2,), "tips", "palm"),
    ("palm_reflex", (0.2,), "none", "palm"),
    ("jointed", (0.2,), "full", "two links"),
    ("jointed", (0.1, 0.1), "palm", "links"),
])  # fmt: skip
def test_what_a_behaviour_lacks_is_named(name: str, links: tuple[float, ...], layout: str, words: str) -> None:
    case = Case(
        hand=Hand(palm_width=0.1, finger_links=links), object=Disk(radius=0.03),
        sensors=Sensors(layout=SensorLayout(layout)), behaviour=Behaviour(name=BehaviourName(name)),
    )  # fmt: skip
    with pytest.raises(NotCoveredError, match=words):
        reflex_of(case)
