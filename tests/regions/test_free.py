"""From a case with a free disk to the regions by three impacts: what is covered, refused, and said."""

import pytest

from palmar.errors import NotCoveredError
from palmar.models.case_file import parse_case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.region import Model

EXAMPLE = open_case("zero_g_example")[1]
TEXT = '[hand]\npalm_width_mm = {palm}\nfinger_links_mm = [244]\n[object]\nradius_mm = {radius}\n[support]\nkind = "free"\n'


def case(palm: float = 120, radius: object = 38, more: str = ""):
    return parse_case(TEXT.format(palm=palm, radius=radius) + more)


@pytest.mark.parametrize(("model", "area"), [(Model.PUBLISHED, 196.0e-4), (Model.CORRECTED, 270.4e-4)])
def test_the_example_with_its_guarantee_and_closure(model, area):
    region = build_region(EXAMPLE, model)
    assert region.guarantee is Guarantee.CONSTRUCTION
    assert (region.model, region.closure) == (model, Closure.STRUCTURAL)
    assert region.area == pytest.approx(area, abs=0.5e-4)
    assert region.whole.covers(region.centre)


def test_each_says_its_erratum_or_its_reach():
    published, corrected = (" ".join(build_region(EXAMPLE, each).notes) for each in (Model.PUBLISHED, Model.CORRECTED))
    assert "4.9 is used as printed" in published
    assert corrected == ""
    tight = build_region(case(radius=55, more="[contact]\nfriction = 0\n"), Model.CORRECTED)
    assert "nearly fills the hand" in " ".join(tight.notes)


def test_what_the_construction_ignores_is_said_and_changes_nothing():
    more = "[contact]\nfriction = 0.4\nrestitution = 0.5\n[start]\nvelocity_mm_s = [1, 0]\n"
    region = build_region(case(more=more), Model.CORRECTED)
    words = " ".join(region.notes)
    for word in ("restitution is taken as 1", "frictionless", "at rest"):
        assert word in words
    assert region.area == pytest.approx(build_region(EXAMPLE, Model.CORRECTED).area, rel=1e-12)
    thick = " ".join(build_region(open_case("testbed_free_thick")[1], Model.CORRECTED).notes)
    for word in ("kept straight", "thickness 25 mm", "pass each other"):
        assert word in thick


def test_ranges_without_effect_are_taken_and_others_refused():
    elastic = case(more='[contact]\nrestitution = "0.3..1.0"\n')
    assert build_region(elastic, Model.CORRECTED).area == pytest.approx(0.02704, abs=1e-5)
    assert "restitution is taken as 1" in " ".join(build_region(elastic, Model.CORRECTED).notes)
    with pytest.raises(NotCoveredError, match=r"object\.radius: the corrected region takes plain numbers"):
        build_region(case(radius='"30..40"'), Model.CORRECTED)


def test_a_disk_that_is_not_held_gives_an_empty_region_with_the_reason():
    region = build_region(case(radius=70), Model.CORRECTED)
    assert region.centre.is_empty
    assert "no structural hold" in region.reason
    wide = build_region(case(palm=700, radius=250), Model.CORRECTED)
    assert wide.centre.is_empty
    assert wide.reason is not None


@pytest.mark.parametrize(
    ("name", "model", "said"),
    [
        ("testbed_table", Model.CORRECTED, 'support.kind = "table"'),
        ("adaptive_hand", Model.CORRECTED, 'support.kind = "table"'),
    ],
)
def test_cases_that_the_model_does_not_cover_are_refused(name, model, said):
    with pytest.raises(NotCoveredError, match=said):
        build_region(open_case(name)[1], model)


def test_a_free_polygon_is_refused():
    text = '[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nshape = "polygon"\n'
    text += 'vertices_mm = [[0, 0], [40, 0], [0, 40]]\n[support]\nkind = "free"\n'
    with pytest.raises(NotCoveredError, match="is for disks"):
        build_region(parse_case(text), Model.PUBLISHED)
