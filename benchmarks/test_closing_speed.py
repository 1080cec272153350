"""A million disk starts before the test-bed hand (line fingers), one call, both cores."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.limit_surface import disk_surface

RNG = np.random.default_rng(0)
STARTS = np.column_stack([RNG.uniform(-0.304, 0.304, 1_000_000), RNG.uniform(0.038, 0.282, 1_000_000)])
SURFACE = disk_surface(0.038)


@pytest.mark.parametrize("friction", [0.0, 0.7])
def test_a_million_starts(benchmark, friction):
    hand = ClosingHand(0.06, 0.244, 0.0, 0.038, friction, 0.0, pi)
    tables = build_tables(hand, SURFACE)
    close_disk(hand, SURFACE, STARTS[:1000], tables)
    benchmark(close_disk, hand, SURFACE, STARTS, tables)


def test_tables_of_one_hand(benchmark):
    benchmark(build_tables, ClosingHand(0.06, 0.244, 0.0, 0.038, 0.7, 0.0, pi), SURFACE)
