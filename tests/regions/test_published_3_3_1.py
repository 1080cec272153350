"""The source's region: its published numbers, its invariants, and a rival construction by points."""

from math import acos, atan, cos, degrees, pi, radians, sin

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from palmar.geometry.planar_set import grown
from palmar.regions.published_3_3_1 import published_sets, sweep

ALPHA = radians(35.0)


def test_numbers_of_the_example():
    frictional, structural = sweep(1.0, 2.0, 0.5, ALPHA), sweep(1.0, 2.0, 0.5, 0.0)
    assert frictional is not None
    assert structural is not None
    assert frictional.r0 == pytest.approx(1.3702, abs=5e-5)
    assert degrees(frictional.end) == pytest.approx(72.17, abs=5e-3)
    assert structural.r0 == pytest.approx(1.0883, abs=5e-5)
    assert degrees(structural.theta) == pytest.approx(75.52, abs=5e-3)
    assert degrees(pi - structural.theta) == pytest.approx(104.48, abs=5e-3)


def test_areas_of_the_example():
    assert published_sets(1.0, 2.0, 0.5, 0.0, 0.0, 1e-5).centre.area == pytest.approx(4.770, abs=5e-4)
    # The horizontal chord, which reproduces the structural area known independently, gives 6.328 with friction.
    assert published_sets(1.0, 2.0, 0.5, ALPHA, 0.0, 1e-5).centre.area == pytest.approx(6.328, abs=5e-4)


hands = st.tuples(st.floats(0.1, 3.0), st.floats(0.2, 4.0), st.floats(0.05, 1.5), st.floats(0.0, 1.2))


@given(hands)
@settings(deadline=None)
def test_the_spiral_ends_at_the_fingertip(hand):
    half_palm, length, radius, alpha = hand
    numbers = sweep(half_palm, length, radius, alpha)
    assume(numbers is not None and numbers.end > numbers.phi0)
    assert numbers.r0 + radius * (numbers.end - numbers.phi0) == pytest.approx(length)
    assert numbers.r0 == 0.0 or numbers.phi0 == 0.0


@given(hands, st.floats(1e-3, 1e3))
@settings(deadline=None, max_examples=50)
def test_regions_scale_and_mirror(hand, scale):
    half_palm, length, radius, alpha = hand
    one = published_sets(half_palm, length, radius, alpha, 0.0, 1e-4 * length)
    many = published_sets(scale * half_palm, scale * length, scale * radius, alpha, 0.0, 1e-4 * scale * length)
    assert many.centre.area == pytest.approx(scale**2 * one.centre.area, rel=1e-6, abs=1e-9 * scale**2)
    mirrored = shapely.affinity.scale(one.centre, xfact=-1.0, origin=(0.0, 0.0))
    assert one.centre.symmetric_difference(mirrored).area <= 1e-9 * max(one.centre.area, 1.0)


def test_centres_belong_iff_the_contact_reaches_the_tip_late_enough():
    """Each start followed by hand: first contact on the turning line, then R per radian until the fingertip."""
    half_palm, length, radius = 1.0, 2.0, 0.5
    region = published_sets(half_palm, length, radius, ALPHA, 0.0, 1e-7).centre
    end = pi - acos((half_palm - radius * cos(ALPHA)) / length) - ALPHA
    rng = np.random.default_rng(1)
    starts = np.column_stack([rng.uniform(0.0, 3.0, 4000), rng.uniform(radius, 2.5, 4000)])
    chord = length * sin(end) + radius * cos(end)
    for x, y in starts:
        distance, bearing = np.hypot(x - half_palm, y), np.arctan2(y, x - half_palm)
        if distance < radius:
            continue
        phi, along = bearing - np.arcsin(radius / distance), np.sqrt(distance**2 - radius**2)
        at_tip = phi + (length - along) / radius
        expected = at_tip > end if phi < end else y < chord
        margin = abs(at_tip - end) if phi < end else abs(y - chord)
        if margin > 1e-3 and abs(phi - end) > 1e-3 and phi > 0.0:
            assert region.contains(shapely.Point(x, y)) == expected, (x, y)


def test_whole_is_the_centre_region_grown_and_follows_the_sources_own_curve():
    sets = published_sets(1.0, 2.0, 0.5, ALPHA, 0.0, 1e-6)
    assert sets.whole.symmetric_difference(grown(sets.centre, 0.5, 1e-6)[0]).area < 1e-9
    numbers = sweep(1.0, 2.0, 0.5, ALPHA)
    phi = np.linspace(0.0, numbers.end, 200)
    r = numbers.r0 + 0.5 * phi
    reach, angle = np.sqrt((r + 0.5) ** 2 + 0.25), phi + np.arctan(0.5 / (r + 0.5))
    curve = shapely.points(1.0 + reach * np.cos(angle), reach * np.sin(angle))
    assert shapely.distance(curve, sets.whole.boundary).max() < 2e-6


def test_flattened_sets_lie_inside_finer_ones_within_the_stated_error():
    fine, coarse = (published_sets(1.0, 2.0, 0.5, ALPHA, 0.0, tolerance) for tolerance in (1e-8, 1e-3))
    for name in ("centre", "contact", "whole"):
        inner, outer = getattr(coarse, name), getattr(fine, name)
        assert inner.difference(outer).area < 1e-9
        assert shapely.hausdorff_distance(inner, outer) <= coarse.flattening * 1.001


@pytest.mark.parametrize("opening", [0.3, 1.0, 1.5, 2.0])
def test_an_open_angle_cuts_away_what_lies_behind_or_overlaps_the_fingers(opening):
    full, cut = (published_sets(1.0, 2.0, 0.5, 0.0, each, 1e-5).centre for each in (0.0, opening))
    assert cut.area < full.area
    assert cut.difference(full).area < 1e-3
    finger = shapely.LineString([(1.0, 0.0), (1.0 + 2.0 * cos(opening), 2.0 * sin(opening))])
    assert cut.is_empty or cut.distance(finger) >= 0.5 - 1e-9


def test_no_region_where_the_construction_does_not_exist():
    assert sweep(1.0, 0.4, 0.1, 0.0) is None
    assert published_sets(1.0, 0.4, 0.1, 0.0, 0.0, 1e-4).centre.is_empty
    assert published_sets(1.0, 2.0, 0.5, atan(0.7), 3.0, 1e-4).centre.is_empty
