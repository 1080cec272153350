"""From case to region: what is covered, what is refused, what is said."""

import pytest

from palmar.errors import NotCoveredError
from palmar.models.case_file import parse_case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.shipped import open_case
from palmar.regions.build import published_region

EXAMPLE = open_case("chapter3_example")[1]


def test_the_example_with_its_guarantee_and_its_warning():
    region = published_region(EXAMPLE)
    assert region.guarantee is Guarantee.CONSTRUCTION
    assert region.area == pytest.approx(6.328, abs=1e-3)
    assert region.allowed_error is not None
    assert region.allowed_error.radius == pytest.approx(0.7785, abs=1e-3)
    assert "promised starts are lost" in region.notes[0]
    structural = published_region(EXAMPLE, Closure.STRUCTURAL)
    assert structural.area == pytest.approx(4.770, abs=1e-3)
    assert structural.notes == ()


def test_the_allowed_error_fits_and_touches():
    region = published_region(EXAMPLE)
    circle = region.allowed_error
    from shapely import Point

    assert region.centre.buffer(1e-9).contains(Point(circle.centre).buffer(circle.radius * (1 - 1e-6)))
    assert region.centre.boundary.distance(Point(circle.centre)) == pytest.approx(circle.radius, rel=1e-9)


def test_an_object_that_is_not_held_gives_an_empty_region_with_the_reason():
    text = "[hand]\npalm_width_mm = 2000\nfinger_links_mm = [2000]\n[object]\nradius_mm = 1500\n"
    region = published_region(parse_case(text), Closure.STRUCTURAL)
    assert region.centre.is_empty
    assert region.area == 0.0
    assert region.allowed_error is None
    assert "no structural hold" in region.reason
    assert not published_region(parse_case(text)).centre.is_empty


@pytest.mark.parametrize(
    ("name", "said"), [("testbed_free", "support.kind"), ("adaptive_hand", "object.shape"), ("range", "plain numbers")]
)
def test_cases_that_the_model_does_not_cover_are_refused(name, said):
    text = '[hand]\npalm_width_mm = 200\nfinger_links_mm = [200]\n[object]\nradius_mm = "40..50"\n'
    case = parse_case(text) if name == "range" else open_case(name)[1]
    with pytest.raises(NotCoveredError, match=said):
        published_region(case)


def test_what_the_construction_ignores_is_said():
    notes = " ".join(published_region(open_case("testbed_table_thick")[1]).notes)
    for word in ("kept straight", "thickness 25 mm", "pass each other"):
        assert word in notes
