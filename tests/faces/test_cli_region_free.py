"""`palmar region` of free disks: both constructions, their pictures, and their comparison."""

import pytest

NAME = "zero_g_example"


@pytest.mark.parametrize(("model", "area"), [("published", 0.0196), ("corrected", 0.02704)])
def test_the_record_of_the_chapter_4_example(palmar, model, area):
    record = palmar("region", NAME, "--model", model, "--json").record
    assert (record["model"], record["guarantee"], record["closure"]) == (model, "construction", "structural")
    assert record["area_m2"] == pytest.approx(area, abs=1e-5)
    assert record["validity"] == {"quasi_static": None, "toppling": None, "pressure_offset": None, "uncovered": []}
    assert record["allowed_error"]["centre_m"][0] == pytest.approx(0.0, abs=1e-9)


def test_the_text_says_what_matters_in_free_space(palmar):
    text = palmar("region", NAME, "--model", "corrected").out
    assert "at any closing rate" in text
    assert "topples" not in text


def test_every_kind_of_file(palmar, tmp_path):
    for ending in ("svg", "pdf", "png", "dxf", "geojson", "csv", "json"):
        path = tmp_path / f"region.{ending}"
        assert palmar("region", NAME, "--model", "corrected", "--out", path).status == 0
        assert path.stat().st_size > 200


def test_both_constructions_compared(palmar, tmp_path):
    path = tmp_path / "both.svg"
    record = palmar("region", NAME, "--compare", "corrected,published", "--out", path, "--json").record
    assert set(record["regions"]) == {"corrected", "published"}
    wider, narrower = record["differences"]
    assert (wider["promised_by"], narrower["promised_by"]) == ("corrected", "published")
    assert wider["area_m2"] - narrower["area_m2"] == pytest.approx(0.02704 - 0.0196, abs=2e-5)
    assert "caught, but not promised" in path.read_text()
    text = palmar("region", NAME, "--compare", "corrected,published").out
    assert "corrected finds 76.1 cm2 that published does not" in text


def test_three_models_side_by_side(palmar, tmp_path):
    path = tmp_path / "three.svg"
    record = palmar("region", NAME, "--compare", "exact,corrected,published", "--out", path, "--json").record
    assert {each["outcome"] for each in record["differences"]} == {"caged"}
    at_sixty = record["reaches"][4]["distance_m"]
    reaches = [at_sixty[each] for each in ("exact", "corrected", "published")]
    assert reaches == pytest.approx([0.1545, 0.1214, 0.0919], abs=2e-4)
    assert "three models compared" in path.read_text()


def test_velocities_at_a_place(palmar):
    record = palmar("region", NAME, "--velocities", "--at", "0,120", "--json").record
    assert record["velocity"]["radius_m_s"] == pytest.approx(0.0388, abs=2e-4)
    assert "within 38.8 mm/s of rest" in palmar("region", NAME, "--velocities", "--at", "0,120").out


def test_the_questions_that_a_region_answers(palmar):
    options = ("--model", "corrected", "--error", "10,10", "--uncertainty", "disk:20", "--json")
    record = palmar("region", NAME, *options).record
    assert record["capture"]["probability"] > 0.999
    assert record["pre_opening"]["works_as_given"] is True


def test_what_is_not_covered_is_one_line(palmar):
    answer = palmar("region", "testbed_table", "--velocities")
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert "free" in answer.err
    answer = palmar("region", "testbed_table", "--model", "corrected")
    assert answer.status == 2
    assert "table" in answer.err
