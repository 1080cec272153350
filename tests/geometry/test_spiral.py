"""Flattened spirals keep within their bound, and the bound is of the right order."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.geometry.spiral import Spiral

spirals = st.builds(
    Spiral,
    base=st.tuples(st.floats(-2, 2), st.floats(-2, 2)),
    along=st.floats(0.0, 3.0),
    rate=st.floats(0.01, 2.0),
    across=st.floats(0.0, 2.0),
    start=st.floats(0.0, 1.0),
    end=st.floats(1.05, 3.0),
)


@given(spirals, st.sampled_from([1e-2, 1e-3, 1e-4]))
@settings(max_examples=100, deadline=None)
def test_every_point_of_the_curve_is_within_the_bound_of_its_polyline(spiral, tolerance):
    line, bound = spiral.flattened(tolerance)
    assert bound <= tolerance
    curve = spiral.at(np.linspace(spiral.start, spiral.end, 2000))
    distances = shapely.distance(shapely.points(curve), shapely.LineString(line))
    assert distances.max() <= bound * (1 + 1e-9) + 1e-12


def test_the_bound_is_not_far_above_the_true_error_and_of_second_order():
    spiral = Spiral((0.0, 0.0), 1.0, 0.5, 0.5, 0.0, 2.0)
    curve = shapely.points(spiral.at(np.linspace(0.0, 2.0, 20001)))
    counts, errors = [], []
    for tolerance in (1e-2, 1e-4, 1e-6):
        line, bound = spiral.flattened(tolerance)
        errors.append(shapely.distance(curve, shapely.LineString(line)).max())
        counts.append(len(line) - 1)
        assert errors[-1] > 0.3 * bound
    orders = -np.diff(np.log(errors)) / np.diff(np.log(counts))
    assert orders == pytest.approx([2.0, 2.0], abs=0.1)


def test_with_equal_rate_and_offset_the_curve_is_the_involute_of_a_circle():
    spiral = Spiral((1.0, 0.0), 0.3, 0.5, 0.5, 0.0, 1.5)
    phi = np.linspace(0.1, 1.4, 50)
    step = 1e-6
    tangent = (spiral.at(phi + step) - spiral.at(phi - step)) / (2 * step)
    normal = np.stack([-np.sin(phi), np.cos(phi)], axis=-1)
    assert tangent == pytest.approx((0.3 + 0.5 * phi)[:, None] * normal, abs=1e-8)
