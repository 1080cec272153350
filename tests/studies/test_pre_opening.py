"""The smallest safe pre-opening of a case."""

from math import cos, pi, radians

import numpy as np
import pytest
from shapely import Point, box

from palmar.errors import NotCoveredError
from palmar.models.closure import Closure
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions.region import Model
from palmar.studies.pre_opening import pre_opening, time_saved, tip_gap
from palmar.studies.simulate import simulate_starts

CASE = open_case("testbed_table")[1]


def test_one_point_is_safe_up_to_the_documented_angle():
    # docs/assumptions.md: a disk at (0, 120) mm, fingers 25 mm thick, overlaps beyond 94.5 degrees.
    found = pre_opening(
        open_case("testbed_table_thick")[1], Point(0, 0).buffer(1e-7), (0.0, 0.12), closure=Closure.STRUCTURAL
    )
    assert found.nominal.smallest == pytest.approx(radians(94.5), abs=radians(0.05))
    assert found.now


@pytest.mark.parametrize("model", [Model.EXACT, Model.PUBLISHED])
def test_the_uncertain_disk_is_caught_from_the_smallest_opening(model):
    errors, at = box(-0.04, -0.02, 0.04, 0.02), (0.01, 0.12)
    found = pre_opening(CASE, errors, at, model)
    opened = CASE.model_copy(update={"hand": CASE.hand.model_copy(update={"open": found.nominal.smallest})})
    rng = np.random.default_rng(1)
    starts = np.array(at) + rng.uniform((-0.04, -0.02), (0.04, 0.02), (5000, 2))
    assert (simulate_starts(opened, starts).codes <= Outcome.CAGED.code).all()
    assert found.best.smallest >= found.nominal.smallest
    assert found.widest.allowed > 0.09


def test_too_large_an_error_has_none():
    found = pre_opening(CASE, Point(0, 0).buffer(0.2), (0.0, 0.12))
    assert (found.nominal.smallest, found.best.smallest, found.now) == (None, None, False)


def test_gap_and_time():
    assert tip_gap(CASE.hand, 0.0) == pytest.approx(0.12 + 2 * 0.244)
    assert tip_gap(CASE.hand, 0.5 * pi + 0.3) == pytest.approx(2 * (0.06 + 0.244 * cos(0.5 * pi + 0.3)))
    assert time_saved(CASE.hand, radians(60.0)) == pytest.approx(2.0)


def test_what_has_no_region_has_no_opening():
    with pytest.raises(NotCoveredError, match="free"):
        pre_opening(open_case("testbed_free")[1], Point(0, 0).buffer(0.01), (0.0, 0.12))
