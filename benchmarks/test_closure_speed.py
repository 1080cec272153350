"""Closure: a million hands at a time."""

import numpy as np

from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.studies.closure_map import grid_map

MILLION = 1_000_000
RNG = np.random.default_rng(0)
BETA, ALPHA = RNG.uniform(0.0, 2.0, MILLION), RNG.uniform(0.01, 1.4, MILLION)


def test_structural_radii_of_a_million_hands(benchmark):
    benchmark(structural_radii, BETA, 1.0)


def test_frictional_radii_of_a_million_hands(benchmark):
    benchmark(frictional_radii, BETA, 1.0, ALPHA)


def test_both_closures_of_a_million_hands(benchmark):
    benchmark(lambda: (structural_radii(BETA, 1.0), frictional_radii(BETA, 1.0, ALPHA)))


def test_map_of_200_by_200_hands(benchmark):
    benchmark(grid_map, 200)
    assert benchmark.stats["median"] < 0.2
