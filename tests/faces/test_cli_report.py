"""`palmar report`, `palmar cases`, `palmar figures`: pages and lists."""

import math
import re

import pytest

from palmar.models.case_file import parse_case
from palmar.models.shipped import shipped_names
from palmar.studies import report
from palmar.studies.source_numbers import source_numbers
from palmar.studies.strategies import Effort

OF_EACH_KIND = (
    "testbed_table",
    "testbed_free",
    "adaptive_hand",
    "disk_on_a_wall",
    "chapter2_example",
    "barrett_bh8_282",
)


@pytest.fixture(autouse=True)
def hasty(monkeypatch):
    """Strategies by a search of one angle and one ratio, on coarse grids."""
    monkeypatch.setattr(report, "QUICK", Effort((0.4,), (0.5,), 1 / 10, 0, told=1 / 10, counted=True))


@pytest.mark.parametrize("name", OF_EACH_KIND)
def test_a_case_of_each_kind_gives_one_self_contained_page(palmar, tmp_path, name):
    answer = palmar("report", name, "--out", tmp_path / "deep" / "folder")
    assert answer.status == 0
    (page,) = (tmp_path / "deep" / "folder").iterdir()
    assert page.name == f"{name}.html"
    html = page.read_text(encoding="utf-8")
    assert 'src="data:image/svg+xml;base64,' in html
    assert not re.search(r"""(?:src|href)=["'](?!data:)""", html)
    assert "palmar: pictures" in answer.err
    assert "radii held without friction" in answer.out
    assert "None" not in answer.out
    assert "nan" not in answer.out
    if name in ("testbed_table", "testbed_free"):
        told = html.index("How should two joints a finger close?")
        assert told < html.index("Searched: the angle to", told) < html.index("This is a quick search", told)
        best = {"testbed_table": "no rolling (curled by 20.3 deg)", "testbed_free": "curl first (curled by 22.9 deg)"}
        assert f"The largest region: {best[name]}" in html
        theory = {"testbed_table": "Curled by 20.31 deg", "testbed_free": "Curled by 116.8 to 140.4 deg"}
        assert theory[name] in html and theory[name] in answer.out
    elif name == "barrett_bh8_282":
        assert "No comparison: behaviour.bend_deg: strategies are for joints that move one by one" in html
        assert "kept straight" not in html.lower()
    elif name in ("adaptive_hand", "disk_on_a_wall"):
        assert "No comparison: strategies are for disks, plain numbers, and a table without a wall" in html
    else:
        assert "How should two joints" not in html


def test_the_report_as_json(palmar, tmp_path):
    record = palmar("report", "testbed_table", "--out", tmp_path, "--json").record
    assert record["closure"] == palmar("closure", "testbed_table", "--json").record
    assert record["closure"]["structural"]["radius_max_m"] == pytest.approx(0.17748, abs=1e-6)
    assert record["closure_kept_straight"]["structural"]["radius_max_m"] == pytest.approx(0.06)
    page = (tmp_path / "testbed_table.html").read_text(encoding="utf-8")
    assert page.index("Held without friction by proximal links") < page.index("With the fingers kept straight")
    assert [each["closure"] for each in record["regions"]] == ["structural", "frictional"]
    assert record["page"].endswith("testbed_table.html")
    areas = {each["name"]: each["area_m2"] for each in record["closings"]["strategies"]}
    assert record["closings"]["best"] in ("curl first", "no rolling")
    assert areas["straight"] < areas["coupled"] < areas["curl first"]
    search = {each["name"]: each["search"] for each in record["closings"]["strategies"]}
    assert search["straight"] is None and search["coupled"]["spacing_m"] == pytest.approx(0.0244)
    assert math.degrees(record["closings"]["preshape"]["angle_rad"]) == pytest.approx(20.31, abs=0.01)


def test_a_folder_that_cannot_be_made_is_one_line(palmar, tmp_path):
    (tmp_path / "file").write_text("")
    answer = palmar("report", "testbed_table", "--out", tmp_path / "file")
    assert answer.status == 2
    assert answer.err.splitlines()[-1].startswith("palmar: ")
    assert "cannot be made" in answer.err


def test_cases_are_listed_and_printed(palmar):
    listed = palmar("cases", "--json").record["cases"]
    assert [each["name"] for each in listed] == shipped_names()
    assert parse_case(palmar("cases", "testbed_free").out).support.kind.value == "free"
    assert palmar("cases", "nope").status == 2


def test_the_sources_figures_are_drawn(palmar, tmp_path):
    files = palmar("figures", "--out", tmp_path, "--json").record["files"]
    numbers = {re.search(r"(\d_\d)", name).group(1) for name in files}
    assert numbers == {"2_1", "2_2", "2_3", "2_4", "2_5", "2_6", "2_7", "2_8", "3_2", "3_3", "4_4",
                       "5_3", "5_4", "5_5", "5_6", "5_7", "5_8"}  # fmt: skip


def test_regions_of_different_kinds_stand_side_by_side(palmar, tmp_path):
    case = tmp_path / "range.toml"
    case.write_text(
        '[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nshape = "polygon"\n'
        'vertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n[contact]\nfriction = "0.4..0.7"\n'
    )
    answer = palmar("report", case, "--out", tmp_path / "page")
    assert answer.status == 0
    page = (tmp_path / "page" / "range.html").read_text()
    assert "of it certain" in page and "17 combinations of contact.friction" in page


def test_the_sources_numbers_stand_beside_palmars(palmar, monkeypatch):
    monkeypatch.setattr(
        "palmar.studies.source_numbers.source_numbers", lambda: source_numbers(2) + source_numbers(5)[:2]
    )
    rows = palmar("figures", "numbers", "--json").record["numbers"]
    assert rows[3] | {"palmar": 0, "difference": 0} == {
        "chapter": 2, "section": "2.2.2", "figure": "2.5", "what": "largest radius held with friction 0.7",
        "unit": "finger lengths", "source": [2.054], "palmar": 0, "difference": 0, "guarantee": "closed_form", "why": "",
    }  # fmt: skip
    assert rows[3]["palmar"][0] - 2.054 == pytest.approx(rows[3]["difference"][0])
    said = palmar("figures", "numbers").out
    assert "2.054 finger lengths" in said
    assert "R* is 0.6036 there, and 0.5844 where the source sees it." in said
