"""The stepping kernel against closed forms, symmetries and other ways to state the same hand."""

from math import hypot, pi, radians, tan

import numpy as np
import pytest

from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_events import STALLS, TOUCHES
from palmar.mechanics.pushing.closing_steps import End, carry, carry_all
from palmar.mechanics.pushing.closing_tables import ClosingHand
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.limit_surface import disk_surface, ellipsoid_surface
from palmar.mechanics.pushing.polygon_contacts import disk_body, polygon_body
from palmar.models.outcome import Outcome

HAND = hand_motion(1.0, [2.0])
SQUARE = [[0.4, -0.4], [0.4, 0.4], [-0.4, 0.4], [-0.4, -0.4]]
KITE = [[0.6, 0.0], [0.1, 0.5], [-0.5, 0.2], [-0.3, -0.45]]


def outcome(end: End) -> Outcome:
    return Outcome.from_code(end.code)


def disk_starts(number: int, seed: int) -> np.ndarray:
    """Starts about a hand of half palm 1 and length 2, clear of the open hand for a disk of radius 0.5."""
    return np.random.default_rng(seed).uniform([0.0, 0.5], [3.0, 2.5], (number, 2))


@pytest.mark.parametrize(("friction", "caught", "lost"), [(0.0, 2.1754, 2.1760), (tan(radians(35)), 2.2835, 2.2841)])
def test_disk_is_caught_up_to_the_known_start(friction, caught, lost):
    body = disk_body(0.5, friction)
    assert outcome(carry(HAND, body, caught, 0.5)[0]).caught
    assert outcome(carry(HAND, body, lost, 0.5)[0]) is Outcome.ESCAPED


@pytest.mark.parametrize(("half_thickness", "friction"), [(0.0, 0.0), (0.0, 0.3), (0.0, 0.7), (0.1, 0.0)])
def test_disks_end_as_in_closed_form(half_thickness, friction):
    motion = hand_motion(1.0, [2.0], half_thickness, first=0.2)
    closed = ClosingHand(1.0, 2.0, half_thickness, 0.5, friction, 0.2, motion.last)
    starts = disk_starts(300, 7)
    codes, ends, _ = carry_all(motion, disk_body(0.5, friction), starts)
    rival = close_disk(closed, disk_surface(0.5), starts)
    rival_codes, rival_ends = rival.codes, np.hstack([rival.poses, rival.fingers])
    same = codes == rival_codes
    assert np.count_nonzero(~same & (rival_codes != Outcome.UNDECIDED.code)) == 0
    held = same & (codes <= Outcome.FRICTIONAL.code)
    assert np.count_nonzero(held) > 50
    assert np.abs(ends - rival_ends)[held].max() < 4e-5


def test_mirrored_disk_takes_the_mirrored_way():
    starts = disk_starts(100, 3)
    body = disk_body(0.5, 0.4)
    codes, ends, _ = carry_all(HAND, body, starts)
    mirrored_codes, mirrored, _ = carry_all(HAND, body, starts * [-1.0, 1.0])
    assert np.array_equal(codes, mirrored_codes)
    assert np.array_equal(ends[:, [0, 2]], -mirrored[:, [0, 2]])
    assert np.array_equal(ends[:, [3, 4]], mirrored[:, [4, 3]])


def test_mirrored_polygon_takes_the_mirrored_way():
    rng = np.random.default_rng(5)
    starts = rng.uniform([0.0, 0.65, 0.0], [2.6, 2.4, 2.0 * pi], (40, 3))
    mirror = np.asarray(KITE)[::-1] * [-1.0, 1.0]
    codes, ends, _ = carry_all(HAND, polygon_body(KITE, 0.4), starts)
    mirrored_codes, mirrored, _ = carry_all(HAND, polygon_body(mirror, 0.4), starts * [-1.0, 1.0, -1.0])
    assert np.count_nonzero(codes != mirrored_codes) == 0
    held = codes <= Outcome.FRICTIONAL.code
    assert np.abs(ends[held][:, :3] - mirrored[held][:, :3] * [-1.0, 1.0, -1.0]).max() < 1e-4


@pytest.mark.parametrize("turn", [0.7, pi / 2.0, -2.0])
def test_the_frame_of_a_polygon_does_not_matter(turn):
    """The pressure turns with the object: the same polygon described along other axes goes the same way."""
    needle = np.array([[0.7, -0.1], [0.6, 0.12], [-0.6, 0.1], [-0.7, -0.12]])
    c, s = np.cos(turn), np.sin(turn)
    turned = needle @ np.array([[c, s], [-s, c]])
    starts = np.random.default_rng(8).uniform([0.0, 0.8, 0.0], [2.6, 2.4, 2.0 * pi], (40, 3))
    codes, ends, _ = carry_all(HAND, polygon_body(needle, 0.4), starts)
    other_codes, others, _ = carry_all(HAND, polygon_body(turned, 0.4), starts - [0.0, 0.0, turn])
    assert np.array_equal(codes, other_codes)
    held = codes <= Outcome.FRICTIONAL.code
    assert np.count_nonzero(held) > 10
    assert np.abs((others - ends)[held][:, :3] + [0.0, 0.0, turn]).max() < 1e-4


def test_two_frictionless_disks_do_not_spread_while_links_push():
    last = 1.3
    motion = hand_motion(1.0, [6.0], limit=last)
    body = disk_body(0.5, 0.0)
    starts = np.random.default_rng(11).uniform([-0.8, 0.6], [3.0, 2.5], (60, 2))
    _, ends, _ = carry_all(motion, body, starts)
    assert np.abs(ends[:, 2]).max() < 1e-9
    before = np.hypot(*(starts[:, None] - starts[None]).transpose(2, 0, 1))
    after = np.hypot(*(ends[:, None, :2] - ends[None, :, :2]).transpose(2, 0, 1))
    assert (after - before).max() < 1e-5


@pytest.mark.parametrize("links", [[1.2, 0.8], [0.7, 0.5, 0.8]])
@pytest.mark.parametrize("half_thickness", [0.0, 0.1])
def test_straight_links_are_one_finger(links, half_thickness):
    whole = hand_motion(1.0, [2.0], half_thickness, first=0.3, limit=2.8)
    jointed = hand_motion(1.0, links, half_thickness, first=0.3, limit=2.8)
    starts = disk_starts(60, 2)
    for body in (disk_body(0.5, 0.5), polygon_body(SQUARE, 0.5)):
        codes, ends, _ = carry_all(whole, body, starts)
        jointed_codes, jointed_ends, _ = carry_all(jointed, body, starts)
        assert np.array_equal(codes, jointed_codes)
        # Lost polygons are compared by their median: where a corner met a line's tip, the way on is not reproducible.
        apart = np.abs(ends - jointed_ends).max(axis=1)
        assert np.median(apart) < 1e-6
        held = apart[codes <= Outcome.FRICTIONAL.code]
        assert np.quantile(held, 0.9) < 1e-4
        assert held.max() < 5e-3  # an edge that comes to lie flush across the joint


def test_edge_flush_on_a_link_turns_with_it():
    """A square pushed by its whole edge at the finger's base turns with the finger while the edge stays on it."""
    motion = hand_motion(1.0, [4.0], limit=0.4)
    body = polygon_body(SQUARE, 1.0, ellipsoid_surface(0.3))
    end, events = carry(motion, body, 2.5, 0.4, 0.0, events=20)
    assert outcome(end) is Outcome.ESCAPED
    assert abs(end.theta - 0.4) < 1e-6
    assert hypot(end.x - 1.0, end.y) == pytest.approx(hypot(1.5, 0.4), abs=1e-5)
    assert int(events[0, 1]) == TOUCHES


def test_wedged_finger_stalls_and_the_other_goes_on():
    end, events = carry(HAND, disk_body(0.5, 0.9), 1.3, 0.55, events=30)
    stalls = events[events[:, 1] == STALLS]
    assert end.code <= Outcome.FRICTIONAL.code
    assert len(stalls) >= 1


def test_colliding_fingers_stop_at_the_axis_and_cage():
    motion = hand_motion(0.6, [2.0], 0.1, colliding=True)
    assert 0.6 + 2.0 * np.cos(motion.last) == pytest.approx(0.1, abs=1e-9)
    assert outcome(carry(motion, disk_body(0.2, 0.0), 0.0, 1.0)[0]) is Outcome.CAGED


@pytest.mark.parametrize("start", [(0.0, 0.2), (2.0, 0.1), (-1.0, -0.2)])
def test_overlap_with_the_open_hand_is_invalid(start):
    assert outcome(carry(HAND, disk_body(0.5, 0.3), *start)[0]) is Outcome.INVALID
    assert outcome(carry(HAND, polygon_body(SQUARE, 0.3), *start)[0]) is Outcome.INVALID


def test_start_that_is_no_number_is_invalid_and_a_bound_on_steps_leaves_undecided():
    body = disk_body(0.5, 0.3)
    assert outcome(carry(HAND, body, float("nan"), 1.0)[0]) is Outcome.INVALID
    assert outcome(carry(HAND, body, 1.5, 1.0, most_steps=2)[0]) is Outcome.UNDECIDED


def test_error_falls_with_the_tolerance():
    """Local error control of order 5(4): the end's error falls nearly as the tolerance does."""
    body = polygon_body(KITE, 0.4, ellipsoid_surface(0.3))
    motion = hand_motion(1.0, [4.0], limit=1.2)
    starts = np.random.default_rng(4).uniform([0.5, 0.7, 0.0], [2.5, 1.5, 6.0], (60, 3))
    tolerances = (1e-4, 1e-6, 1e-8)
    best = carry_all(motion, body, starts, 1e-11)[1]
    errors = [np.mean(np.abs(carry_all(motion, body, starts, each)[1] - best)[:, :3]) for each in tolerances]
    assert errors[0] > 10.0 * errors[1] > 50.0 * errors[2]


def test_batch_does_not_depend_on_the_number_of_threads():
    starts = disk_starts(200, 9)
    one = carry_all(HAND, disk_body(0.5, 0.3), starts, threads=1)
    two = carry_all(HAND, disk_body(0.5, 0.3), starts, threads=2)
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))


def test_tip_that_meets_an_edge_neither_passes_through_nor_stays_stuck():
    hexagon = [[0.6 * np.cos(k * pi / 3.0), 0.45 * np.sin(k * pi / 3.0)] for k in range(6)]
    body = polygon_body(hexagon, 0.5)
    starts = [[2.914795, 1.402812, 2.321106], [2.415164, 1.528865, 5.742504], [2.277806, 1.774980, 0.663432]]
    codes, ends, _ = carry_all(HAND, body, np.array(starts))
    assert np.all(codes == Outcome.ESCAPED.code)
    assert np.all(np.hypot(*(ends[:, :2] - np.array(starts)[:, :2]).T) > 1e-3)
