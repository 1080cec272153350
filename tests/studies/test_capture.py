"""The chance of a catch against simulated starts, and its sampled stand-in for what no region covers."""

import numpy as np
import pytest
from scipy.stats import beta

from palmar.models.case_file import parse_case
from palmar.models.guarantee import Guarantee
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.studies import capture_sampled
from palmar.studies.capture import PoseError, capture_from_region
from palmar.studies.capture_sampled import DRAWS, capture_from_starts, clopper_pearson
from palmar.studies.simulate import simulate_starts

CASE = open_case("testbed_table")[1]
REGION = build_region(CASE)
BLOCK = """
[hand]
palm_width_mm = 120
finger_links_mm = [244]
[object]
shape = "polygon"
vertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]
[contact]
friction = 0.5
"""


def test_the_chance_is_the_share_of_simulated_starts():
    error, at = PoseError((0.12, 0.08), 0.4), (0.05, 0.12)
    found = capture_from_region(REGION, error, at)
    starts = np.array(at) + np.random.default_rng(2).standard_normal((400_000, 2)) @ error.factor.T
    share = (simulate_starts(CASE, starts).codes <= Outcome.CAGED.code).mean()
    assert found.nominal.probability == pytest.approx(share, abs=4.0 * np.sqrt(0.25 / len(starts)))
    assert found.nominal.probability <= found.nominal.at_most < found.nominal.probability + 1e-4
    assert found.guarantee is Guarantee.CLOSED_FORM


def test_moving_the_hand_by_the_offset_puts_the_object_at_the_best_place():
    found = capture_from_region(REGION, PoseError((0.05, 0.05)), (0.04, 0.10))
    assert found.best.probability > found.nominal.probability
    seen = np.array(found.nominal.at) - found.offset
    assert seen == pytest.approx(found.best.at, abs=1e-12)
    assert found.offset[0] == pytest.approx(0.04, abs=1e-4)


def test_the_tolerances_are_the_errors_of_that_chance():
    error, at = PoseError((0.03, 0.02)), (0.0, 0.12)
    for each in capture_from_region(REGION, error, at).tolerances:
        scaled = PoseError((each.nominal * 0.03, each.nominal * 0.02))
        assert capture_from_region(REGION, scaled, at).nominal.probability == pytest.approx(each.wanted, abs=1e-5)
        assert each.best > each.nominal


def test_an_empty_region_catches_nothing():
    small = parse_case("[hand]\npalm_width_mm = 100\nfinger_links_mm = [100]\n[object]\nradius_mm = 700\n")
    found = capture_from_region(build_region(small), PoseError((0.01, 0.01)), (0.0, 0.1))
    assert (found.nominal.probability, found.nominal.loss, found.best, found.offset) == (0.0, 1.0, None, None)


@pytest.mark.parametrize(("hits", "draws"), [(0, 50), (3, 50), (50, 50), (999, 1000)])
def test_the_interval_of_clopper_and_pearson(hits, draws):
    low, high = clopper_pearson(hits, draws)
    assert low == pytest.approx(beta.ppf(0.025, hits, draws - hits + 1) if hits else 0.0)
    assert high == pytest.approx(beta.ppf(0.975, hits + 1, draws - hits) if hits < draws else 1.0)


def test_sampled_chances_of_a_disk_enclose_the_exact_one():
    error, at = PoseError((0.12, 0.08)), (0.05, 0.12)
    exact = capture_from_region(REGION, error, at)
    sampled = capture_from_starts(CASE, error, at)
    assert sampled.nominal.at_least <= exact.nominal.probability <= sampled.nominal.at_most
    assert sampled.best.probability > sampled.nominal.probability
    assert sampled.best.probability <= exact.best.probability + 0.03
    assert sampled.guarantee is Guarantee.SAMPLED
    assert str(DRAWS) in sampled.notes[0]


def test_a_turned_block_is_sampled_and_the_same_every_time(monkeypatch):
    for name in ("DRAWS", "COARSE"):
        monkeypatch.setattr(capture_sampled, name, 300)
    error = PoseError((0.05, 0.05), sigma_theta=0.3)
    one, two = (capture_from_starts(parse_case(BLOCK), error, (0.0, 0.12)) for _ in range(2))
    assert one == two
    assert 0.3 < one.nominal.at_least < one.nominal.probability < one.nominal.at_most
    other = capture_from_starts(parse_case(BLOCK), error, (0.0, 0.12), seed=1)
    assert other.nominal.at_least < one.nominal.at_most and one.nominal.at_least < other.nominal.at_most
