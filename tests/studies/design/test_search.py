"""The searches on slacks whose best is known."""

import pytest

from palmar.models.design_brief import Limits
from palmar.models.design_brief_file import open_brief, parse_brief
from palmar.studies.design.curled import Curled, may_curl
from palmar.studies.design.search import Straight, smallest


def test_the_smallest_size_is_where_the_best_is_just_enough():
    sizes = []

    def best(size):
        sizes.append(size)
        return size - 0.2, (size,)

    assert smallest(best, 0.05, 1.0, 1e-3, 0.1)[0] == pytest.approx(0.2, rel=2e-3)
    assert smallest(best, 0.3, 1.0, 1e-3, 0.1) == (0.3,)
    assert smallest(best, 0.05, 0.19, 1e-3, 0.1) is None
    assert max(sizes) <= 0.31


def test_the_best_proportion_of_straight_fingers():
    search = Straight(lambda d, length, beaten: -abs(d - 0.3 * (d + length)), Limits())
    _, (d, length) = search.best(0.4)
    assert d / (d + length) == pytest.approx(0.3, abs=5e-3)


def test_a_good_proportion_far_from_that_of_another_size_is_found():
    """What does best where nothing is enough need not be near to what is."""

    def slack(d, length, beaten):
        wide = d / (d + length)
        return 0.01 - 0.1 * abs(wide - 0.15) if d + length >= 0.2 else -0.1 - abs(wide - 0.8)

    for fine in (True, False):
        assert sum(smallest(Straight(slack, Limits(), fine).best, 0.1, 10.0, 1e-3, 0.1)) == pytest.approx(0.2, rel=2e-3)


def test_a_yes_is_taken_at_once():
    asked = []
    search = Straight(lambda d, length, beaten: asked.append(d) or 0.0, Limits(), fine=False, yes_or_no=True)
    search.best(0.4)
    assert len(asked) == 1


def test_curled_fingers_are_found_by_their_three_proportions():
    """A peak in palm, proximal link and angle; at a size at which it just does, and none below the reach."""

    def slack(d, proximal, distal, angle, beaten):
        away = abs(d / (d + proximal + distal) - 0.2) + abs(proximal / (proximal + distal) - 0.6) + abs(angle - 0.5)
        return d + proximal + distal - 0.1 - 0.02 * away

    search = Curled(slack, Limits(), 0.05)
    found = smallest(search.best, 0.11, 1.0, 1e-3, 0.1)
    assert 2.0 * sum(found[:3]) == pytest.approx(0.2, rel=0.02)
    assert search.best(0.09) == (pytest.approx(float("-inf")), ())


def test_only_disks_to_be_caught_by_two_links_are_curled_for():
    brief = open_brief("table_parts")[1]
    assert may_curl(brief)
    for update in ({"links": (1, 3)}, {"curl": False}):
        assert not may_curl(brief.model_copy(update={"limits": brief.limits.model_copy(update=update)}))
    assert not may_curl(open_brief("source_half_octagon")[1])
    assert not may_curl(open_brief("square_bar")[1])
    assert not may_curl(parse_brief('[targets]\nradii_mm = 38\nerror_mm = 20\nsensors = "palm"'))
