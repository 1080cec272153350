"""Free disks under feedback: tick by tick as the capture kernel at one go, felt where they strike, moved as Galileo says."""

from __future__ import annotations

from math import asin, atan2, hypot, pi, sqrt

import numpy as np
import pytest

from palmar.behaviours.close import Closing
from palmar.behaviours.reflex import Drive
from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_state import SPIN
from palmar.models.case import Case
from palmar.models.case_file import parse_case, with_layout
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.worlds.planar.bits import Sensing
from palmar.worlds.planar.free import free_world
from palmar.worlds.planar.free_feedback import FreeFeedbackWorld, free_feedback_world
from palmar.worlds.planar.tracker import Tracker
from palmar.worlds.run import Ended, run

LINE = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\n"
THICK = f'{LINE}finger_thickness_mm = 25\nfingers = "colliding"\n'
REST = (0.0, 0.0)


def case_of(hand: str = LINE, e: float = 1.0, friction: float = 0.0, layout: str = "none") -> Case:
    text = f"{hand}[object]\nradius_mm = 38\n[contact]\nfriction = {friction}\nrestitution = {e}\n"
    return with_layout(parse_case(f'{text}[support]\nkind = "free"\n'), layout, "test")


def with_velocity(case: Case, vx: float, vy: float) -> Case:
    return case.model_copy(update={"start": case.start.model_copy(update={"velocity": (vx, vy)})})


def world_of(case: Case, x: float, y: float, vx: float = 0.0, vy: float = 0.0, **given: object) -> FreeFeedbackWorld:
    return free_feedback_world(with_velocity(case, vx, vy), (x, y, 0.0), **given)


def close_for(world: FreeFeedbackWorld, rate: float, seconds: float) -> None:
    while world.time < seconds - 1e-12:
        world.act(Command((rate, 0.0), (rate, 0.0)), min(world.tick, seconds - world.time))


HANDS = {
    "line": (LINE, 0.0),
    "thick": (THICK, 0.0),
    "rough": (LINE, 0.7),
    "light": (f"{THICK}finger_mass_kg = 0.5\n", 0.0),
}


@pytest.mark.parametrize("e", [1.0, 0.7, 0.0])
@pytest.mark.parametrize("name", HANDS)
def test_closing_ends_as_the_kernel_does_at_one_go(name: str, e: float) -> None:
    """The same outcome from 20 starts each, 240 in all, half of them moving; the place at the verdict, per impact."""
    hand, friction = HANDS[name]
    case, rng = case_of(hand, e, friction), np.random.default_rng(int(10 * e) + len(name))
    starts = np.column_stack([rng.uniform(-0.25, 0.25, 20), rng.uniform(0.04, 0.3, 20), rng.normal(0.0, 0.02, (20, 2))])
    starts[::2, 2:] = 0.0
    batch = free_world(case)
    whole = capture_all(batch.hand, starts[:, :2], starts[:, 2:], e, law=batch.law)
    for k, start in enumerate(starts):
        world = world_of(case, *start, tick=(0.02, 0.1)[k % 2])
        trace = run(world, Closing(Drive(2, case.hand.finger_rate)))
        expected = Outcome.from_code(int(whole.codes[k]))
        assert trace.outcome is expected
        if not expected.caught:
            continue
        end, (x, y, theta) = whole.ends[k], batch.trace([*start[:2], 0.0, *start[2:]], 200).poses[-1]
        world = world_of(case, *start, tick=(0.02, 0.1)[k % 2])
        close_for(world, case.hand.finger_rate, float(end[5]))
        assert world.pose[:2] == pytest.approx((x, y), abs=1e-12 * 1.3 ** end[6])
        moves = (*world.carriage.track[2:], world.carriage.at.state[SPIN])
        assert moves == pytest.approx(end[2:5], abs=1e-11 * 1.3 ** end[6])
        assert world.pose[2] == pytest.approx(theta, abs=1e-3)


def test_what_is_shut_in_and_squeezed_holds_the_fingers_up() -> None:
    for e in (1.0, 0.7, 0.0):
        world = world_of(case_of(e=e), 0.02, 0.12)
        trace = run(world, Closing(Drive(2, 0.5)))
        assert (trace.ended, trace.outcome) == (Ended.STOPPED, Outcome.CAGED)
        assert max(each[0] for each in world.angles) < pi - 0.1
        assert world.carriage.pressed and world.observe().stalled == (True, True)
        place = np.array(world.pose)
        world.act(Command((0.5, 0.0), (0.5, 0.0), (0.1, 0.0)), 0.5)
        assert np.array(world.pose) - place == pytest.approx([0.05, 0.0, 0.0], abs=1e-12)
        world.act(Command((-0.5, 0.0), (-0.5, 0.0)), 0.1)
        assert not world.carriage.pressed and not any(world.observe().stalled)


def test_an_arm_in_motion_is_a_disk_in_motion() -> None:
    """A hand that moves at u before a disk at w, seen from it, is a hand at rest before a disk at w - u; at any time."""
    case, rng = case_of(e=0.7), np.random.default_rng(4)
    for _ in range(12):
        x, y = rng.uniform(-0.2, 0.2), rng.uniform(0.06, 0.25)
        u, w = rng.normal(0.0, 0.03, 2), rng.normal(0.0, 0.03, 2)
        moving, still = world_of(case, x, y, *w, tick=0.05), world_of(case, x, y, *(w - u), tick=0.02)
        if moving.broken:
            continue
        for _ in range(40):
            moving.act(Command((0.5, 0.0), (0.5, 0.0), (u[0], u[1])), 0.1)
        close_for(still, 0.5, 4.0)
        seen = np.array(moving.pose[:2]) - moving.observe().arm[:2]
        assert seen == pytest.approx(still.pose[:2], abs=1e-9)
        assert moving.observe().arm[:2] == pytest.approx(4.0 * u, abs=1e-12)
        assert moving.outcome().caught is still.outcome().caught


def test_what_becomes_of_a_disk_is_asked_of_an_arm_that_stops() -> None:
    """A palm on its way to a disk at rest will not touch it if it stops; one that a disk flies to is touched."""
    for velocity, expected in ((0.1, Outcome.MISSED), (0.0, Outcome.MISSED)):
        world = world_of(case_of(), 0.0, 0.2)
        world.act(Command(REST, REST, (0.0, velocity)), 0.1)
        assert world.outcome() is expected
    coming = world_of(case_of(), 0.0, 0.2, 0.0, -0.1)
    assert coming.outcome() is Outcome.ESCAPED


def test_an_arm_that_stops_leaves_the_disk_its_velocity() -> None:
    world = world_of(case_of(), 0.0, 0.3, 0.01, -0.02)
    for velocity in ((0.05, 0.02), (0.0, 0.0), (-0.1, 0.03)):
        world.act(Command(REST, REST, velocity), 0.4)
        assert world.carriage.track == pytest.approx(
            (0.01 * world.time, 0.3 - 0.02 * world.time, 0.01, -0.02), abs=1e-15
        )


@pytest.mark.parametrize("e", [1.0, 0.5, 0.0])
def test_the_palm_drives_a_disk_that_it_runs_into(e: float) -> None:
    """Met at u, a disk at rest leaves at (1 + e) u; without restitution it stays on the palm, and is felt there."""
    world, felt = world_of(case_of(e=e, layout="palm"), 0.0, 0.1, tick=0.01), []
    for _ in range(100):
        world.act(Command(REST, REST, (0.0, 0.1)), world.tick)
        felt.append(world.observe().bits[0])
    assert world.carriage.track[2:] == pytest.approx((0.0, 0.1 * (1.0 + e)), abs=1e-12)
    first = felt.index(True)
    assert 0.0 <= (first + 1) * 0.01 - 0.62 + 1e-9 <= 0.01
    assert felt[first:] == ([True] * (100 - first) if e == 0.0 else [True] + [False] * (99 - first))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_stretch_that_a_finger_strikes_with_fires(side: float) -> None:
    """Against the closed form: a line finger turning about (D, 0) meets the disk at r = sqrt(d^2 - R^2)."""
    case = case_of(layout="full")
    stretches = case.sensors.stretches(case.hand)
    rng, rate, found = np.random.default_rng(9), 0.5, set()
    for _ in range(12):
        x, y, radius = rng.uniform(0.1, 0.26), rng.uniform(0.045, 0.12), 0.038
        d = hypot(x - 0.06, y)
        time, along = (atan2(y, x - 0.06) - asin(radius / d)) / rate, sqrt(d * d - radius * radius)
        if not 0.0 < along < 0.244 or time < 0.0:
            continue
        world = world_of(case, side * x, y)
        while not any(world.observe().bits) and world.time < 10.0:
            world.act(Command((rate, 0.0), (rate, 0.0)), world.tick)
        assert 0.0 <= world.time - time <= world.tick
        (firing,) = [stretches[k] for k, bit in enumerate(world.observe().bits) if bit]
        link, begin = (1, 0.0) if along < 0.137 else (2, 0.137)
        assert firing.body == f"{'right' if side > 0.0 else 'left'}_{link}"
        assert firing.begin - 1e-9 <= along - begin <= firing.end + 1e-9
        found.add(firing.body)
    assert len(found) == 2


def test_missed_bits_are_missed_and_false_ones_fire() -> None:
    case = case_of(e=0.0, layout="palm")

    def firings(sensing: Sensing) -> int:
        world = world_of(case, 0.0, 0.06, 0.0, -0.1, sensing=sensing)
        count = 0
        for _ in range(400):
            world.act(Command(REST, REST), world.tick)
            count += world.observe().bits[0]
        return count

    assert firings(Sensing()) == pytest.approx(400 * (2.0 - 0.22) / 2.0, abs=1)
    assert firings(Sensing(missed=1.0)) == 0
    assert firings(Sensing(missed=1.0, false_rate=10.0, seed=2)) == pytest.approx(20, abs=14)


def test_joints_bend_about_a_disk() -> None:
    """Curled distal links come down on a disk before the palm that straight fingers would shut out of reach for."""
    case, bent = case_of(e=0.0), world_of(case_of(e=0.0), 0.0, 0.1)
    while not all(bent.observe().stalled) and bent.time < 20.0:
        bent.act(Command((0.4, 0.2), (0.4, 0.2)), bent.tick)
    assert bent.outcome().caught and bent.carriage.pressed
    assert bent.angles[0][1] == pytest.approx(0.5 * bent.angles[0][0], abs=1e-9)
    (x, y, _), hand = bent.pose, case.hand
    for side in (1.0, -1.0):
        px, py, direction = hand.half_palm, 0.0, 0.0
        for length, joint in zip(hand.finger_links, bent.angles[0], strict=True):
            direction += joint
            along = np.clip((side * x - px) * np.cos(direction) + (y - py) * np.sin(direction), 0.0, length)
            gap = hypot(side * x - px - along * np.cos(direction), y - py - along * np.sin(direction))
            assert gap >= 0.038 - 1e-9
            px, py = px + length * np.cos(direction), py + length * np.sin(direction)


def test_fingers_of_one_plane_stop_where_they_meet_and_part_again() -> None:
    world = world_of(case_of(THICK), 0.0, 0.6)
    while not all(world.observe().stalled):
        world.act(Command((0.5, 0.0), (0.5, 0.0)), world.tick)
    expected = free_world(case_of(THICK)).hand.angles[-1, 0, 0]
    assert [each[0] for each in world.angles] == pytest.approx([expected] * 2, abs=1e-9)
    world.act(Command((-0.5, 0.0), (-0.5, 0.0)), 0.2)
    assert world.angles[0][0] == pytest.approx(expected - 0.1, abs=1e-9)
    assert not any(world.observe().stalled)


def test_a_tracker_tells_what_was_a_delay_ago_with_errors_of_the_given_size() -> None:
    case = case_of()
    late = world_of(case, 0.05, 0.2, 0.03, -0.01, tracker=Tracker(delay=0.1))
    for _ in range(30):
        seen = late.observe()
        then = seen.time - 0.1
        assert seen.track == pytest.approx((0.05 + 0.03 * then, 0.2 - 0.01 * then, 0.03, -0.01), abs=1e-12)
        late.act(Command(REST, REST, (0.02, 0.0)), late.tick)
    drawn = np.array(
        [world_of(case, 0.0, 0.2, tracker=Tracker(0.0, 0.004, 0.002, k)).observe().track for k in range(300)]
    )
    assert drawn.mean(axis=0) == pytest.approx([0.0, 0.2, 0.0, 0.0], abs=1e-3)
    assert drawn.std(axis=0) == pytest.approx([0.004, 0.004, 0.002, 0.002], rel=0.15)
    assert world_of(case, 0.0, 0.2).observe().track is None


@pytest.mark.parametrize(("change", "said"), [
    ('[support]\nkind = "table"\n', "support.kind"),
    ('[support]\nkind = "free"\nwall_mm = 300\n', "wall"),
    ('[support]\nkind = "free"\n[sensors]\ndisplacement_mm = 1\n', "displacement"),
])  # fmt: skip
def test_what_is_not_covered_is_said(change: str, said: str) -> None:
    case = parse_case(f"{LINE}[object]\nradius_mm = 38\n{change}")
    with pytest.raises(NotCoveredError, match=said):
        free_feedback_world(case, (0.0, 0.1, 0.0))


def test_polygons_ranges_and_many_links_are_refused() -> None:
    free = '[support]\nkind = "free"\n'
    square = '[object]\nshape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20]]\n'
    ranged = '[object]\nradius_mm = "30..40"\n'
    linked = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [50, 50, 50, 50]\n[object]\nradius_mm = 30\n"
    for text, said in ((LINE + square, "polygon"), (LINE + ranged, "ranges"), (linked, "3 links")):
        with pytest.raises(NotCoveredError, match=said):
            free_feedback_world(parse_case(text + free), (0.0, 0.1, 0.0))


def test_a_disk_in_the_hand_at_first_is_invalid() -> None:
    world = world_of(case_of(), 0.0, 0.01)
    trace = run(world, Closing(Drive(2, 0.5)))
    assert (trace.ended, trace.outcome) == (Ended.BROKEN, Outcome.INVALID)
    tracked = world_of(case_of(), 0.0, 0.01, 0.0, -0.1, tracker=Tracker(0.1))
    assert tracked.broken
    assert tracked.observe().track == pytest.approx((0.0, 0.02, 0.0, -0.1))
