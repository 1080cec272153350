"""The true pre-image of chapter 4's hand, from the case to the polygons."""

from palmar.models.shipped import open_case
from palmar.regions.build import build_region


def test_region_of_a_free_disk(benchmark):
    """Under half a second."""
    case = open_case("zero_g_example")[1]
    build_region(case)
    region = benchmark.pedantic(build_region, (case,), rounds=3)
    assert 0.0398 < region.area < 0.0404
