"""The test bed's motors go where they are told, feel contacts by their duty, and hold what they have caught."""

from __future__ import annotations

from math import exp, pi, tau

import numpy as np
import pytest

from palmar.errors import InputError, NotCoveredError
from palmar.mechanics.pushing.limit_surface import disk_surface, secant_metric
from palmar.mechanics.pushing.metric import times
from palmar.models.case_file import parse_case
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.studies.simulate import simulate_start

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

from palmar.worlds.mujoco.bed_servos import BedServos, Move
from palmar.worlds.mujoco.stiction import stiction_of
from palmar.worlds.mujoco.world import BedWorld, bed_world, mujoco_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_rate_deg_s = 15\n"
THICK = 'finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK = "[object]\nradius_mm = 38\n"
REST = Command((0.0, 0.0), (0.0, 0.0))
FAR = (0.0, 1.0, 0.0)


def motors(world: BedWorld) -> BedServos:
    assert isinstance(world.servos, BedServos)
    return world.servos


@pytest.mark.parametrize("counts", [40_000, 360])
def test_joints_go_where_they_are_told_to_an_encoder_count(counts: int) -> None:
    bed = f"[bed]\ncounts = {counts}\nderivative = 0.1\ncoupled = false\n"
    world = bed_world(parse_case(HAND + DISK + bed), FAR)
    servos, final = motors(world), np.array([0.5, 0.2, 0.3, -0.1])
    moves = [Move(each, 1.0, 0.8) for each in final]
    servos.move(((moves[0], moves[1]), (moves[2], moves[3])))
    servos.go(0.5, 1e-3)
    half = np.ravel(servos.angles)
    servos.go(2.0, 1e-3)
    off = np.abs(np.ravel(servos.angles) - final)
    assert 0.35 * 0.5 < half[0] < 0.55 * 0.5
    assert off.max() <= tau / counts + 4e-4
    assert (off.max() > 2e-3) == (counts == 360)  # what lies within a count is not seen


def test_a_motor_of_little_duty_stalls_on_the_disk_and_tells_of_a_contact() -> None:
    """Duty 0.15 of 3 N m is 3 N at 150 mm; sliding takes 2.9 N at a lever of 0.2 m. Duty 0.8 is enough."""
    ends = []
    for duty in (0.15, 0.8):
        case = parse_case(HAND + "open_deg = 20\n" + DISK)
        world = bed_world(case, (0.2, 0.12, 0.0))
        servos = motors(world)
        away = Move(case.hand.open, 1.0, 0.8), Move(0.0, 1.0, 0.8)
        servos.move(((Move(1.2, 2.0, duty), Move(0.0, 2.0, 0.8)), away))
        servos.go(1.5, 1e-3)
        ends.append((servos.contact(0), servos.contact(1), world.pose[0]))
        assert np.abs(servos.duty[0]) <= duty
    assert ends[0] == (True, False, pytest.approx(0.2, abs=1e-4))
    assert ends[1][:2] == (False, False) and ends[1][2] < 0.19


def test_thick_fingers_catch_as_the_kernels_have_it_and_hold_without_creep() -> None:
    case = parse_case(HAND + "open_deg = 20\n" + THICK + DISK)
    start = 0.15, 0.12, 0.0
    world, rate = bed_world(case, start), case.hand.finger_rate
    closing = Command((rate, 0.0), (rate, 0.0))
    while not all(world.observe().stalled):
        world.act(closing, 0.02)
    planar = simulate_start(case, start)
    assert world.outcome() is planar.outcome is Outcome.FRICTIONAL
    assert np.hypot(*np.subtract(world.pose, planar.pose)[:2]) < 1.5e-3
    assert world.pose[2] == pytest.approx(planar.pose[2], abs=0.03)
    assert max(abs(each[1]) for each in world.servos.angles) < 3e-3  # the coupling gives way a little
    before = np.array(world.pose)
    world.act(closing, 2.0)
    assert np.abs(np.array(world.pose) - before)[:2].max() < 1e-4
    assert world.outcome() is Outcome.FRICTIONAL


def test_a_hose_slows_a_puck_and_stops_its_turning() -> None:
    free = '[contact]\nfriction = 0\n[support]\nkind = "free"\n[start]\nvelocity_mm_s = [100, 0]\n'
    world = mujoco_world(parse_case(HAND + DISK + free + "[bed]\nhose_drag_N_s_m = 0.5\nspin_limit_deg = 90\n"), FAR)
    world.data.qvel[world.first + 2] = 6.0
    world.act(REST, 0.5)
    assert world.pose[0] == pytest.approx(0.1 * (1.0 - exp(-0.25)) / 0.5, rel=1e-3)
    assert world.data.qvel[world.first] == pytest.approx(0.1 * exp(-0.25), rel=1e-3)
    assert abs(world.pose[2]) <= 0.5 * pi + 0.01


def test_an_impact_that_tilts_a_puck_takes_part_of_the_speed_that_it_gave() -> None:
    """The palm gives a puck 0.2 + 0.16 m/s at restitution 0.8: a loss of a tenth leaves 0.16 - 0.036, one of all nothing."""
    free = '[contact]\nfriction = 0\nrestitution = 0.8\n[support]\nkind = "free"\n[start]\nvelocity_mm_s = [0, -200]\n'
    for loss, left in ((0.0, 0.16), (0.1, 0.124), (1.0, 0.0)):
        world = mujoco_world(parse_case(HAND + DISK + free + f"[bed]\ntilt_loss = {loss}\n"), (0.0, 0.04, 0.0))
        world.act(REST, 0.05)
        assert world.data.qvel[world.first + 1] == pytest.approx(left, abs=2e-4)


@pytest.mark.parametrize("ratio", [1.0, 1.5])
def test_stiction_holds_what_is_slow(ratio: float) -> None:
    """A disk is slowed as mu g (1 + (s - 1) exp(-v / v_s)) has it: at 50 mm/s hardly more than without."""
    case = parse_case(HAND + DISK + f"[bed]\nstiction = {ratio}\nstiction_speed_mm_s = 10\n")
    step, slide = 1e-4, 0.3 * 9.81
    for speed in (0.05, 0.005):
        world = mujoco_world(case, FAR, step=step)
        world.data.qvel[world.first] = speed
        for _ in range(5):
            world.servos.go(step, step)
            speed /= 1.0 + step * slide * (1.0 + (ratio - 1.0) * exp(-speed / 0.01)) / speed  # as dampers, implicitly
        assert world.data.qvel[world.first] == pytest.approx(speed, rel=5e-3)


def test_stiction_resists_turning_more_than_sliding() -> None:
    """Points near the centre of rotation are slow: against the integral over the disk, on a grid."""
    surface, radius = disk_surface(0.038), 0.038
    sticky = stiction_of(surface, 1.5, 2e-3)
    assert sticky is not None and stiction_of(surface, 1.0, 2e-3) is None
    twist = 1e-3, 5e-4, 0.1
    found = times(sticky.added_to(secant_metric(surface, *twist), *twist), *twist)
    x, y = np.meshgrid(*(np.linspace(-radius, radius, 801),) * 2)
    x, y = (each[x * x + y * y < radius * radius] for each in (x, y))
    u, v = twist[0] - twist[2] * y, twist[1] + twist[2] * x
    speed = np.hypot(u, v)
    share = (1.0 + 0.5 * np.exp(-speed / 2e-3)) / speed / len(x)
    exact = (share @ u), (share @ v), (share @ (x * v - y * u))
    assert found == pytest.approx(exact, rel=5e-3)
    assert times(secant_metric(surface, *twist), *twist)[2] < 0.95 * exact[2]


def test_misuse_is_said_in_a_line() -> None:
    limit = "must not be more than duty_limit"
    for line, words in (("threshold = 0.9", limit), ("counts = 1.5", "counts"), ("coupld = true", "coupled")):
        with pytest.raises(InputError, match=words):
            parse_case(HAND + DISK + f"[bed]\n{line}\n")
    with pytest.raises(NotCoveredError, match="wrist is fixed"):
        bed_world(parse_case(HAND + DISK), FAR).act(Command((0.0, 0.0), (0.0, 0.0), (0.1, 0.0)), 0.1)
