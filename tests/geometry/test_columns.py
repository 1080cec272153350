"""The lower boundary of sets of polygons and lines."""

from math import inf

import numpy as np
import pytest
import shapely
from shapely import LineString, Point, affinity, box

from palmar.geometry.columns import edges, lowest, spans


def test_the_lower_boundary_of_a_set() -> None:
    shape = shapely.union_all([box(0.0, 1.0, 1.0, 2.0), box(0.5, 0.0, 2.0, 3.0), LineString([(3.0, 5.0), (4.0, 6.0)])])
    found = lowest(edges(shape), np.array([-0.1, 0.2, 0.5, 0.7, 2.0, 2.5, 3.5]))
    assert found.tolist() == [inf, 1.0, 0.0, 0.0, 0.0, inf, 5.5]
    assert spans(shape) == [(0.0, 2.0), (3.0, 4.0)]


@pytest.mark.parametrize("seed", range(6))
def test_it_is_where_a_vertical_line_enters(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shape = affinity.rotate(Point(0.0, 0.0).buffer(1.0).difference(box(-0.3, -2.0, 0.2, 0.1)), rng.uniform(0, 360))
    for x in rng.uniform(-1.1, 1.1, 50):
        met = shapely.intersection(shape, LineString([(x, -3.0), (x, 3.0)]))
        found = float(lowest(edges(shape), np.array([x]))[0])
        assert found == pytest.approx(met.bounds[1]) if not met.is_empty else found == inf
