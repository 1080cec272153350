"""Thick, jointed, colliding, delayed hands against the slow reference; loops that shut against a flood of free places."""

from math import acos, inf, pi

import numpy as np
import pytest

from palmar.errors import InputError
from palmar.mechanics.impact.capture import capture, capture_all
from palmar.mechanics.impact.capture_hand import closing_hand, programmed_hand
from palmar.mechanics.impact.capture_state import IMPACT
from palmar.mechanics.impact.contact_view import BASE
from palmar.mechanics.impact.enclosed import enclosed_now
from palmar.mechanics.impact.finger_motion import FINGER_WIDTH, begin_phase
from palmar.models.outcome import Outcome
from reference.slow_capture import SlowHand, flood, simulate


def random_hand(rng):
    """(kernel's hand, the slow reference's, end of the motion)."""
    n = int(rng.integers(1, 4))
    lengths, half_thickness = rng.uniform(4.0, 14.0, n), float(rng.choice([0.0, 0.8, 1.5]))
    half_palm, radius, first = rng.uniform(4.0, 8.0), rng.uniform(1.5, 4.0), float(rng.choice([0.0, 0.4]))
    offsets, ratios = rng.uniform(-0.6, 0.9, n - 1), rng.choice([0.0, 0.5, 1.0, -0.4], n - 1)
    delay, rate = float(rng.choice([0.0, 0.3])), float(rng.choice([1.0, 2.0]))
    fast = closing_hand(
        half_palm, lengths, radius, half_thickness, first=first, rate=rate, offsets=offsets, ratios=ratios,
        delay=delay, duration=float(rng.choice([inf, 1.5])), colliding=bool(rng.random() < 0.5),
    )  # fmt: skip
    moving = sum(float(fast.times[k + 1] - fast.times[k]) for k in range(len(fast.times) - 1) if fast.rates[k].any())
    joints, rates = np.tile(np.append(first, offsets), (2, 1)), rate * np.tile(np.append(1.0, ratios), (2, 1))
    slow = SlowHand(half_palm, list(lengths), radius, half_thickness, joints, [(delay, 0.0 * rates), (moving, rates)])
    return fast, slow, delay + moving


def test_impacts_of_many_hands_are_those_of_small_steps():
    rng, compared = np.random.default_rng(11), 0
    for _ in range(10):
        fast, slow, end = random_hand(rng)
        for k in range(6):
            place = np.array([rng.uniform(-20.0, 20.0), rng.uniform(-8.0, 25.0)])
            velocity, e = rng.normal(size=2) * (8.0 if k % 2 else 0.0), float(rng.choice([1.0, 0.6]))
            outcome, _, events = capture(fast, place, velocity, e)
            overlap = slow.nearest(np.zeros(1), place[None])[0].min() < 0.0
            assert overlap == (outcome is Outcome.INVALID)
            if overlap:
                continue
            hits = events[events[:, 1] == IMPACT]
            expected = simulate(
                slow, place, velocity, e, min(end + 2.0, float(events[-1, 0]) + 0.5), most=12, samples=6000
            ).impacts
            for hit, (time, body, where, after) in zip(hits, expected, strict=False):
                assert hit[0] == pytest.approx(time, abs=1e-7)
                assert hit[2] == body or hit[3] == BASE  # a palm's end is a base joint's round
                assert hit[4:6] == pytest.approx(where, abs=1e-6)
                assert hit[8:10] == pytest.approx(after, abs=1e-4)
                compared += 1
            assert len(hits) >= min(len([each for each in expected if each[0] < events[-1, 0]]), 12)
    assert compared > 30


def test_what_is_enclosed_is_what_a_flood_cannot_leave():
    rng, both = np.random.default_rng(3), [0, 0]
    while min(both) < 25:
        fast, slow, end = random_hand(rng)
        time = float(rng.uniform(0.5, 1.0)) * end
        fingers, chain = np.zeros((2, FINGER_WIDTH)), np.zeros((2 * len(fast.lengths) + 2, 2))
        begin_phase(fast, int(np.searchsorted(fast.times, time, side="right")) - 1, fingers)
        axis, parts, outer = flood(slow, time, 0.2)
        for x, y in rng.uniform([-8.0, 1.5], [8.0, 18.0], (40, 2)):
            around = parts[np.ix_(*(np.argsort(np.abs(axis - c))[:4] for c in (x, y)))]
            if around.min() == 0 or around.min() != around.max():
                continue
            mine = enclosed_now(fast, fingers, time, x, y, chain)
            assert mine == (around[0, 0] != outer)
            both[int(mine)] += 1


def test_what_is_caught_stays_inside_to_the_end_of_travel():
    """A loop that shut is still shut when the fingers are at rest."""
    rng = np.random.default_rng(8)
    for _ in range(10):
        fast, slow, _ = random_hand(rng)
        for since, i, j in fast.closures:
            k = int(np.searchsorted(fast.times, since))
            assert since == pytest.approx(fast.times[k], abs=1e-15)
            later = np.linspace(since, fast.times[-1], 12)
            limit = 2.0 * fast.radius + sum(0.0 if c == len(fast.lengths) else fast.half_thickness for c in (i, j))
            if len(fast.lengths) == len(slow.lengths):
                chains = [elements(slow, t, len(fast.lengths)) for t in later]
                distances = [distance(chain[int(i)], chain[int(j)]) for chain in chains]
                assert max(distances) < limit + 1e-9
                if since > 0.0:
                    assert distances[0] == pytest.approx(limit, abs=1e-9)


def elements(slow, time, n):
    """Segments of the chain from the left tip to the right one."""
    ends = slow.segments(np.array([time]))[0]
    return [*(ends[1 + 2 * n - 1 - k] for k in range(n)), ends[0], *(ends[1 + k] for k in range(n))]


def distance(one, other):
    """Least distance of two segments, sampled and refined."""
    low, high = np.zeros(2), np.ones(2)
    for _ in range(12):
        s, r = (np.linspace(low[k], high[k], 41) for k in range(2))
        p, q = one[0] + s[:, None] * (one[1] - one[0]), other[0] + r[:, None] * (other[1] - other[0])
        apart = np.linalg.norm(p[:, None] - q[None], axis=2)
        best = np.unravel_index(np.argmin(apart), apart.shape)
        width = (high - low) / 8.0
        centre = np.array([s[best[0]], r[best[1]]])
        low, high = np.maximum(centre - width, 0.0), np.minimum(centre + width, 1.0)
    return float(apart.min())


def test_the_throat_of_thick_fingers_shuts_sooner():
    """D + L cos psi_c = R + h."""
    hand = closing_hand(0.06, [0.244], 0.038, 0.0125)
    assert hand.closures[0, 0] == pytest.approx(acos(-(0.06 - 0.038 - 0.0125) / 0.244), abs=1e-11)
    assert hand.times[-1] == pytest.approx(pi - np.arcsin(0.0125 / 0.244), abs=1e-9)


def test_a_throat_that_shuts_at_right_angles_is_noticed_at_once():
    """The palm is hardly wider than the disk between thick fingers; the two distances are equal but for rounding."""
    rng = np.random.default_rng(6)
    for _ in range(30):
        radius, half_thickness, length = rng.uniform(2.0, 4.0), rng.uniform(0.0, 1.5), rng.uniform(8.0, 15.0)
        half_palm = radius + half_thickness + rng.uniform(0.02, 2.0)
        hand = closing_hand(half_palm, [length], radius, half_thickness, rate=2.0, delay=0.3)
        since = float(hand.closures[0, 0])
        outcome, end, _ = capture(hand, (0.0, 0.5 * length), (0.0, 0.0))
        assert outcome is Outcome.CAGED
        assert end[5] == pytest.approx(since, abs=1e-12)


@pytest.mark.parametrize("e", [1.0, 0.6, 0.0])
def test_nearly_every_start_before_any_hand_is_decided(e):
    """Jointed fingers that squeeze a disk to and fro at e = 1 before a loop has shut can outlast any bound."""
    rng, codes = np.random.default_rng(21), []
    for k in range(24):
        places, velocities = (
            rng.uniform([-20.0, -5.0], [20.0, 25.0], (300, 2)),
            rng.normal(size=(300, 2)) * 4.0 * (k % 2),
        )
        codes.append(capture_all(random_hand(rng)[0], places, velocities, e, most_events=1000).codes)
    undecided = (np.concatenate(codes) == Outcome.UNDECIDED.code).mean()
    assert undecided < (0.02 if e == 1.0 else 0.0005)


def test_straight_stiff_links_are_one_link():
    one, two = closing_hand(6.0, [24.4], 3.8), closing_hand(6.0, [13.7, 10.7], 3.8)
    assert two.lengths == pytest.approx(one.lengths)
    assert two.closures == pytest.approx(one.closures)


def test_colliding_fingers_stop_where_they_touch():
    hand = closing_hand(6.0, [24.4], 3.8, 1.0, colliding=True)
    assert hand.times[-1] == pytest.approx(acos(-5.0 / 24.4), abs=1e-9)
    limited = closing_hand(6.0, [24.4], 3.8, limit=1.0)
    assert limited.times[-1] == pytest.approx(1.0)


def test_a_delay_shifts_all_times_and_a_stop_leaves_walls():
    places = np.array([[8.0, 9.0], [2.0, 12.0], [12.0, 15.0]])
    now, later = closing_hand(6.0, [24.4], 3.8), closing_hand(6.0, [24.4], 3.8, delay=0.7)
    assert capture_all(later, places).ends[:, 5] == pytest.approx(capture_all(now, places).ends[:, 5] + 0.7)
    stopped = closing_hand(6.0, [24.4], 3.8, duration=1.0)
    assert len(stopped.closures) == 0
    codes = capture_all(stopped, places).codes
    assert set(codes) <= {Outcome.ESCAPED.code, Outcome.MISSED.code}


def test_one_finger_alone_and_different_rates():
    still = np.zeros((2, 1))
    alone = programmed_hand(6.0, [24.4], 3.8, 0.0, still, [(1.2, np.array([[1.0], [0.0]])), (inf, np.ones((2, 1)))])
    assert alone.rates[0].ravel() == pytest.approx([1.0, 0.0])
    assert alone.times[-1] == pytest.approx(1.2 + pi, abs=1e-9)
    assert alone.angles[-1].ravel() == pytest.approx([pi, pi], abs=1e-9)
    _, _, events = capture(alone, (-11.0, 3.8))
    assert events[0, 0] >= 1.2 or events[0, 2] == 1.0


def test_misuse_is_refused():
    with pytest.raises(InputError, match="1 to 3 links"):
        closing_hand(6.0, [1.0, 1.0, 1.0, 1.0], 1.0)
    with pytest.raises(InputError, match="one entry"):
        closing_hand(6.0, [1.0, 1.0], 1.0, offsets=[])
    with pytest.raises(InputError, match="positive"):
        closing_hand(6.0, [1.0], -1.0)
    with pytest.raises(InputError, match="without an end"):
        programmed_hand(6.0, [1.0], 1.0, 0.0, np.zeros((2, 1)), [(inf, -np.ones((2, 1)))])
