"""The planar world under feedback: it ends as the batch kernel does, whatever the tick, and feels what there is."""

from __future__ import annotations

from math import asin, atan2, hypot, pi, sqrt

import numpy as np
import pytest
from shapely import LineString, Point, affinity

from palmar.behaviours.close import Closing
from palmar.behaviours.move_and_grab import MoveAndGrab
from palmar.behaviours.move_while_closing import MoveWhileClosing
from palmar.behaviours.reflex import Advance, Drive
from palmar.errors import NotCoveredError
from palmar.faces.plots.hand import finger_points
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.case import Case
from palmar.models.case_file import parse_case, with_layout
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.regions.moving import ArmMotion, caught
from palmar.worlds.planar.bits import Sensing
from palmar.worlds.planar.feedback import FeedbackWorld, feedback_world
from palmar.worlds.planar.stepping import stepping_world
from palmar.worlds.run import Ended, Trace, run

LINE = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\n"
THICK = f'{LINE}finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK = "[object]\nradius_mm = 38\n[contact]\nfriction = 0.7\n"
BOX = '[object]\nshape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
WALL = "[support]\nwall_mm = 300\n"
CASES = {name: parse_case(text) for name, text in (
    ("line disk", LINE + DISK), ("thick disk", THICK + DISK), ("line box", LINE + BOX), ("thick box", THICK + BOX),
    ("disk and wall", LINE + DISK + WALL), ("box and wall", LINE + BOX + WALL),
)}  # fmt: skip
REST = (0.0, 0.0)


def closed(case: Case, start: tuple[float, float, float], tick: float) -> tuple[FeedbackWorld, Trace]:
    world = feedback_world(case, start, tick=tick)
    trace = run(world, Closing(Drive(2, case.hand.finger_rate)))
    assert trace.ended is Ended.STOPPED
    return world, trace


def random_starts(number: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform([-0.25, 0.06, -3.0], [0.25, 0.25, 3.0], (number, 3))


@pytest.mark.parametrize("name", CASES)
def test_closing_ends_as_in_the_batch_kernel(name: str) -> None:
    case, starts = CASES[name], random_starts(16, 4)
    ends = stepping_world(case).ends(starts)
    for k, start in enumerate(starts):
        world, trace = closed(case, tuple(start), (0.02, 0.1)[k % 2])
        assert trace.outcome is Outcome.from_code(int(ends.codes[k]))
        assert not world.ambiguous
        if trace.outcome.caught:
            assert world.pose == pytest.approx(ends.poses[k], abs=6e-6)
            assert [each[0] for each in world.angles] == pytest.approx(ends.fingers[k], abs=3e-6)


@pytest.mark.parametrize("name", CASES)
def test_the_end_does_not_depend_on_the_tick(name: str) -> None:
    start = (0.12, 0.11, 0.4)
    ends = [closed(CASES[name], start, tick)[0].pose for tick in (0.2, 0.05, 0.01)]
    assert ends[1] == pytest.approx(ends[0], abs=6e-6)
    assert ends[2] == pytest.approx(ends[1], abs=6e-6)


def test_moving_and_grabbing_is_closing_from_where_the_hand_then_is() -> None:
    case = with_layout(CASES["line disk"], "full", "test")
    move = Advance(0.05, 0.2, np.pi / 2)
    batch, rng, tried = stepping_world(case), np.random.default_rng(8), 0
    while tried < 8:
        x, y = rng.uniform(-0.2, 0.2), rng.uniform(0.1, 0.25)
        world = feedback_world(case, (x, y, 0.0), tick=0.03)
        trace = run(world, MoveAndGrab(Drive(2, case.hand.finger_rate), move), ("",) * 50)
        if any(any(row.seen.bits) for row in trace.rows if row.seen.time <= move.duration):
            continue
        tried += 1
        end = batch.ends([[x, y - 0.05, 0.0]])
        assert trace.outcome is Outcome.from_code(int(end.codes[0]))
        if trace.outcome.caught:
            assert np.array(world.pose) - (0.0, 0.05, 0.0) == pytest.approx(end.poses[0], abs=1e-6)
        assert world.observe().arm == pytest.approx((0.0, 0.05, 0.0), abs=1e-12)


@pytest.mark.parametrize(("displacement", "distance"), [(0.0, 0.062), (0.004, 0.066)])
def test_the_palm_feels_at_the_tick_after_the_touch(displacement: float, distance: float) -> None:
    case = with_layout(CASES["line disk"], "palm", "test")
    world = feedback_world(case, (0.0, 0.1, 0.0), tick=0.007, sensing=Sensing(displacement))
    while not world.observe().bits[0]:
        world.act(Command(REST, REST, (0.0, 0.1)), world.tick)
    assert 0.0 <= world.time - distance / 0.1 + 1e-9 <= world.tick
    assert world.pose[1] - world.observe().arm[1] == pytest.approx(0.038, abs=1e-7)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_stretch_that_a_finger_touches_with_fires(side: float) -> None:
    """Against the closed form: a line finger turning about (D, 0) meets the disk at r = sqrt(d^2 - R^2)."""
    case = with_layout(CASES["line disk"], "full", "test")
    stretches = case.sensors.stretches(case.hand)
    x, y, radius, rate = 0.18, 0.09, 0.038, case.hand.finger_rate
    d = hypot(x - 0.06, y)
    time, along = (atan2(y, x - 0.06) - asin(radius / d)) / rate, sqrt(d * d - radius * radius)
    world = feedback_world(case, (side * x, y, 0.0))
    while not any(world.observe().bits):
        world.act(Command((rate, 0.0), (rate, 0.0)), world.tick)
    assert 0.0 <= world.time - time <= world.tick
    body = "right" if side > 0.0 else "left"
    link, begin = (1, 0.0) if along < 0.137 else (2, 0.137)
    (firing,) = [stretches[k] for k, bit in enumerate(world.observe().bits) if bit]
    assert firing.body == f"{body}_{link}"
    assert firing.begin - 1e-3 <= along - begin <= firing.end + 1e-3


def test_missed_and_false_bits_are_drawn_from_the_seed() -> None:
    case = with_layout(CASES["line disk"], "distributed", "test")

    def firings(sensing: Sensing) -> list[tuple[bool, ...]]:
        world = feedback_world(case, (0.15, 0.06, 0.0), sensing=sensing)
        seen = []
        for _ in range(300):
            world.act(Command((0.5, 0.0), (0.5, 0.0)), world.tick)
            seen.append(world.observe().bits)
        return seen

    assert any(map(any, firings(Sensing())))
    assert not any(map(any, firings(Sensing(missed=1.0))))
    false = Sensing(missed=1.0, false_rate=2.0, seed=3)
    drawn = firings(false)
    assert drawn == firings(false)
    assert drawn != firings(Sensing(missed=1.0, false_rate=2.0, seed=4))
    assert np.sum(drawn) == pytest.approx(13 * 1.5 * 2.0, abs=4.0 * sqrt(39.0))


def test_a_massive_object_stops_the_arm_and_lets_it_go() -> None:
    case = with_layout(CASES["line disk"], "palm", "test")
    pushed, stays = (feedback_world(case, (0.01, 0.1, 0.0), massive=massive) for massive in (False, True))
    for world in (pushed, stays):
        for _ in range(160):
            world.act(Command(REST, REST, (0.0, 0.1)), world.tick)
    assert pushed.pose[1] == pytest.approx(0.118, abs=1e-8)
    assert stays.pose == (0.01, 0.1, 0.0)
    assert stays.observe().arm[1] == pytest.approx(0.062, abs=1e-8)
    assert stays.settled and stays.observe().bits == (True,)
    stays.act(Command(REST, REST, (0.1, -0.1)), 0.1)
    assert stays.observe().arm[:2] == pytest.approx((0.01, 0.052), abs=1e-8)
    assert stays.observe().bits == (False,)


def test_an_object_that_is_held_goes_with_the_arm() -> None:
    world, trace = closed(CASES["line disk"], (0.02, 0.1, 0.0), 0.02)
    assert trace.outcome is Outcome.FRICTIONAL
    held, rates = np.array(world.pose), world.fingers.told
    world.act(Command(*rates, (0.1, -0.2)), 0.5)
    world.act(Command(REST, REST, (0.1, 0.0)), 0.5)
    assert np.array(world.pose) - held == pytest.approx((0.1, -0.1, 0.0), abs=1e-12)
    assert world.outcome() is Outcome.FRICTIONAL
    world.act(Command((-0.5, 0.0), (-0.5, 0.0)), 0.5)
    assert not world.outcome().caught


def test_fingers_stop_where_they_meet_and_part_again() -> None:
    case = CASES["thick disk"]
    world = feedback_world(case, (0.0, 0.6, 0.0), tick=0.05)
    while not all(world.observe().stalled):
        world.act(Command((0.5, 0.0), (0.4, 0.0)), 0.05)
    met = world.angles
    world.act(Command((0.5, 0.0), (0.4, 0.0)), 0.5)
    assert world.angles == met
    fingers = [LineString(finger_points(case.hand, each, left=k == 1)) for k, each in enumerate(met)]
    assert fingers[0].distance(fingers[1]) == pytest.approx(0.025, abs=1e-8)
    world.act(Command((-0.5, 0.0), (-0.4, 0.0)), 0.5)
    assert [each[0] for each in world.angles] == pytest.approx([met[0][0] - 0.25, met[1][0] - 0.2])


def test_joints_stop_at_their_limits_and_links_on_the_palm() -> None:
    limited = parse_case(f"{LINE}joint_limits_deg = [[0, 120], [-10, 30]]\n{DISK}")
    world = feedback_world(limited, (0.0, 0.6, 0.0), tick=0.1)
    for _ in range(40):
        world.act(Command((1.0, 1.0), (1.0, -1.0)), 0.1)
    assert np.degrees(world.angles) == pytest.approx(np.array([[120.0, 30.0], [120.0, -10.0]]), abs=1e-6)
    assert world.settled and world.observe().stalled == (True, True)
    curled = feedback_world(CASES["line disk"], (0.0, 0.6, 0.0), tick=0.1)
    for _ in range(60):
        curled.act(Command((1.0, 0.5), (1.0, 0.5)), 0.1)
    (_, knuckle, tip) = finger_points(CASES["line disk"].hand, curled.angles[0])
    assert knuckle[1] > 0.01
    assert tip[1] == pytest.approx(0.0, abs=1e-9)


def test_a_start_inside_the_hand_is_invalid_and_goes_nowhere() -> None:
    world = feedback_world(CASES["line disk"], (0.0, 0.02, 0.0))
    trace = run(world, Closing(Drive(2, 0.5)))
    assert (trace.outcome, trace.ended) == (Outcome.INVALID, Ended.BROKEN)
    assert world.time == 0.0


@pytest.mark.parametrize("massive", [False, True])
@pytest.mark.parametrize("name", ["line disk", "thick disk"])
def test_whatever_the_commands_the_hand_never_enters_the_object(name: str, massive: bool) -> None:
    case, rng = CASES[name], np.random.default_rng(6)
    apart = case.hand.half_thickness + 0.038
    for start in random_starts(6, 9):
        world = feedback_world(case, tuple(start), massive=massive)
        for _ in range(20):
            rates = rng.uniform(-1.5, 1.5, (2, 2)) * (rng.uniform(size=(2, 1)) < 0.7)
            velocity = rng.uniform(-0.2, 0.2, 2) * (rng.uniform() < 0.6)
            for _ in range(6):
                world.act(Command(tuple(rates[0]), tuple(rates[1]), tuple(velocity)), 0.03)
            assert not world.broken
            x, y, _ = world.pose
            dx, dy, _ = world.observe().arm
            for side in (0, 1):
                finger = affinity.translate(
                    LineString(finger_points(case.hand, world.angles[side], left=side == 1)), dx, dy
                )
                assert finger.distance(Point(x, y)) >= apart - 1e-7


def test_moving_against_a_wall_ends_as_in_the_batch_kernel() -> None:
    case = parse_case(LINE + DISK.replace("0.7", "0.3") + "[support]\nwall_mm = 300\n", "wall")
    arm = ArmMotion(0.05, 0.08)
    starts = np.random.default_rng(5).uniform([-0.3, 0.06, 0.0], [0.3, 0.262, 0.0], (8, 3))
    body = slider_body(slider_of(case.object, case.support), case.contact.friction)
    expected = caught(straight_motion(case.hand, case.support.wall), body, starts, arm)
    drive = Drive(2, case.hand.finger_rate)
    speed = arm.per_radian * case.hand.finger_rate
    for start, held in zip(starts, expected, strict=True):
        world = feedback_world(case, tuple(start), tick=0.05)
        run(world, MoveWhileClosing(drive, Advance(1.0, speed, 0.5 * pi), arm.first))
        assert world.outcome().caught == held
        y = world.carriage.palm_ahead(world.angles)
        assert y == pytest.approx(case.palm_ahead(*world.angles, world.carriage.arm[1]), abs=1e-12)
    assert 0 < expected.sum() < 8


def test_what_is_held_is_not_carried_into_the_wall() -> None:
    case = parse_case(LINE + DISK + "[support]\nwall_mm = 250\n", "wall")
    world = feedback_world(case, (0.0, 0.1, 0.0))
    run(world, Closing(Drive(2, case.hand.finger_rate)))
    assert world.outcome().caught
    still = (0.0, 0.0)
    for _ in range(100):
        world.act(Command(still, still, (0.0, 0.2)), 0.02)
    assert world.pose[1] <= 0.25 - 0.038 + 1e-9


def test_an_object_that_stays_needs_no_wall() -> None:
    with pytest.raises(NotCoveredError, match="wall_mm"):
        feedback_world(CASES["disk and wall"], (0.0, 0.1, 0.0), massive=True)
