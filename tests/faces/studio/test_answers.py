"""The page's answers are the command line's."""

import json
from pathlib import Path

import pytest

from palmar.errors import InputError
from palmar.faces.records import finite
from palmar.faces.studio.answering import answered
from palmar.faces.studio.answers.export import WRITERS
from palmar.faces.studio.kinds import EXPORTS, STEPS, Kind
from palmar.models.case_file import parse_case
from palmar.models.shipped import shipped_text

CASE = "chapter3_example"
TRIANGLE = {
    "hand": {"palm_width_mm": 120, "finger_links_mm": [244]},
    "object": {"shape": "polygon", "vertices_mm": [[-40, -30], [40, -30], [0, 45]]},
}
SETS = ("centre", "contact", "whole", "outer", "certain")


def parts(kind, parameters=None, case=CASE, steps=None):
    """{(name, stage): value} of all steps; the case as the page has it, in tables."""
    text = None if case is None else shipped_text(case)
    found = {}
    for step in range(len(STEPS[kind])) if steps is None else steps:
        for each in answered(kind, step, text, parameters or {}):
            found[each.name, each.stage] = json.loads(json.dumps(finite(each.value), allow_nan=False))
    return found


def test_a_look_ends_with_the_command_lines_numbers(palmar):
    look = parts(Kind.LOOK)
    region = palmar("region", CASE, "--json").record
    assert look["region", "settled"]["record"] | look["validity", "settled"] == {
        name: each for name, each in region.items() if name not in SETS
    }
    assert look["closure", "settled"] == palmar("closure", CASE, "--json").record


def test_the_first_region_of_a_look_is_nearly_the_last_one():
    look = parts(Kind.LOOK)
    first, last = (look["region", stage]["record"] for stage in ("quick", "settled"))
    assert first["guarantee"] == last["guarantee"] == "closed_form"
    assert first["area_m2"] == pytest.approx(last["area_m2"], rel=1e-4)
    assert first["area_m2"] != last["area_m2"]


def test_the_first_verdict_on_bent_fingers_has_the_last_ones_radii():
    look = parts(Kind.LOOK, case="testbed_table")
    first, last = (look["closure", stage] for stage in ("quick", "settled"))
    assert {name: first[name] for name in ("structural", "frictional", "object")} == {
        name: last[name] for name in ("structural", "frictional", "object")
    }
    assert ("closure", "quick") in parts(Kind.LOOK, case="testbed_table", steps=[0])


def test_a_simulated_region_comes_coarsely_first():
    steps = [{(each.name, each.stage) for each in answered(Kind.LOOK, step, TRIANGLE, {})} for step in range(3)]
    assert [("region", "quick") in step for step in steps] == [False, True, False]
    assert [("region", "settled") in step for step in steps] == [False, False, True]


def test_a_drawing_is_in_millimetres():
    drawing = parts(Kind.LOOK)["drawing", "settled"]
    assert drawing["hand"]["right_mm"] == [[1000.0, 0.0], [3000.0, 0.0]]
    assert drawing["hand"]["left_mm"] == [[-1000.0, 0.0], [-3000.0, 0.0]]
    assert drawing["object"]["radius_mm"] == parse_case(shipped_text(CASE)).object.radius * 1e3
    assert parse_case(drawing["toml"]) == parse_case(shipped_text(CASE))


def test_a_motion_ends_where_the_command_line_says(palmar):
    found = parts(Kind.SIMULATE, {"start_mm": [20, 110]}, "testbed_table")
    record = palmar("simulate", "testbed_table", "--start", "20,110", "--json").record
    motion = found["motion", "settled"]
    assert found["record", "settled"] == record
    assert motion["poses"][-1][:2] == [1e3 * record["final"]["x_m"], 1e3 * record["final"]["y_m"]]
    assert len(motion["times_s"]) == len(motion["right_mm"]) == len(motion["contacts_mm"])
    assert [each["t_s"] for each in motion["events"]] == [each["t_s"] for each in record["events"]]


def test_painted_starts_are_simulated_starts(palmar, tmp_path: Path):
    box = {"x_mm": [-150.0, 150.0], "y_mm": [60.0, 240.0], "columns": 7, "rows": 5}
    painted = parts(Kind.PAINT, box, "testbed_table")["outcomes", "settled"]
    rows = [f"{x},{y}" for y in painted["y_mm"] for x in painted["x_mm"]]
    starts = tmp_path / "starts.csv"
    starts.write_text("\n".join(["x_mm,y_mm", *rows]) + "\n")
    told = palmar("simulate", "testbed_table", "--starts", starts, "--json").record["results"]
    assert [painted["names"][code] for code in painted["codes"]] == [each["outcome"] for each in told]


def test_a_plan_is_the_command_lines_and_its_belief_shrinks(palmar):
    asked = {"sensors": "full", "uncertainty": {"disk_mm": 100}}
    found = parts(Kind.PLAN, asked)
    told = palmar("plan", CASE, "--sensors", "full", "--uncertainty", "disk:100", "--json").record
    assert found["record", "settled"] == told
    assert found["moments", "settled"]["moments"][-1]["doing"] == "close"


def test_a_plan_closes_straight_whatever_the_behaviour():
    text = shipped_text("testbed_table") + '[behaviour]\nname = "curl_and_close"\n'
    (_, moments) = answered(Kind.PLAN, 0, text, {"uncertainty": {"disk_mm": 5}})
    assert moments.value["moments"][-1]["doing"] == "close"


def test_a_hand_of_the_map_can_be_loaded():
    hand = parts(Kind.MAP_HAND, {"distal": 0.25, "proximal": 0.5}, None)["hand", "settled"]
    assert hand["case"]["hand"]["finger_links_mm"] == [125.0, 62.5]
    assert hand["hold"]["radius_mm"] == pytest.approx(hand["radius_mm"][1], rel=1e-6)


def test_numbers_and_titles_of_the_source(palmar):
    numbers = parts(Kind.EXPERIMENTS, {"numbers": 2})["numbers", "settled"]["numbers"]
    assert [each["source"] for each in numbers] == [[0.226], [0.974], [0.22], [2.054]]
    listed = parts(Kind.EXPERIMENTS)["list", "settled"]["figures"]
    assert {"number": "2.3", "title": "A hold without friction"} in listed


@pytest.mark.parametrize(
    ("what", "ending", "words"),
    [
        ("region", "svg", ["region", "--out"]),
        ("region", "json", ["region", "--out"]),
        ("film", "html", ["simulate", "--animate"]),
    ],
)
def test_an_exported_file_is_the_command_lines(palmar, tmp_path: Path, what, ending, words):
    wish = {"what": what, "format": ending}
    (file,) = answered(Kind.EXPORT, 0, shipped_text(CASE), wish)
    path = tmp_path / file.name
    palmar(words[0], CASE, words[1], path)
    assert file.data == path.read_bytes()


def test_every_file_that_is_offered_can_be_written():
    assert WRITERS.keys() == EXPORTS.keys()


@pytest.mark.parametrize(
    ("kind", "case", "parameters", "words"),
    [
        (Kind.LOOK, {"hand": {"palm_width_mm": -3, "finger_links_mm": [9]}, "object": {}}, {}, "hand.palm_width_mm = -3"),
        (Kind.LOOK, None, {}, "case: is missing"),
        (Kind.LOOK, "[hand", {}, "is not valid TOML"),
        (Kind.SIMULATE, None, {"out": "/tmp/x"}, "parameters.out: unknown"),
        (Kind.PAINT, None, {"columns": 400, "rows": 400}, "columns * rows must be at most"),
        (Kind.PLAN, None, {"uncertainty": {}}, "exactly one of disk_mm and box_mm"),
        (Kind.PLAN, None, {"uncertainty": "/etc/passwd"}, "parameters.uncertainty"),
        (Kind.EXPERIMENTS, None, {"numbers": 99}, "parameters.numbers"),
        (Kind.CASES, None, {"name": "../secret"}, "no shipped case"),
        (Kind.EXPORT, None, {"what": "region", "format": "exe"}, "region is written as svg"),
        (Kind.EXPORT, None, {"what": "figure", "format": "svg", "parameters": {"figure": "9.9"}}, "must be one of 2.1"),
    ],
)  # fmt: skip
def test_bad_input_is_one_clear_line(kind, case, parameters, words):
    case = shipped_text(CASE) if case is None and words != "case: is missing" else case
    with pytest.raises(InputError) as refused:
        list(answered(kind, 0, case, parameters))
    assert words in str(refused.value)
