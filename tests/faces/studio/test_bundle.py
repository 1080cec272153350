"""The page's files, and what the page is told first."""

import json
import re

import pytest

from palmar.faces.studio import bundle
from palmar.faces.studio.bundle import ALWAYS_ASK, FOREVER, assets
from palmar.faces.studio.hello import hello
from palmar.models.hand import Hand


def test_the_page_names_only_files_that_are_there_and_none_of_another_site():
    known = assets()
    page = known[""].data.decode()
    named = re.findall(r'(?:src|href)="\./([^"]+)"', page)
    assert len(named) >= 3
    assert [name for name in named if name not in known] == []
    assert "//" not in page.replace("<!doctype html>", "")
    assert known[""].cache == ALWAYS_ASK
    assert {known[name].cache for name in named if name.startswith("assets/")} == {FOREVER}
    assert known[next(name for name in named if name.endswith(".js"))].media_type == "text/javascript; charset=utf-8"


def test_without_a_bundle_the_page_says_how_to_build_it(monkeypatch, tmp_path):
    monkeypatch.setattr(bundle.resources, "files", lambda package: tmp_path)
    assert b"dev.py web" in assets()[""].data


def test_the_greeting_tells_units_bounds_and_choices():
    told = json.loads(json.dumps(hello(), allow_nan=False))
    hand = told["keys"]["hand"]
    assert hand.keys() >= {"palm_width_mm", "finger_links_mm", "fingers", "open_deg"}
    assert len(hand) == len(Hand.model_fields)
    assert hand["palm_width_mm"] == {"type": "number", "unit": "mm", "minimum": pytest.approx(1e-6), "maximum": 1e6}
    assert hand["fingers"]["choices"] == ["crossing", "colliding"]
    assert hand["finger_rate_deg_s"]["default"] == 30.0
    assert told["keys"]["object"]["polygon"]["vertices_mm"]["type"] == "points"
    assert {each["name"] for each in told["behaviours"]} >= {"close", "scoop"}
