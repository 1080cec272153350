"""Fingers in one plane: where one ends after the other has stalled."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from shapely import LineString

from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_case import closing_hand, straight_motion
from palmar.mechanics.pushing.closing_motion import bench
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, hand_motion, place_links
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.mechanics.pushing.meeting import straight_travel_end, travel_end
from palmar.mechanics.pushing.polygon_contacts import disk_body
from palmar.models.hand import Fingers, Hand
from palmar.models.outcome import Outcome


def _gap(motion: HandMotion, right: float, left: float) -> float:
    """Distance between the fingers' joint lines, by shapely."""
    rows = np.zeros((2 * len(motion.links) + 1, 8))
    place_links(motion, left, right, MOVING, rows)
    count = len(motion.links)
    fingers = [
        [(each[0], each[1]) for each in part] + [part[-1][2:4]] for part in (rows[1 : count + 1], rows[count + 1 :])
    ]
    return float(LineString(fingers[0]).distance(LineString(fingers[1])))


@pytest.mark.parametrize("seed", range(40))
def test_the_finger_that_goes_on_ends_at_the_first_touch(seed: int) -> None:
    rng = np.random.default_rng(seed)
    links = [[1.0], [0.6, 0.4], [0.4, 0.3, 0.3]][seed % 3]
    rest = len(links) - 1
    motion = hand_motion(
        rng.uniform(0.2, 0.9), links, rng.choice([0.0, 0.05]), first=0.3, colliding=True,
        offsets=rng.uniform(0.0, 0.4, rest), ratios=rng.uniform(0.0, 0.3, rest),
    )  # fmt: skip
    stalled = rng.uniform(motion.first, motion.last)
    end = travel_end(motion, stalled, stalled, MOVING, bench(0).links)
    assert end == pytest.approx(travel_end(motion, stalled, MOVING, stalled, bench(0).links), abs=1e-8)
    sweep = np.linspace(stalled, end, 400)[:-1]
    reach = 2.0 * motion.half_thickness
    assert min(_gap(motion, stalled, each) for each in sweep) > reach
    assert end == motion.alone or _gap(motion, stalled, end) == pytest.approx(reach, abs=1e-8)
    assert motion.last - 1e-9 <= end <= motion.alone


@pytest.mark.parametrize("colliding", [True, False])
def test_fingers_that_move_together_or_pass_each_other_end_as_ever(colliding: bool) -> None:
    motion = hand_motion(0.5, [1.0], 0.05, colliding=colliding)
    rows = bench(0).links
    assert travel_end(motion, 0.4, MOVING, MOVING, rows) == motion.last
    assert (travel_end(motion, 0.4, 0.4, MOVING, rows) > motion.last + 0.1) == colliding


def test_both_kernels_say_where_fingers_of_one_plane_end() -> None:
    """Random hands and disks: same outcomes and finger angles; both not caught counts as the same."""
    rng, late = np.random.default_rng(5), 0
    for _ in range(24):
        hand = Hand(
            palm_width=2.0 * rng.uniform(0.15, 1.0), finger_links=(1.0,), finger_thickness=rng.choice([0.0, 0.1]),
            fingers=Fingers.COLLIDING, open=rng.choice([0.0, 0.5]),
        )  # fmt: skip
        radius, friction = rng.uniform(0.1, 0.6), rng.uniform(0.0, 1.2)
        starts = np.column_stack([rng.uniform(-1.2, 1.2, 150), rng.uniform(radius, 1.2, 150)])
        closing = closing_hand(hand, radius, friction)
        ends = close_disk(closing, disk_surface(radius), starts)
        codes, poses, _ = carry_all(straight_motion(hand), disk_body(radius, friction), starts)
        open_ = Outcome.UNDECIDED.code
        both = (ends.codes != open_) & (codes != open_) & (codes != Outcome.INVALID.code)
        held = both & ((ends.codes <= Outcome.CAGED.code) | (codes <= Outcome.CAGED.code))
        assert np.array_equal(ends.codes[held], codes[held])
        assert ends.fingers[held] == pytest.approx(poses[held, 3:], abs=1e-3)
        late += int(np.sum(ends.fingers[held].max(axis=1) > closing.last + 1e-6))
    assert late > 20


def test_a_straight_finger_is_the_jointed_kernels_finger_of_one_link() -> None:
    hand = Hand(palm_width=0.9, finger_links=(1.0,), finger_thickness=0.08, fingers=Fingers.COLLIDING)
    closing, motion = closing_hand(hand, 0.3, 0.5), straight_motion(hand)
    assert closing.alone == pytest.approx(motion.alone, abs=1e-7)
    for stalled in np.linspace(0.0, closing.last, 7):
        rows = bench(0).links
        jointed = travel_end(motion, stalled, stalled, MOVING, rows)
        assert straight_travel_end(closing, stalled) == pytest.approx(jointed, abs=1e-7)
    assert closing.alone < pi
