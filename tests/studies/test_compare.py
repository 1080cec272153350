"""Two models of one case: what one promises and the other denies, and the start that shows it."""

import pytest

from palmar.models.closure import Closure
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.regions.region import Model
from palmar.studies.compare import compare_regions

CASE = open_case("chapter3_example")[1]
MODELS = (Model.EXACT, Model.PUBLISHED)


def test_the_published_region_promises_starts_that_escape():
    found = {each.promised_by: each for each in compare_regions(CASE, MODELS, Closure.FRICTIONAL).differences}
    broken, kept = found[Model.PUBLISHED], found[Model.EXACT]
    assert broken.outcome is Outcome.ESCAPED
    assert broken.end == pytest.approx((0.0, 2.291), abs=0.1)
    assert broken.where.area == pytest.approx(0.386, abs=0.002)
    assert kept.outcome.caught


def test_without_friction_the_published_region_is_sound():
    found = compare_regions(CASE, MODELS, Closure.STRUCTURAL).differences
    assert [each.promised_by for each in found] == [Model.EXACT]
    assert found[0].outcome.caught
