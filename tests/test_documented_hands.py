"""The numbers of docs/hands.md, computed anew and looked up there; the slower hands by part of their row."""

import importlib.util
from dataclasses import replace
from math import atan, radians
from pathlib import Path

import pytest

from palmar.mechanics.closure.limited import limited_radii, stance_at
from palmar.models.case import Case
from palmar.models.shipped import open_case, shipped_text
from palmar.studies.jointed_closure import limited_hand

DOCS = Path(__file__).parents[1] / "docs"
PAGE = (DOCS / "hands.md").read_text(encoding="utf-8")


def script():
    spec = importlib.util.spec_from_file_location("hands_figures", DOCS / "hands_figures.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


FIGURES = script()


def case(name: str) -> Case:
    return open_case(name)[1]


def span(low: float, high: float) -> str:
    return f"{2e3 * low:.0f} to {2e3 * high:.0f}"


def test_every_row_is_a_shipped_case_that_names_its_sources():
    for name, title in FIGURES.HANDS.items():
        assert f"| {title} |" in PAGE
        text = shipped_text(name)
        assert "# Sources:" in text and "Confidence" in text and "# Approximated" in text


def test_a_whole_row():
    assert f"| Kinova KG-3 | {' | '.join(FIGURES.rows(case('kinova_kg_3')))} |" in PAGE


@pytest.mark.parametrize("name", ["robotiq_2f_85", "robotiq_2f_140", "robotiq_3_finger", "schunk_sdh_2"])
def test_what_is_held_without_friction(name: str):
    (interval,) = limited_radii(limited_hand(case(name).hand, 0.0)).intervals
    assert f"| {FIGURES.HANDS[name]} | {span(*interval)} |" in PAGE


def test_the_smallest_disk_depends_on_the_base_joints_limit():
    hand = limited_hand(case("robotiq_2f_85").hand, 0.0)
    found = []
    for limit in (90.0, 105.0):
        limits = ((hand.limits[0][0], radians(limit)), hand.limits[1])
        found.append(f"{2e3 * limited_radii(replace(hand, limits=limits)).intervals[0][0]:.0f}")
    assert found == ["55", "42"]
    assert "the smallest is 55, 50, 46 and 42 mm" in PAGE


def test_the_makers_largest_disk_needs_friction():
    hand = case("robotiq_3_finger").hand
    assert "A\ndisk of 155 mm is held from a friction of 0.29 on" in PAGE
    assert stance_at(limited_hand(hand, atan(0.285)), 0.0775) is None
    stance = stance_at(limited_hand(hand, atan(0.295)), 0.0775)
    assert stance is not None and (stance.last, stance.carrier) == (3, None)
