"""`palmar region` and its files."""

import json

import ezdxf
import pytest
import shapely
from ezdxf import units
from shapely.geometry import shape


def area(multipolygon) -> float:
    return sum(shapely.Polygon(rings[0], rings[1:]).area for rings in multipolygon)


def test_the_exact_region_is_the_default(palmar):
    record = palmar("region", "chapter3_example", "--json").record
    assert (record["model"], record["guarantee"], record["frame"]) == ("exact", "closed_form", "hand")
    assert record["area_m2"] == pytest.approx(6.026, rel=1e-3)
    assert 0.0 < record["band_m2"] < 1e-3
    assert area(record["outer"]) == pytest.approx(record["area_m2"] + record["band_m2"], rel=1e-9)
    structural = palmar("region", "chapter3_example", "--closure", "structural", "--json").record
    assert structural["area_m2"] == pytest.approx(5.286, rel=1e-3)


def test_the_published_record_of_the_chapter_3_example(palmar):
    record = palmar("region", "chapter3_example", "--model", "published", "--json").record
    assert (record["model"], record["guarantee"], record["frame"]) == ("published", "construction", "hand")
    assert record["area_m2"] == pytest.approx(6.328, abs=1e-3)
    assert area(record["centre"]) == pytest.approx(record["area_m2"], rel=1e-9)
    assert record["allowed_error"]["radius_m"] == pytest.approx(0.7785, abs=1e-3)
    assert record["allowed_error"]["centre_m"][0] == 0.0
    assert area(record["whole"]) > area(record["contact"]) > area(record["centre"]) * 1.0
    options = ("--model", "published", "--closure", "structural")
    structural = palmar("region", "chapter3_example", *options, "--json").record
    assert structural["area_m2"] == pytest.approx(4.770, abs=1e-3)


def test_seen_from_the_object_the_region_is_reflected(palmar):
    hand = palmar("region", "chapter3_example", "--json").record
    thing = palmar("region", "chapter3_example", "--seen-from", "object", "--json").record
    assert thing["frame"] == "object"
    mine, other = (shapely.MultiPolygon([(p[0], p[1:]) for p in each["centre"]]) for each in (hand, thing))
    assert shapely.affinity.scale(mine, -1.0, -1.0, origin=(0, 0)).symmetric_difference(other).area < 1e-12


@pytest.mark.parametrize("ending", ["svg", "pdf", "png", "dxf", "geojson", "csv", "json"])
def test_every_format_is_written_whole_and_nothing_else(palmar, tmp_path, ending):
    path = tmp_path / f"region.{ending}"
    assert palmar("region", "chapter3_example", "--out", path).status == 0
    assert path.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [path]


def test_geojson_csv_and_json_hold_the_same_region(palmar, tmp_path):
    record = palmar("region", "chapter3_example", "--json").record
    for ending in ("geojson", "csv", "json"):
        palmar("region", "chapter3_example", "--out", tmp_path / f"r.{ending}")
    features = json.loads((tmp_path / "r.geojson").read_text())["features"]
    areas = {each["properties"]["region"]: shape(each["geometry"]).area for each in features}
    assert areas["centre"] == pytest.approx(1e6 * record["area_m2"], rel=1e-6)
    assert all(each["properties"]["unit"] == "mm" for each in features)
    rows = (tmp_path / "r.csv").read_text().splitlines()
    assert rows[0] == "region,polygon,ring,x_mm,y_mm"
    points = [tuple(map(float, row.split(",")[3:])) for row in rows[1:] if row.startswith("centre,")]
    assert shapely.Polygon(points).area == pytest.approx(areas["centre"], rel=1e-9)
    assert json.loads((tmp_path / "r.json").read_text()) == record


def test_dxf_is_in_millimetres_with_named_layers(palmar, tmp_path):
    path = tmp_path / "r.dxf"
    palmar("region", "chapter3_example", "--out", path)
    drawing = ezdxf.readfile(path)
    assert drawing.units == units.MM
    by_layer = {}
    for line in drawing.modelspace().query("LWPOLYLINE"):
        assert line.closed
        by_layer[line.dxf.layer] = shapely.Polygon([(x, y) for x, y, *_ in line.get_points()]).area
    assert set(by_layer) == {"PALMAR_CENTRE", "PALMAR_CONTACT", "PALMAR_WHOLE"}
    assert by_layer["PALMAR_CENTRE"] == pytest.approx(6.026e6, rel=1e-3)
    hand = drawing.modelspace().query('LINE[layer=="PALMAR_HAND"]')
    assert max(line.dxf.end.x for line in hand) == pytest.approx(3000.0)
    assert not drawing.audit().has_errors


def test_a_failed_export_leaves_nothing(palmar, tmp_path, monkeypatch):
    target = tmp_path / "missing" / "r.csv"
    answer = palmar("region", "chapter3_example", "--out", target)
    assert answer.status == 2
    assert "cannot be written" in answer.err
    from pathlib import Path

    kept = tmp_path / "r.csv"
    kept.write_text("old")

    def full(self, text, **_):
        with self.open("w") as file:
            file.write(text[:100])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    answer = palmar("region", "chapter3_example", "--out", kept)
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert "No space left" in answer.err
    assert [each.name for each in tmp_path.iterdir()] == ["r.csv"]
    assert kept.read_text() == "old"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--out", "r.xyz"], "must end in one of"),
        (["--model", "nope"], "published"),
        (["--closure", "nope"], "structural"),
        (["--seen-from", "moon"], "hand"),
    ],
)
def test_bad_options_are_one_line(palmar, words, said):
    answer = palmar("region", "chapter3_example", *words)
    assert answer.status == 2
    assert answer.err.count("\n") == 1
    assert said in answer.err


def test_what_is_not_covered_is_one_line(palmar):
    answer = palmar("region", "testbed_table", "--model", "corrected")
    assert answer.status == 2
    assert answer.err.startswith('palmar: support.kind = "table": the corrected region is for free objects')
    assert answer.err.count("\n") == 1


def test_an_empty_region_is_an_answer(palmar, tmp_path):
    path = tmp_path / "big.toml"
    path.write_text("[hand]\npalm_width_mm = 100\nfinger_links_mm = [100]\n[object]\nradius_mm = 90\n")
    answer = palmar("region", path, "--closure", "structural", "--json")
    assert answer.status == 0
    assert answer.record["centre"] == []
    assert answer.record["allowed_error"] == {"centre_m": None, "radius_m": 0.0}
    assert "too large for a structural hold" in answer.record["reason"]
    assert palmar("region", path, "--closure", "structural", "--check").status == 1
    assert palmar("region", path, "--closure", "structural", "--out", tmp_path / "e.svg").status == 0


def test_two_models_compared(palmar, tmp_path):
    path = tmp_path / "both.svg"
    record = palmar("region", "chapter3_example", "--compare", "exact,published", "--out", path, "--json").record
    assert set(record["regions"]) == {"exact", "published"}
    broken = [each for each in record["differences"] if each["promised_by"] == "published"]
    assert [each["outcome"] for each in broken] == ["escaped"]
    assert "promised, but lost" in path.read_text()
    for words, said in (("exact", "two or three"), ("exact,exact", "two or three"), ("exact,none", "two or three")):
        answer = palmar("region", "chapter3_example", "--compare", words)
        assert (answer.status, answer.err.count("\n")) == (2, 1)
        assert said in answer.err


def test_friction_on_the_command_line(palmar):
    ranged, low = (
        palmar("region", "testbed_table", "--friction", each, "--json").record["area_m2"]
        for each in ("0.2..0.8", "0.2")
    )
    assert ranged == low
    for words in ("0.8..0.2", "-1", "rough"):
        answer = palmar("region", "testbed_table", "--friction", words)
        assert (answer.status, answer.err.count("\n")) == (2, 1)


@pytest.mark.parametrize("words", ["x", "5..2", "0..400", "1..x", "nan"])
def test_odd_orientations_are_one_line(palmar, words):
    answer = palmar("region", "testbed_table", "--theta", words)
    assert (answer.status, answer.err.count("\n")) == (2, 1)


@pytest.mark.parametrize("words", ["0", "-1", "nan", "1e-9", "1e9", "x"])
def test_odd_tolerances_are_one_line(palmar, words):
    answer = palmar("region", "testbed_table", "--tolerance", words)
    assert (answer.status, answer.err.count("\n")) == (2, 1)


def test_a_finer_tolerance_narrows_the_band(palmar):
    coarse, fine = (palmar("region", "testbed_table", "--tolerance", each, "--json").record for each in ("1", "0.01"))
    assert 0.0 < fine["band_m2"] < 0.1 * coarse["band_m2"]
    assert coarse["area_m2"] < fine["area_m2"]
