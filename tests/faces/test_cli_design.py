"""``palmar design`` as it is called."""

from dataclasses import replace
from math import radians

import pytest
from PIL import Image

from palmar.faces.design_record import design_record
from palmar.faces.design_words import design_text
from palmar.faces.plots.design_picture import design_picture
from palmar.models.design_brief_file import open_brief
from palmar.studies.design.circumstances import STRAIGHT
from palmar.studies.design.curled import curling
from palmar.studies.design.design import Design, Option


def test_the_half_octagon(palmar):
    answer = palmar("design", "source_half_octagon", "--json", "--cases", 200)
    record = answer.record
    assert answer.status == 0
    assert record["possible"]
    assert record["size_m"] == pytest.approx(0.16568542)
    assert record["hand"]["finger_links_m"] == pytest.approx([0.04142136, 0.02071068])
    assert record["hand"]["palm_width_m"] == pytest.approx(0.04142136)
    assert record["binds"] == ["largest radius"]
    assert record["verification"] == {"cases": 200, "violations": 0}
    assert record["guarantee"] == "closed_form"
    assert record["error_m"] is None
    assert record["closing"] == {"behaviour": "close"}


def test_a_hand_that_curls_tells_so():
    brief = open_brief("table_parts")[1]
    option = Option(2, brief.limits.hand(0.0001, (0.0757, 0.0113)), (0.0, 0.066), curling(radians(20.0)))
    found = Design(brief, (option,), option, 0.02)
    assert design_record(found)["closing"] == {"behaviour": "curl_and_close", "preshape_rad": radians(20.0)}
    assert "curl the distal joints to 20.0 deg, then close" in design_text("parts", found, by_links=False)
    lines = [len(axes.lines) + len(axes.patches) for axes in design_picture(found).axes]
    straight = replace(found, chosen=replace(option, does=STRAIGHT))
    assert sum(lines) > sum(len(axes.lines) + len(axes.patches) for axes in design_picture(straight).axes)


def test_impossible_is_an_answer(palmar):
    answer = palmar("design", "too_short", "--json")
    assert answer.status == 0
    assert not answer.record["possible"]
    assert answer.record["proven"]
    assert "202 mm long" in answer.record["because"]
    assert palmar("design", "too_short", "--check").status == 1
    assert "Impossible, because" in palmar("design", "too_short").out


def test_fewest_links(palmar):
    answer = palmar("design", "fewest_links", "--links", "--cases", 100)
    assert "Fewest links that will do: 2." in answer.out
    assert "125.92 mm" in answer.out


def test_a_picture_with_the_front(palmar, tmp_path):
    brief, picture = tmp_path / "brief.toml", tmp_path / "front.png"
    brief.write_text("[targets]\nradii_mm = 40\nerror_mm = 30\n[limits]\nmargin = 0\nlinks = [1]\n")
    answer = palmar("design", brief, "--front", 2, "--out", picture, "--cases", 100, "--json")
    assert [error for _, error in answer.record["front"]] == pytest.approx([0.0, 0.045])
    assert answer.record["error_m"] == pytest.approx(0.03, rel=4e-3)
    with Image.open(picture) as drawn:
        assert drawn.size[0] > 1000


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("design", "nothing"), "no shipped brief"),
        (("design", "source_4r", "--front", "-1"), "--front = -1: must be from 0 to 50"),
        (("design", "source_4r", "--out", "x.gif"), "a design is drawn as svg, pdf or png"),
        (("design", "too_short", "--out", "x.png"), "there is no hand to draw"),
        (("design", "source_4r", "--cases", "0"), "--cases = 0"),
    ],
)
def test_bad_input_is_one_line(palmar, words, told):
    answer = palmar(*words)
    assert answer.status == 2
    assert told in answer.err
    assert answer.err.count("\n") == 1
