"""``palmar preshape`` and ``palmar strategies`` as they are called."""

from __future__ import annotations

from math import degrees
from pathlib import Path

import pytest
from PIL import Image

from palmar.studies import strategies

FRICTIONLESS = """
[hand]
palm_width_mm = 120.0
finger_links_mm = [137.0, 107.0]
[object]
radius_mm = 38.0
[contact]
friction = 0.0
restitution = 0.5
[support]
kind = "free"
"""


def test_the_preshape_of_the_test_bed(palmar) -> None:
    answer = palmar("preshape", "testbed_table_thick", "--json")
    record = answer.record
    assert answer.status == 0
    assert degrees(record["angle_rad"]) == pytest.approx(26.0, abs=0.01)
    assert record["pressure"]["uniform"]["angle_rad"] == record["angle_rad"]
    low, high = (degrees(each) for each in record["off_centre_rad"])
    assert (low, high) == pytest.approx((20.65, 31.34), abs=0.02)
    assert record["disc_radius_m"] == pytest.approx(0.23784, abs=1e-5)
    assert record["centrifugal_rad"] is None
    assert "Curled by 26.00 deg" in palmar("preshape", "testbed_table_thick").out


def test_the_preshape_in_free_space(palmar) -> None:
    record = palmar("preshape", "testbed_free", "--json").record
    assert [degrees(each) for each in record["centrifugal_rad"]] == pytest.approx([116.80, 140.41], abs=0.01)
    none = palmar("preshape", "testbed_free_thick", "--check")
    assert none.status == 1 and "at most 0.3003 proximal links" in none.out


def test_the_preshape_for_a_disk_from_straight_ahead(palmar) -> None:
    record = palmar("preshape", "testbed_free", "--from", "90", "--json").record
    low, high = record["direct_m"]
    assert low == pytest.approx(-high)
    assert record["width_m"] == pytest.approx(0.197, abs=1e-3)
    assert sum(record["cone_rad"]) == pytest.approx(3.14159265)
    assert "paths over 197.4 mm end at the palm" in palmar("preshape", "testbed_free", "--from", "90").out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["preshape", "testbed_free", "--from", "0"], "between 0 and 180"),
        (["preshape", "testbed_table", "--from", "90"], "free disks"),
        (["preshape", "chapter2_example", "--from", "90"], "free disks"),
        (["preshape", "zero_g_example"], "fingers of two links"),
        (["preshape", "adaptive_hand"], "for disks"),
        (["strategies", "chapter3_example"], "two links, not 1"),
        (["strategies", "testbed_free", "--out", "x.dxf"], "svg, pdf or png"),
    ],
)
def test_bad_input_is_one_line(palmar, words: list[str], said: str) -> None:
    answer = palmar(*words)
    assert (answer.status, answer.out) == (2, "")
    assert answer.err.count("\n") == 1 and said in answer.err


def test_strategies_side_by_side(palmar, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    effort = strategies.Effort((0.5, 0.75), (0.5, 0.75), 1 / 12, 0, told=1 / 16, counted=True)
    monkeypatch.setattr(strategies, "CAREFUL", effort)
    case, file = tmp_path / "case.toml", tmp_path / "strategies.png"
    case.write_text(FRICTIONLESS)
    answer = palmar("strategies", str(case), "--out", str(file), "--json")
    record, found = answer.record, {each["name"]: each for each in answer.record["strategies"]}
    assert list(found) == ["straight", "centrifugal", "curl first", "coupled"]
    assert record["best"] == "curl first"
    areas = {name: each["area_m2"] for name, each in found.items()}
    assert areas["centrifugal"] < areas["straight"] < areas["coupled"] < areas["curl first"]
    assert found["curl first"]["preshape_rad"] in (0.5, 0.75)
    assert found["curl first"]["search"] == {"step_rad": 0.25, "spacing_m": pytest.approx(0.244 / 12)}
    assert found["coupled"]["ratio"] in (0.5, 0.75)
    assert found["straight"]["preshape_rad"] is None
    with Image.open(file) as picture:
        assert picture.size[0] > 1000
