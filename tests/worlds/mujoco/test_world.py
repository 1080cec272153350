"""The MuJoCo world ends as the planar one, feels as it does, and runs the same behaviours."""

from __future__ import annotations

from math import asin, atan2, hypot, radians, sqrt

import numpy as np
import pytest

from palmar.errors import NotCoveredError
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case, with_layout
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.studies.simulate import simulate_starts
from palmar.worlds.planar.bits import Sensing
from palmar.worlds.planar.feedback import feedback_world

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

from palmar.studies.simulate_in_world import simulate_starts_in
from palmar.worlds.mujoco.table_friction import TableLaw
from palmar.worlds.mujoco.world import mujoco_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_rate_deg_s = 10\n"
THICK = HAND + 'finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK = "[object]\nradius_mm = 38\n"
BOX = '[object]\nshape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
ODD = '[object]\nshape = "polygon"\nvertices_mm = [[-25, -20], [35, -10], [20, 30], [-20, 25]]\n'
FREE = '[contact]\nfriction = 0\n[support]\nkind = "free"\n'
CURL = '[behaviour]\nname = "curl_and_close"\npreshape_deg = 20.3\n'
BACK = '[behaviour]\nname = "close_coupled"\nratio = -1.0\nbend_deg = 41.0\n'
REST = (0.0, 0.0)
START = (0.01, 0.15, 0.0)


def starts(number: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform([-0.25, 0.045, -3.0], [0.25, 0.27, 3.0], (number, 3))


@pytest.mark.parametrize(
    ("text", "number", "apart", "turned"),
    [
        (HAND + DISK, 3, 4e-4, 0.01),
        (THICK + DISK, 3, 4e-4, 0.01),
        (HAND + BOX, 3, 8e-4, 0.01),
        (HAND + ODD + "[contact]\nfriction = 0\n", 2, 5e-4, 0.01),
        (HAND.replace("= 10", "= 40") + DISK + FREE, 3, 2e-3, 0.01),
        (HAND + DISK + CURL, 3, 4e-4, 0.01),
        (HAND + DISK + BACK, 3, 4e-4, 0.01),
    ],
    ids=["disk", "thick", "box", "polygon without friction", "free", "curl", "turning back"],
)
def test_closing_ends_as_in_the_planar_world(text: str, number: int, apart: float, turned: float) -> None:
    case = parse_case(text)
    rows = starts(number, 3)
    planar, other = simulate_starts(case, rows), simulate_starts_in(case, rows, mujoco_world)
    ours, theirs = ([Outcome.from_code(int(code)) for code in ends.codes] for ends in (planar, other))
    caught = [each.caught for each in ours]
    assert [each.caught for each in theirs] == caught
    assert [each for each in theirs if not each.caught] == [each for each in ours if not each.caught]
    assert sum(caught) > 1
    differences = np.abs(planar.poses - other.poses)[caught]
    assert float(np.median(np.hypot(*differences[:, :2].T))) < apart
    assert float(np.median(differences[:, 2])) < turned


def test_a_pinch_without_friction_is_held() -> None:
    """The fingers stall a little before they are flush on either side: the cones of the verdict leave that open."""
    case = parse_case(HAND + DISK + "[contact]\nfriction = 0.1\n")
    for start in ((0.183, 0.097, 0.0), (0.189, 0.1, 0.0)):
        found = simulate_starts_in(case, [start], mujoco_world)
        assert Outcome.from_code(int(found.codes[0])) in (Outcome.STRUCTURAL, Outcome.FRICTIONAL)


def pushed_away(friction: float, law: TableLaw) -> tuple[np.ndarray, np.ndarray, Outcome]:
    """Of a disk that the right tip pushes off: its final pose in the planar world and in this one, and its outcome here."""
    case = parse_case(HAND + f"open_deg = 40\n{DISK}[contact]\nfriction = {friction}\n")
    world = mujoco_world(case, (0.25, 0.2, 0.0), law=law)
    closing = Command((case.hand.finger_rate, 0.0), (case.hand.finger_rate, 0.0))
    for _ in range(100):
        world.act(closing, 0.01)
    return simulate_starts(case, [(0.25, 0.2, 0.0)]).poses[0], np.array(world.pose), world.outcome()


@pytest.mark.parametrize("friction", [0.2, 3.0])
def test_a_disk_that_a_tip_pushes_away_turns_as_the_pressure_has_it(friction: float) -> None:
    """At 0.2 the tip slides along the disk, at 3 it sticks."""
    planar, other, outcome = pushed_away(friction, TableLaw.EXACT)
    assert outcome is Outcome.ESCAPED
    assert np.hypot(*(other - planar)[:2]) < 1e-4
    assert other[2] == pytest.approx(planar[2], abs=0.005)


def test_beside_sliding_the_ellipsoid_turns_9_parts_where_the_uniform_disk_turns_16() -> None:
    """Small turns: omega = moment / (c^2 force) with c^2 = 4/9 R^2 against 1/4 R^2 (docs/derivations/limit_surface.md)."""
    planar, other, _ = pushed_away(0.05, TableLaw.ELLIPSOID)
    assert other[2] / planar[2] == pytest.approx(9.0 / 16.0, rel=0.03)


ELSEWHERE = (BehaviourName.FOLLOW_POLICY, BehaviourName.MATCH_VELOCITY, BehaviourName.MATCHED_RETURN)
"""They need a plan, and a free disk that is tracked."""


def behaving(name: BehaviourName) -> Case:
    move = f'[behaviour]\nname = "{name.value}"\nadvance_mm = 150\nspeed_mm_s = 50\nfinger_acceleration_deg_s2 = 400\n'
    return parse_case(HAND + DISK + '[sensors]\nlayout = "distributed"\n' + move)


@pytest.mark.parametrize("name", [each for each in BehaviourName if each not in ELSEWHERE])
def test_a_behaviour_ends_alike_in_both_worlds(name: BehaviourName) -> None:
    case = behaving(name)
    for x, y in np.random.default_rng(20261126).uniform([-0.15, 0.06], [0.15, 0.28], (1, 2)):
        planar, other = (
            run_behaviour(case, (float(x), float(y), 0.0), Circumstances(tick=0.02, make=make))
            for make in (feedback_world, mujoco_world)
        )
        assert other.trace.outcome is planar.trace.outcome
        assert other.trace.ended is planar.trace.ended
        whys = [tuple(dict.fromkeys(row.why for row in each.trace.rows)) for each in (planar, other)]
        assert (
            whys[0] == whys[1] or name is BehaviourName.JOINTED
        )  # which of its fingers feels first may be a close thing


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_stretch_that_a_finger_touches_with_fires(side: float) -> None:
    """Against the closed form: a line finger turning about (D, 0) meets the disk at r = sqrt(d^2 - R^2)."""
    case = with_layout(parse_case(HAND + DISK), "full", "test")
    stretches = case.sensors.stretches(case.hand)
    x, y, radius, rate = 0.18, 0.09, 0.038, case.hand.finger_rate
    d = hypot(x - 0.06, y)
    time, along = (atan2(y, x - 0.06) - asin(radius / d)) / rate, sqrt(d * d - radius * radius)
    world = mujoco_world(case, (side * x, y, 0.0))
    while not any(world.observe().bits):
        world.act(Command((rate, 0.0), (rate, 0.0)), world.tick)
    assert -0.01 <= world.time - time <= 0.01
    link, begin = (1, 0.0) if along < 0.137 else (2, 0.137)
    (firing,) = [stretches[k] for k, bit in enumerate(world.observe().bits) if bit]
    assert firing.body == f"{'right' if side > 0.0 else 'left'}_{link}"
    assert firing.begin - 1e-3 <= along - begin <= firing.end + 1e-3


@pytest.mark.parametrize("displacement", [0.0, 0.004])
def test_the_palm_feels_once_the_object_has_moved(displacement: float) -> None:
    case = with_layout(parse_case(HAND + DISK), "palm", "test")
    world = mujoco_world(case, (0.0, 0.1, 0.0), sensing=Sensing(displacement))
    while not world.observe().bits[0]:
        world.act(Command(REST, REST, (0.0, 0.05)), world.tick)
    assert world.time == pytest.approx((0.062 + displacement) / 0.05, abs=0.02)
    assert world.pose[1] - 0.1 == pytest.approx(displacement, abs=5e-4)


def test_arm_and_joints_go_as_far_as_they_are_told() -> None:
    world = mujoco_world(parse_case(HAND + DISK), (0.0, 0.6, 0.0))
    held = world.act(Command((0.5, 0.2), (0.3, -0.1), (0.04, -0.02)), 1.0)
    world.act(Command(REST, REST), 0.1)
    seen = world.observe()
    assert held == 1.0 and seen.time == pytest.approx(1.1)
    assert seen.arm == pytest.approx((0.04, -0.02, 0.0), abs=1e-6)
    assert (*seen.right, *seen.left) == pytest.approx((0.5, 0.2, 0.3, -0.1), abs=1e-5)
    assert world.act(Command(REST, REST, (0.0, 0.1), longest=0.0123), 0.1) == 0.0123
    world.act(Command(REST, REST), 0.1)
    assert world.observe().arm[1] == pytest.approx(-0.02 + 0.00123, abs=1e-6)
    assert world.settled


def test_fingers_stop_at_limits_on_the_palm_and_where_they_meet() -> None:
    limited = parse_case(HAND + "joint_limits_deg = [[0, 120], [-10, 30]]\n" + DISK)
    world = mujoco_world(limited, (0.0, 0.6, 0.0))
    for _ in range(40):
        world.act(Command((1.0, 1.0), (1.0, -1.0)), 0.1)
    assert np.degrees(world.servos.angles) == pytest.approx(np.array([[120.0, 30.0], [120.0, -10.0]]), abs=0.02)
    assert world.observe().stalled == (True, True)
    for text, met in ((HAND, 180.0), (THICK, 101.24)):
        world = mujoco_world(parse_case(text + DISK), (0.0, 0.6, 0.0))
        while not all(world.observe().stalled):
            world.act(Command((radians(40.0), 0.0), (radians(40.0), 0.0)), 0.02)
        assert np.degrees([each[0] for each in world.servos.angles]) == pytest.approx([met, met], abs=0.1)
        assert world.outcome() is Outcome.MISSED


def test_a_finger_told_to_turn_is_held_up_and_not_driven_back() -> None:
    """Each finger presses in turn on a disk that the other one, held by its gear, keeps; then the arm takes it along."""
    case = parse_case(HAND + DISK + "[contact]\nfriction = 0.7\n")
    world = mujoco_world(case, (0.0, 0.1, 0.0))
    rate = case.hand.finger_rate
    while not all(world.observe().stalled):
        world.act(Command((rate, 0.0), (rate, 0.0)), 0.02)
    held = np.array(world.servos.angles)
    assert world.outcome() is Outcome.FRICTIONAL
    for command in (Command((rate, 0.0), REST), Command(REST, (rate, 0.0))):
        world.act(command, 0.5)
        assert np.abs(np.array(world.servos.angles) - held).max() < 0.02
    carried = np.array(world.pose)
    world.act(Command(REST, REST, (0.1, -0.05)), 1.0)
    assert np.array(world.pose)[:2] - carried[:2] == pytest.approx((0.1, -0.05), abs=1e-3)
    assert world.outcome() is Outcome.FRICTIONAL
    world.act(Command((-rate, 0.0), (-rate, 0.0)), 1.0)
    assert not world.outcome().caught


def test_a_load_does_not_drive_a_joint_back() -> None:
    world = mujoco_world(parse_case(HAND + DISK), (0.0, 0.6, 0.0))
    closing = Command((0.3, 0.0), (0.3, 0.0))
    world.act(closing, 0.5)
    world.data.qfrc_applied[2] = -2.0 * world.servos.torque
    world.act(closing, 0.5)
    right, left = (each[0] for each in world.servos.angles)
    assert right == pytest.approx(0.15, abs=5e-3)
    assert left == pytest.approx(0.3, abs=5e-3)
    assert world.observe().stalled == (True, False)


def test_starts_that_overlap_the_hand_are_invalid() -> None:
    world = mujoco_world(parse_case(HAND + DISK), (0.1, 0.037, 0.0))
    assert world.broken and world.outcome() is Outcome.INVALID
    assert world.pose == pytest.approx((0.1, 0.037, 0.0))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HAND + DISK + "[support]\nwall_mm = 300\n", "no wall"),
        (HAND + BOX + '[support]\nkind = "free"\n', "only disks"),
        (HAND + "finger_mass_kg = 0.2\n" + DISK + FREE, "heavy fingers"),
        (HAND.replace("137, 107", "60, 60, 60, 60") + DISK, "at most 3 links"),
        (HAND + DISK + '[contact]\nfriction = "0.2..0.8"\n', "ranges"),
        (HAND + BOX.replace("20]", "1]"), "thinner"),
    ],
)
def test_what_is_not_covered_is_said_in_a_line(text: str, words: str) -> None:
    with pytest.raises(NotCoveredError, match=words):
        mujoco_world(parse_case(text), START)


def test_a_massive_object_stops_the_arm_and_lets_it_go() -> None:
    case = with_layout(parse_case(HAND + DISK), "palm", "test")
    world = mujoco_world(case, (0.01, 0.1, 0.0), massive=True)
    for _ in range(160):
        world.act(Command(REST, REST, (0.0, 0.1)), world.tick)
    assert world.pose == pytest.approx((0.01, 0.1, 0.0), abs=1e-5)
    assert world.observe().arm[1] == pytest.approx(0.062, abs=3e-4)
    assert world.observe().bits == (True,)
    world.act(Command(REST, REST, (0.1, -0.1)), 0.1)
    assert world.observe().arm[:2] == pytest.approx((0.01, 0.052), abs=6e-4)
    assert world.observe().bits == (False,)
    while not all(world.observe().stalled):
        world.act(Command((0.2, 0.0), (0.2, 0.0)), 0.02)
    assert world.pose[0] == pytest.approx(0.01, abs=1e-3)
    assert world.outcome().caught
