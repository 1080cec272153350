"""What `palmar region` says beside the region: --error, --uncertainty, --ends, --pressure-offset, validity."""

import json
from math import degrees, pi

import pytest

BLOCK = """
[hand]
palm_width_mm = 120
finger_links_mm = [244]
[object]
shape = "polygon"
vertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]
"""


def test_the_chance_of_a_catch(palmar):
    record = palmar("region", "testbed_table", "--error", "50,40", "--at", "20,120", "--json").record
    capture = record["capture"]
    assert capture["at_m"] == [0.02, 0.12]
    assert 0.9 < capture["probability"] <= capture["probability_at_most"] < capture["best_probability"] < 1.0
    assert capture["loss"] == pytest.approx(1.0 - capture["probability"], abs=1e-12)
    assert capture["best_offset_m"] == pytest.approx([0.02, 0.12 - capture["best_at_m"][1]], abs=1e-6)
    assert capture["guarantee"] == "closed_form"
    assert [each["probability"] for each in capture["tolerances"]] == [0.99, 0.999]
    said = palmar("region", "testbed_table", "--error", "50,40", "--at", "20,120").out
    assert "chance of a catch at (20.0, 120.0) mm" in said
    assert "move the hand by" in said


def test_a_correlated_error_is_another_error(palmar):
    chances = [
        palmar("region", "testbed_table", "--error", "60,60", *more, "--json").record["capture"]["probability"]
        for more in ((), ("--correlation", "-0.9"))
    ]
    assert chances[0] != pytest.approx(chances[1], abs=1e-3)


def test_the_smallest_safe_opening(palmar):
    words = ("region", "testbed_table", "--uncertainty", "disk:30")
    opened = palmar(*words, "--json").record["pre_opening"]
    assert opened["works_as_given"]
    assert degrees(opened["open_rad"]) == pytest.approx(86.1, abs=0.2)
    assert opened["works_rad"] == [[0.0, opened["open_rad"]]]
    assert opened["best"]["open_rad"] > opened["open_rad"]
    assert opened["time_saved_s"] == pytest.approx(degrees(opened["open_rad"]) / 30.0)
    assert opened["most_allowed"]["allowed_error_m"] == pytest.approx(0.1102, abs=2e-4)
    assert "smallest safe opening there" in palmar(*words).out


def test_a_geojson_file_of_errors_is_the_box_it_holds(palmar, tmp_path):
    ring = [[-40, -20], [40, -20], [40, 20], [-40, 20], [-40, -20]]
    shape = {"type": "Polygon", "coordinates": [ring]}
    feature = {"type": "Feature", "properties": {}, "geometry": shape}
    given = {"a": shape, "b": feature, "c": {"type": "FeatureCollection", "features": [feature]}}
    box = palmar("region", "testbed_table", "--uncertainty", "box:80,40", "--json").record["pre_opening"]
    for name, each in given.items():
        path = tmp_path / f"{name}.geojson"
        path.write_text(json.dumps(each))
        assert palmar("region", "testbed_table", "--uncertainty", path, "--json").record["pre_opening"] == box


def test_where_it_ends(palmar):
    record = palmar("region", "testbed_table", "--closure", "structural", "--ends", "--json").record["ends"]
    assert [each["kind"] for each in record["kinds"]] == ["centred"]
    assert record["finger_angles"]["missed_rad"] == pytest.approx(pi)
    assert record["self_centring"] < 1e-9
    said = palmar("region", "testbed_table", "--ends").out
    assert "pinched" in said and "Self-centring" in said and "0.73 mm more radius" in said
    nowhere = palmar("region", "testbed_table", "--ends", "--uncertainty", "disk:1", "--at", "0,2000", "--json")
    assert (nowhere.status, nowhere.record["ends"]) == (0, None)


def test_validity_is_always_beside_the_region(palmar):
    record = palmar("region", "testbed_table", "--json").record["validity"]
    assert record["quasi_static"]["holds"]
    assert record["quasi_static"]["coasting_m"] == pytest.approx(2.77e-3, abs=1e-5)
    assert record["toppling"]["push_height_m"] == pytest.approx(0.119, abs=1e-3)
    assert record["pressure_offset"] is None
    said = palmar("region", "testbed_table").out
    assert "quasi-static" in said and "topples if pushed above" in said


def test_a_pressure_offset_is_answered_or_said_to_be_unknown(palmar):
    record = palmar("region", "testbed_table", "--pressure-offset", "2", "--json").record["validity"]
    assert record["pressure_offset"] is not None or "pressure" in record["uncovered"][0]


def test_a_polygon_without_a_region_is_sampled(palmar, tmp_path, monkeypatch):
    from palmar.studies import capture_sampled

    for name in ("DRAWS", "COARSE"):
        monkeypatch.setattr(capture_sampled, name, 200)
    path = tmp_path / "block.toml"
    path.write_text(BLOCK)
    answer = palmar("region", path, "--error", "5,5,20", "--uncertainty", "disk:5", "--ends", "--json")
    assert answer.status == 0
    record = answer.record
    if record["centre"] is None:
        assert record["capture"]["guarantee"] == "sampled"
        assert record["capture"]["probability_at_least"] < record["capture"]["probability"]
        assert record["pre_opening"] is None
    assert record["ends"]["caught_share"] > 0.9
    said = palmar("region", path, "--error", "1,1,1").out
    assert "100% (" in said and "certain, less" not in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--error", "5"], "SX_MM,SY_MM"),
        (["--error", "0,5"], "0.000001"),
        (["--error", "5,nan"], "finite"),
        (["--error", "5,5,-3"], "angle"),
        (["--error", "5,5", "--correlation", "1"], "below 1"),
        (["--correlation", "0.5"], "needs --error"),
        (["--uncertainty", "disk:-3"], "above 0"),
        (["--uncertainty", "box:3"], "box:W_MM,H_MM"),
        (["--uncertainty", "blob"], "GeoJSON"),
        (["--uncertainty", "none.geojson"], "cannot be read"),
        (["--at", "1"], "X_MM,Y_MM"),
        (["--pressure-offset", "0"], "0.000001"),
        (["--compare", "exact,published", "--ends"], "compares regions alone"),
    ],
)
def test_bad_questions_are_one_line(palmar, words, said):
    answer = palmar("region", "testbed_table", *words)
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert said in answer.err


@pytest.mark.parametrize(
    "text",
    [
        "[1, 2]",
        "not json",
        '{"type": "Point", "coordinates": [1, 2]}',
        '{"type": "Feature", "geometry": null}',
        '{"type": "Polygon", "coordinates": [[[0, 0], [1, "x"], [1, 1], [0, 0]]]}',
        '{"type": "Polygon", "coordinates": [[[0, 0], [10, 10], [10, 0], [0, 10], [0, 0]]]}',
        '{"type": "Polygon", "coordinates": [[[0, 0], [1e12, 0], [0, 1e12], [0, 0]]]}',
    ],
)
def test_a_file_that_holds_no_set_is_one_line(palmar, tmp_path, text):
    path = tmp_path / "errors.geojson"
    path.write_text(text)
    answer = palmar("region", "testbed_table", "--uncertainty", path)
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert str(path) in answer.err
