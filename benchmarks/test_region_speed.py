"""The published region: one hand after the other."""

from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.build import published_region

CASE = open_case("testbed_table")[1]


def test_published_region(benchmark):
    benchmark(published_region, CASE, Closure.FRICTIONAL)
