"""The brief's file: units, ranges, and one plain line for what is wrong."""

from math import atan

import pytest

from palmar.errors import InputError
from palmar.models.design_brief_file import (
    brief_tables,
    build_brief,
    dump_brief,
    open_brief,
    parse_brief,
    shipped_briefs,
)


def test_units_ranges_and_margin():
    brief = parse_brief('[targets]\nradii_mm = [40, 25]\nfriction = "0.2..0.8"\nerror_mm = 10\n[limits]\nmargin = 0.1')
    assert brief.targets.radii == (0.025, 0.04)
    assert brief.held == pytest.approx((0.0225, 0.044))
    assert brief.error == pytest.approx(0.011)
    assert brief.least_friction.friction_angle == pytest.approx(atan(0.18))
    assert brief.limits.links == (1, 2, 3)


def test_a_single_number_is_a_range_of_one():
    assert parse_brief("[targets]\nradii_mm = 30").targets.radii == (0.03, 0.03)
    assert parse_brief("[targets]\nradii_mm = 30\n[limits]\npalm_width_mm = 80").limits.palm_width == (0.08, 0.08)


@pytest.mark.parametrize("name", shipped_briefs())
def test_a_brief_written_back_is_the_same(name):
    brief = open_brief(name)[1]
    assert parse_brief(dump_brief(brief)) == brief
    assert build_brief(brief_tables(brief)) == brief


def test_a_brief_is_written_in_the_files_units_with_its_ranges():
    table = brief_tables(parse_brief('[targets]\nradii_mm = "25..45"\nfriction = 0.5\nerror_mm = 20'))["targets"]
    assert (table["radii_mm"], table["friction"], table["error_mm"]) == ("25..45", 0.5, 20.0)


def test_ten_briefs_are_shipped():
    assert len(shipped_briefs()) == 10
    assert all(open_brief(name)[1].targets for name in shipped_briefs())


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[limits]\nmargin = 0", "[targets]: is missing"),
        ("[targets]\nradius_mm = 3", "did you mean radii_mm?"),
        ('[targets]\nradii_mm = "40..25"', "the lower end comes first"),
        ('[targets]\nradii_mm = "wide"', 'must be a number, "low..high" or a list of numbers'),
        ("[targets]\nradii_mm = -3", "must be at least"),
        ("[targets]\nfriction = 0.5", "exactly one of radii_mm and vertices_mm"),
        ("[targets]\nradii_mm = 3\nfriction = -1", "must be at least 0"),
        ('[targets]\nradii_mm = 3\nsensors = "palm"\nerror_mm = 2\nsupport = "free"', 'support = "table"'),
        ("[targets]\nradii_mm = 3\n[limits]\ncurl = 3", "limits.curl"),
        ('[targets]\nradii_mm = 3\nsensors = "nose"\nerror_mm = 2', "targets.sensors"),
        ("[targets]\nradii_mm = 3\n[limits]\nlinks = [0]", "must be at least 1"),
        ("targets = 3", "must be a table"),
        ("[targets]\nradii_mm = [true]", "must be a list of numbers"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(text, told):
    with pytest.raises(InputError) as caught:
        parse_brief(text)
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unknown_name_lists_the_shipped_ones():
    with pytest.raises(InputError, match=r"shipped are .*source_4r"):
        open_brief("source")
