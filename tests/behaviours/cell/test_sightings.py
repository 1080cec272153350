"""Stale and frozen sightings do not move the arm."""

import pytest

from palmar.behaviours.cell.sightings import ALIKE, OLDEST, Seen
from palmar.models.cell_messages import Sighting


def taken(times: list[float], places: list[float], delay: float) -> Seen:
    seen = Seen()
    for time, place in zip(times, places, strict=True):
        seen = seen.take(Sighting(time, place, 0.0, 0.03, 1e-3), time + delay)
    return seen


def test_fresh_ones_are_averaged():
    seen = taken([0.0, 0.03, 0.06], [1.0, 2.0, 3.0], 0.05)
    assert seen.place == pytest.approx((2.0, 0.0))
    assert seen.fresh(0.06 + OLDEST - 1e-6)
    assert not seen.fresh(0.06 + OLDEST + 1e-6)


def test_stale_ones_are_refused():
    assert taken([0.0, 0.03], [1.0, 2.0], OLDEST + 1e-3) == Seen()


def test_the_same_frame_again_and_again_is_not_fresh():
    times = [0.03 * k for k in range(ALIKE + 1)]
    assert not taken(times, [1.0] * len(times), 0.0).fresh(times[-1])
    assert taken(times[:-1], [1.0] * (len(times) - 1), 0.0).fresh(times[-2])


def test_a_sighting_counts_once():
    seen = Seen().take(Sighting(0.0, 1.0, 0.0, 0.03, 1e-3), 0.0)
    assert seen.take(Sighting(0.0, 1.0, 0.0, 0.03, 1e-3), 0.01) == seen
