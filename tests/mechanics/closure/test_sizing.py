"""The inverse of closure against scans of the closure itself, and the slopes against closed-form derivatives."""

from math import atan, inf, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.mechanics.closure.sizing import Dimension, Grip, slopes, sufficient

positive = st.floats(0.05, 3.0)
grips = st.builds(
    Grip,
    half_palm=positive,
    finger_length=positive,
    half_thickness=st.sampled_from([0.0, 0.02]),
    friction_angle=st.none() | st.floats(0.05, 1.2),
    crossing=st.booleans(),
)


@given(grips, st.sampled_from(Dimension), positive, st.floats(1.0, 4.0))
@settings(deadline=None, max_examples=150)
def test_inside_every_radius_is_held_and_just_outside_one_is_lost(grip, dimension, smallest, factor):
    if dimension is Dimension.FRICTION_ANGLE and grip.friction_angle is None:
        return
    largest = smallest * factor
    intervals = sufficient(grip, dimension, smallest, largest)
    rng = np.random.default_rng(0)
    values = rng.uniform(0.0, 1.5 if dimension is Dimension.FRICTION_ANGLE else 8.0, 2000)
    values = values[values > grip.half_thickness * 1.001]
    radii = grip.radii(dimension, values)
    held = radii.holds(smallest) & radii.holds(largest)
    inside = np.zeros(len(values), dtype=bool)
    for low, high in intervals:
        inside |= (low <= values) & (values <= high)
    near = np.zeros(len(values), dtype=bool)
    for end in [end for each in intervals for end in each if end != inf]:
        near |= np.abs(values - end) < 1e-6
    assert np.array_equal(held[~near], inside[~near])


def test_structural_sizes_in_closed_form():
    grip = Grip(half_palm=0.065, finger_length=0.07)
    ((low, high),) = sufficient(grip, Dimension.FINGER_LENGTH, 0.02, 0.06)
    assert (low, high) == (pytest.approx(sqrt(0.06**2 + 0.005**2), rel=1e-9), inf)
    ((low, high),) = sufficient(grip, Dimension.HALF_PALM, 0.02, 0.06)
    assert (low, high) == (pytest.approx(0.06, rel=1e-9), pytest.approx(0.02 + sqrt(0.07**2 - 0.02**2), rel=1e-9))
    assert sufficient(grip, Dimension.HALF_PALM, 0.02, 0.08) == []


def test_a_single_sufficient_size_is_found():
    ((low, high),) = sufficient(Grip(half_palm=0.0, finger_length=0.05), Dimension.HALF_PALM, 0.05, 0.05)
    assert low == pytest.approx(0.05, rel=1e-6)
    assert high == pytest.approx(0.05, rel=1e-4)


def test_slopes_of_the_largest_radius_with_friction():
    alpha = atan(0.7)
    below, above = slopes(Grip(0.06, 0.244, friction_angle=alpha), Dimension.HALF_PALM)
    assert (below.max, above.max) == (pytest.approx(1.0 / np.cos(alpha), rel=1e-6),) * 2
    below, above = slopes(Grip(0.06, 0.244, friction_angle=alpha), Dimension.FINGER_LENGTH)
    assert above.max == pytest.approx(0.7, rel=1e-6)


def test_slopes_show_a_kink():
    below, above = slopes(Grip(1.0, 1.0), Dimension.HALF_PALM)
    assert below.max == pytest.approx(1.0, rel=1e-4)
    assert above.max == pytest.approx(0.0, abs=1e-4)
