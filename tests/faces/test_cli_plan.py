"""``palmar plan`` and ``palmar touch`` as they are called."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PIL import Image

from palmar.faces.cli.main import run
from palmar.studies import touch

PLAN = ["plan", "testbed_table", "--at", "0,500", "--uncertainty", "disk:250", "--sensors", "distributed"]


def called(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = 0
    try:
        run(list(words))
    except SystemExit as end:
        status = int(end.code or 0)
    out, err = capsys.readouterr()
    return status, out, err


def test_a_plan_keeps_the_contract(capsys) -> None:
    status, out, err = called(capsys, *PLAN, "--json", "--trial", "3000")
    record = json.loads(out)
    assert status == 0
    assert record["guaranteed"] is True and record["approaches_max"] == 1 and record["minimal"] is True
    policy = record["policy"]
    assert policy["move"] == "approach" and len(policy["outcomes"]) == 11
    assert {each["then"]["move"] for each in policy["outcomes"]} == {"close"}
    assert record["trial"] == {"starts": 3000, "caught": 3000, "lost": 0, "given_up": 0, "approaches_max": 1}
    assert "simulating 3000 objects" in err


def test_no_plan_is_an_answer_with_its_reason(capsys) -> None:
    words = ["plan", "testbed_table", "--at", "0,500", "--uncertainty", "disk:250"]
    status, out, _ = called(capsys, *words, "--json")
    record = json.loads(out)
    assert status == 0
    assert (record["guaranteed"], record["approaches_max"]) == (False, None)
    assert "no sensors" in record["reason"]
    assert record["left_over_m2"] == pytest.approx(0.197, abs=0.002)
    assert called(capsys, *words, "--check")[0] == 1
    assert "Not certain" in called(capsys, *words)[1]


def test_the_text_is_a_tree(capsys) -> None:
    status, out, _ = called(capsys, *PLAN)
    assert status == 0
    assert "Certain, in at most 1 approach (" in out
    assert "  palm:\n    close at (-0, -102" in out or "  palm:\n    close at (0, -102" in out


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_the_hardest_branch_is_drawn(capsys, tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"plan.{ending}"
    assert called(capsys, *PLAN, "--out", str(file))[0] == 0
    assert file.stat().st_size > 5000
    if ending == "png":
        with Image.open(file) as picture:
            assert picture.size[0] > 1000


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([*PLAN, "--approaches-max", "9"], "must be from 0 to 6"),
        ([*PLAN, "--directions", "25"], "must be 1 to 24"),
        ([*PLAN, "--directions=0,x"], "--directions"),
        ([*PLAN, "--directions=0,361"], "from -360 to 360 deg"),
        ([*PLAN, "--directions", "4", "--rule", "strips"], "only with --rule fewest"),
        (["plan", "testbed_table_thick", "--uncertainty", "disk:9", "--rule", "closings"], "pass each other"),
        ([*PLAN, "--trial", "-3"], "must be from 0 to 1000000"),
        ([*PLAN, "--out", "x.dxf"], "svg, pdf or png"),
        ([*PLAN, "--animate", "x.mp4"], "gif"),
        (["plan", "testbed_table", "--uncertainty", "disk:-3"], "above 0"),
        (["plan", "testbed_table", "--uncertainty", "disk:30", "--at", "3"], "X_MM,Y_MM"),
        ([*PLAN[:-1], "palm,right_9"], "the hand has no right_9"),
        ([*PLAN[:-1], "foo"], "must be one of"),
        (["touch", "testbed_table", "--opening", "190"], "must be from 0 to below 180"),
        (["touch", "testbed_table", "--travel", "0"], "above 0 mm"),
        (["touch", "nowhere"], "nowhere"),
        (["touch", "testbed_table", "--out", "x.dxf"], "svg, pdf or png"),
    ],
)
def test_bad_input_is_one_line(capsys, words: list[str], said: str) -> None:
    status, out, err = called(capsys, *words)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1 and said in err


def test_a_plan_is_filmed_from_the_first_approach_to_the_grasp(capsys, tmp_path: Path) -> None:
    file = tmp_path / "plan.gif"
    words = ["plan", "testbed_table", "--at", "0,500", "--uncertainty", "box:800,100", "--sensors", "distributed"]
    assert called(capsys, *words, "--animate", str(file))[0] == 0
    with Image.open(file) as film:
        assert film.n_frames > 30


WIDE = ["plan", "testbed_table", "--at", "0,1000", "--uncertainty", "box:1200,200", "--sensors", "distributed"]


def test_a_bound_for_all_offsets_stands_beside_the_plan(capsys) -> None:
    record = json.loads(called(capsys, *WIDE, "--json")[1])
    assert (record["approaches_max"], record["approaches_least"], record["minimal"]) == (2, 2, True)
    assert "Certain, in at most 2 approaches (no plan needs fewer)." in called(capsys, *WIDE)[1]
    palm = json.loads(called(capsys, *PLAN[:-1], "palm", "--json")[1])
    assert (palm["guaranteed"], palm["approaches_least"], palm["minimal"]) == (False, 4, False)
    assert "It is proved of all offsets and distances that none is there." in called(capsys, *PLAN[:-1], "palm")[1]


def test_a_plan_names_the_direction_of_each_move(capsys, tmp_path: Path) -> None:
    file, film = tmp_path / "turned.png", tmp_path / "turned.gif"
    words = [*WIDE, "--directions", "4", "--out", str(file), "--animate", str(film)]
    record = json.loads(called(capsys, *words, "--json", "--trial", "2000")[1])
    assert record["approaches_max"] == 1
    assert abs(record["policy"]["turn_rad"]) == pytest.approx(1.5707963)
    assert record["trial"]["caught"] == 2000
    text = called(capsys, *WIDE, "--directions=0,-90")[1]
    assert "turn by -90 deg, approach from" in text
    assert file.stat().st_size > 5000 and film.stat().st_size > 5000


def test_a_wide_uncertainty_is_searched_strip_by_strip(capsys, tmp_path: Path) -> None:
    file = tmp_path / "strips.png"
    words = ["plan", "testbed_table", "--at", "0,1500", "--uncertainty", "box:3000,1000", "--sensors", "distributed"]
    none = json.loads(called(capsys, *words, "--json")[1])
    assert none["guaranteed"] is False and none["approaches_least"] == 4
    record = json.loads(called(capsys, *words, "--rule", "strips", "--json", "--trial", "3000", "--out", str(file))[1])
    assert record["guaranteed"] is True and record["rule"] == "strips"
    assert record["approaches_least"] <= record["approaches_max"] == 5
    assert record["trial"]["lost"] == 0 and record["trial"]["approaches_max"] <= 5
    text = called(capsys, *words, "--rule", "strips")[1]
    assert text.count("nothing felt: go on") == 4
    assert file.stat().st_size > 5000


def test_islands_are_closed_on_without_touch(capsys, tmp_path: Path) -> None:
    islands = tmp_path / "islands.geojson"
    boxes = [[[x, y], [x + 80, y], [x + 80, y + 80], [x, y + 80], [x, y]] for x, y in ((0, 0), (900, 0), (0, 900))]
    islands.write_text(json.dumps({"type": "MultiPolygon", "coordinates": [[each] for each in boxes]}))
    film = tmp_path / "islands.gif"
    words = ["plan", "testbed_table", "--at", "0,500", "--uncertainty", str(islands), "--rule", "closings"]
    record = json.loads(called(capsys, *words, "--json", "--trial", "2000", "--animate", str(film))[1])
    assert (record["guaranteed"], record["approaches_max"], record["closings_max"]) == (True, 0, 3)
    assert record["policy"]["if_missed"]["if_missed"]["move"] == "close"
    assert record["trial"]["caught"] == 2000
    text = called(capsys, *words, "--out", str(tmp_path / "islands.svg"))[1]
    assert "Certain, with at most 3 closings and no touch." in text
    assert text.count("fingers closed on nothing: go on") == 2
    refused = called(capsys, *PLAN, "--rule", "closings")[1]
    assert "the object would be pushed unfelt" in refused
    assert film.stat().st_size > 5000


def test_what_touch_buys(capsys, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(touch, "OPENINGS", 5)
    record = json.loads(called(capsys, "touch", "testbed_table", "--sensors", "tips", "--json")[1])
    assert record["felt_m"] < record["touched_m"] == pytest.approx(0.684)
    assert record["connected_ratio"] == pytest.approx(0.5)
    assert len(record["fewest_sensors"]) == 5
    assert record["by_opening"][0]["opening_rad"] == 0.0
    full = json.loads(called(capsys, "touch", "testbed_table", "--sensors", "full", "--json")[1])
    assert full["certain_m"] == full["touched_m"]
    assert full["sensory_area_m2"] > 1.9 * full["closing_area_m2"]
    assert called(capsys, "touch", "testbed_table", "--check")[0] == 1
    file = tmp_path / "touch.svg"
    text = called(capsys, "touch", "testbed_table", "--sensors", "tips", "--out", str(file))[1]
    assert file.read_text().count("What touch buys") == 1
    assert "Fewest sensors with which one approach suffices: 5:" in text
