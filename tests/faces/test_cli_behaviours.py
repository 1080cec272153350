"""`palmar behaviours`: what there is, a run with its record and files, and what is refused."""

import json

import pytest

from palmar.faces.exports.trace_file import read_trace
from palmar.faces.trace_record import whole_record

SCOOP = """
[hand]
palm_width_mm = 120
finger_links_mm = [137, 107]
[object]
radius_mm = 38
[sensors]
layout = "palm"
[start]
at_mm = [20, 100]
[behaviour]
name = "scoop"
advance_mm = 80
speed_mm_s = 200
"""


@pytest.fixture
def scoop(tmp_path):
    path = tmp_path / "scoop.toml"
    path.write_text(SCOOP, encoding="utf-8")
    return path


@pytest.mark.parametrize("words", [(), ("list",)])
def test_list_names_every_behaviour(palmar, words):
    answer = palmar("behaviours", *words, "--json")
    names = [each["name"] for each in answer.record["behaviours"]]
    assert names[0] == "close"
    assert {"move_and_grab", "scoop", "jointed", "follow_policy"} <= set(names)
    assert "scoop" in palmar("behaviours", *words).out


def test_describe_tells_steps_and_parameters_with_their_units(palmar):
    record = palmar("behaviours", "describe", "move_while_closing", "--json").record
    assert record["parameters"] == {"advance_mm": 100.0, "speed_mm_s": 100.0, "direction_deg": 90.0, "first_mm": 0.0}
    assert len(record["steps"]) == 3
    text = palmar("behaviours", "describe", "palm_reflex").out
    assert "delay_s = 0" in text
    assert "sensor on the palm" in text


def test_run_takes_the_behaviour_of_the_case(palmar, scoop):
    answer = palmar("behaviours", "run", scoop, "--tick", 10, "--json")
    assert (answer.status, answer.err) == (0, "")
    record = answer.record
    assert set(record) >= {"behaviour", "outcome", "caught", "verdict", "ended", "final", "events", "seconds"}
    assert (record["behaviour"], record["caught"], record["ended"]) == ("scoop", True, "stopped")
    fires = next(each for each in record["events"] if each["kind"] == "fires")
    assert (fires["what"], fires["t_s"]) == ("palm", pytest.approx(0.31, abs=0.011))
    assert record["final"]["arm"]["y_m"] == pytest.approx(0.062, abs=0.0021)
    assert len(record["final"]["finger_rad"]) == 2
    text = palmar("behaviours", "run", scoop, "--tick", 10).out
    assert "the palm feels it: close" in text
    assert "verdict" in text


def test_closing_ends_as_simulate_says(palmar):
    here = palmar("behaviours", "run", "testbed_table", "--start", "100,90", "--tick", 50, "--json").record
    there = palmar("simulate", "testbed_table", "--start", "100,90", "--json").record
    assert here["outcome"] == there["outcome"]
    assert here["final"]["x_m"] == pytest.approx(there["final"]["x_m"], abs=1e-5)
    assert here["final"]["y_m"] == pytest.approx(there["final"]["y_m"], abs=1e-5)
    assert here["seconds"] == pytest.approx(there["events"][-1]["t_s"], abs=0.051)


def test_closing_on_a_free_disk_ends_as_simulate_says(palmar):
    words = ("zero_g_example", "--start", "40,140", "--velocity", "-5,4")
    here = palmar("behaviours", "run", *words, "--json").record
    there = palmar("simulate", *words, "--json").record
    assert here["outcome"] == there["outcome"]
    assert (here["ended"], here["caught"]) == ("stopped", True)


@pytest.mark.parametrize("ending", ["json", "csv"])
def test_a_run_with_a_tracker_is_kept_with_what_it_told(palmar, tmp_path, ending):
    path = tmp_path / f"run.{ending}"
    words = ("zero_g_example", "--behaviour", "match_velocity", "--start", "50,140", "--velocity", "30,-10")
    told = palmar("behaviours", "run", *words, "--track", "40,2,1", "--seed", 3, "--tick", 50, "--out", path, "--json")
    assert told.record["outcome"] == "caged"
    rows = read_trace(path).trace.rows
    x, y, vx, vy = rows[10].seen.track
    assert (x, y) == pytest.approx((0.05 + 0.03 * 0.46, 0.14 - 0.01 * 0.46), abs=0.008)
    assert (vx, vy) == pytest.approx((0.03, -0.01), abs=0.004)
    assert (vx, vy) != (0.03, -0.01)
    again = palmar("behaviours", "replay", path, "--json").record
    assert again["events"] == told.record["events"]
    assert again["final"]["x_m"] == pytest.approx(told.record["final"]["x_m"], rel=1e-12)


@pytest.mark.parametrize("ending", ["json", "csv"])
def test_a_trace_is_the_same_once_read_again(palmar, scoop, tmp_path, ending):
    first, second = tmp_path / f"first.{ending}", tmp_path / "second.json"
    told = palmar("behaviours", "run", scoop, "--tick", 20, "--out", first, "--json").record
    again = palmar("behaviours", "replay", first, "--out", second, "--json").record
    assert again["events"] == told["events"]
    assert again["final"]["x_m"] == pytest.approx(told["final"]["x_m"], rel=1e-12)
    one, other = read_trace(first), read_trace(second)
    assert one.case == other.case
    assert whole_record(one) == whole_record(other)
    assert len(one.trace.rows) > 50


def test_a_trace_is_drawn_from_the_run_and_from_its_file(palmar, scoop, tmp_path):
    kept, drawn, redrawn = tmp_path / "run.json", tmp_path / "one.svg", tmp_path / "two.svg"
    palmar("behaviours", "run", scoop, "--tick", 20, "--out", kept)
    assert palmar("behaviours", "run", scoop, "--tick", 20, "--out", drawn).status == 0
    assert f"Written: {redrawn}" in palmar("behaviours", "replay", kept, "--out", redrawn).out
    assert drawn.read_text(encoding="utf-8") == redrawn.read_text(encoding="utf-8")
    assert "scoop" in drawn.read_text(encoding="utf-8")


def test_a_start_inside_the_hand_is_told_and_kept(palmar, scoop, tmp_path):
    path = tmp_path / "run.csv"
    answer = palmar("behaviours", "run", scoop, "--start", "0,10", "--out", path, "--json")
    assert (answer.record["outcome"], answer.record["ended"]) == ("invalid", "broken")
    assert palmar("behaviours", "replay", path, "--json").record == answer.record


def test_check_tells_by_the_exit_status(palmar, scoop):
    assert palmar("behaviours", "run", scoop, "--tick", 20, "--check").status == 0
    assert palmar("behaviours", "run", scoop, "--tick", 20, "--start", "0,500", "--check").status == 1


@pytest.mark.parametrize(("words", "said"), [
    (("describe", "scop"), "did you mean scoop?"),
    (("describe",), "requires an argument"),
    (("run", "testbed_table", "--behaviour", "dance"), "must be one of close"),
    (("run", "testbed_table", "--behaviour", "scoop"), "needs a sensor on the palm"),
    (("run", "testbed_table", "--start", "1"), "X_MM,Y_MM"),
    (("run", "testbed_table", "--tick", "0"), "--tick"),
    (("run", "testbed_table", "--missed", "2"), "--missed"),
    (("run", "testbed_table", "--seed", "-1"), "--seed"),
    (("run", "testbed_table", "--out", "run.doc"), "must end in one of"),
    (("run", "testbed_table", "--velocity", "10,0"), "starts at rest"),
    (("run", "testbed_table", "--track", "0,0,0"), "only free disks are tracked"),
    (("run", "testbed_free", "--velocity", "10"), "VX,VY"),
    (("run", "testbed_free", "--track", "10,-1,0"), "must not be negative"),
    (("run", "testbed_free", "--massive"), "does not stay where it is touched"),
    (("replay", "nothing.json"), "cannot be read"),
])  # fmt: skip
def test_bad_input_is_one_line(palmar, words, said):
    answer = palmar("behaviours", *words)
    assert (answer.status, answer.out) == (2, "")
    assert said in answer.err
    assert answer.err.startswith("palmar: ")
    assert answer.err.count("\n") == 1


@pytest.mark.parametrize("text", ["", "[]", "{}", "# {}\n", '{"rows": []}', "# [\n1"])
@pytest.mark.parametrize("ending", ["json", "csv"])
def test_a_file_that_is_no_trace_is_refused(palmar, tmp_path, text, ending):
    path = tmp_path / f"bad.{ending}"
    path.write_text(text, encoding="utf-8")
    answer = palmar("behaviours", "replay", path)
    assert (answer.status, answer.out) == (2, "")
    assert "no trace" in answer.err


@pytest.mark.parametrize(("line", "said"), [
    ("first_mm = 90", "cannot be more"),
    ("speed_mm_s = 0", "must be greater than 0 mm/s"),
    ("delay_s = -1", "must be at least 0 s"),
    ("hurry = 1", "unknown key"),
    ('name2 = "x"', "did you mean name?"),
])  # fmt: skip
def test_a_wrong_parameter_in_a_case_is_one_line(palmar, tmp_path, line, said):
    path = tmp_path / "case.toml"
    text = SCOOP.replace("speed_mm_s = 200\n", "") if line.startswith("speed") else SCOOP
    path.write_text(f"{text}{line}\n", encoding="utf-8")
    answer = palmar("behaviours", "run", path)
    assert answer.status == 2
    assert said in answer.err
    assert answer.err.count("\n") == 1


def test_regions_and_simulate_leave_other_behaviours_to_this_command(palmar, scoop):
    for command in ("region", "simulate"):
        answer = palmar(command, scoop)
        assert answer.status == 2
        assert "scoop" in answer.err


def test_a_trace_file_can_be_read_by_anyone(palmar, scoop, tmp_path):
    path = tmp_path / "run.json"
    palmar("behaviours", "run", scoop, "--tick", 50, "--out", path)
    record = json.loads(path.read_text(encoding="utf-8"))
    assert record["sensors"] == ["palm"]
    assert {len(row["bits"]) for row in record["rows"]} == {1}
    assert record["rows"][0]["object"] == pytest.approx([0.02, 0.1, 0.0])


def test_region_of_a_behaviour_is_a_region_record(palmar, scoop, tmp_path):
    out = tmp_path / "region.svg"
    answer = palmar(
        "behaviours", "region", str(scoop), "--tolerance", "60", "--tick", "100", "--out", str(out), "--json"
    )
    assert answer.record["guarantee"] == "sampled"
    assert answer.record["area_m2"] > 0.01
    assert answer.record["notes"][0].endswith("observed every 100 ms")
    assert "<svg" in out.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("--tick", "0"), "--tick"),
        (("--behaviour", "scop"), "did you mean scoop"),
        (("--tolerance", "-1"), "--tolerance"),
        (("--out", "x.bmp"), "svg"),
    ],
)
def test_region_of_a_behaviour_refuses_in_one_line(palmar, scoop, words, complaint):
    answer = palmar("behaviours", "region", str(scoop), *words)
    assert answer.status == 2
    assert complaint in answer.err
    assert answer.err.count("\n") == 1


TRACKED = ("testbed_free", "--behaviour", "matched_return", "--velocity", "0,-90", "--track", "50,4,20", "--seed", "3")


def test_chance_is_that_of_runs_with_their_own_errors(palmar):
    answer = palmar("behaviours", "chance", *TRACKED, "--start", "20,120", "--runs", 6, "--tick", 50, "--json")
    record = answer.record
    assert record["runs"] == 6 == sum(each["runs"] for each in record["ends"])
    assert record["chance"]["low"] <= record["caught"] / 6 <= record["chance"]["high"]


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("region", *TRACKED, "--draws", "0"), "--draws"),
        (("region", *TRACKED[:5], "--draws", "2"), "needs a tracker with errors"),
        (("chance", *TRACKED[:5]), "--track"),
        (("chance", *TRACKED, "--runs", "0"), "--runs"),
        (("chance", "testbed_free", "--track", "0,1,1"), "matched_return"),
    ],
)
def test_tracked_behaviours_refuse_in_one_line(palmar, words, complaint):
    answer = palmar("behaviours", *words)
    assert answer.status == 2
    assert complaint in answer.err
    assert answer.err.count("\n") == 1
