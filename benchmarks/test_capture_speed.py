"""Two hundred thousand disks at rest in free space before a closing hand, one call, both cores."""

import numpy as np
import pytest

from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_hand import closing_hand

RNG = np.random.default_rng(0)
STARTS = np.column_stack([RNG.uniform(0.0, 31.0, 200_000), RNG.uniform(3.8, 29.0, 200_000)])


@pytest.mark.parametrize("restitution", [1.0, 0.7, 0.0])
def test_disks_at_rest(benchmark, restitution):
    """At full restitution more than 200,000 a second."""
    hand = closing_hand(6.0, [24.4], 3.8)
    capture_all(hand, STARTS[:1000])
    benchmark.pedantic(capture_all, (hand, STARTS), {"restitution": restitution}, rounds=3)


def test_a_jointed_thick_hand(benchmark):
    hand = closing_hand(6.0, [13.7, 10.7], 3.8, 1.25, offsets=[0.35])
    capture_all(hand, STARTS[:1000])
    benchmark.pedantic(capture_all, (hand, STARTS), rounds=3)


def test_the_hand_itself(benchmark):
    """Ends of travel and loops that shut."""
    benchmark(closing_hand, 6.0, [13.7, 10.7], 3.8, 1.25, offsets=[0.35], colliding=True)
