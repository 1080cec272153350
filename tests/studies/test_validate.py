"""Random starts inside and around a region: drawn where they should be, and counted on the right side."""

from __future__ import annotations

from dataclasses import replace

import pytest
import shapely
from shapely import affinity

from palmar.errors import InputError, NotCoveredError
from palmar.geometry.planar_set import EMPTY, areal
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.regions.build import build_region
from palmar.regions.region import Region
from palmar.studies.validate import validate

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n"
RADIUS, MARGIN = 0.038, 2e-3


@pytest.fixture(scope="module")
def bed() -> tuple[Case, Region]:
    case = parse_case(HAND + "[object]\nradius_mm = 38\n")
    return case, build_region(case)


def test_the_kernels_agree_with_their_region(bed: tuple[Case, Region]) -> None:
    case, region = bed
    found = validate(case, region, 301, 4, MARGIN)
    assert [found.count(inside=a, caught=b) for a in (True, False) for b in (True, False)] == [151, 0, 0, 150]
    assert found.surprises == ()
    assert region.outer is not None
    edge, near = region.centre.boundary, region.outer.buffer(2.0 * RADIUS)
    for each in found.tried:
        point = shapely.Point(each.start[:2])
        assert region.centre.contains(point) == each.inside
        assert each.distance >= MARGIN
        assert each.distance == pytest.approx((edge if each.inside else region.outer).distance(point))
        assert near.contains(point)
        assert each.start[1] >= RADIUS
    assert validate(case, region, 301, 4, MARGIN) == found
    assert validate(case, region, 301, 5, MARGIN) != found


def test_a_wrong_region_is_found_out(bed: tuple[Case, Region]) -> None:
    """Moved by 30 mm it promises what is lost on one side, and denies what is caught on the other."""
    case, region = bed
    moved = replace(region, centre=areal(affinity.translate(region.centre, 0.03, 0.0)), outer=None)
    found = validate(case, moved, 200, 4)
    lost, caught = found.count(inside=True, caught=False), found.count(inside=False, caught=True)
    assert lost > 5 and caught > 10
    assert len(found.surprises) == lost + caught
    assert found.surprises[0].distance == max(each.distance for each in found.tried if not each.as_told) > 0.01


def test_what_cannot_be_tried(bed: tuple[Case, Region]) -> None:
    case, region = bed
    assert validate(case, replace(region, centre=EMPTY), 10, 1).tried == ()
    with pytest.raises(InputError, match="margin"):
        validate(case, region, 10, 1, 0.5)
    vague = parse_case(HAND + '[object]\nradius_mm = 38\n[contact]\nfriction = "0.2..0.8"\n')
    with pytest.raises(NotCoveredError, match="ranges"):
        validate(vague, region, 10, 1)
