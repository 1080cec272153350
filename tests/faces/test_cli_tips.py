import json
import struct

import numpy as np
import pytest

from palmar.geometry.prism import prism
from palmar.models.three_tips import ThreeTips
from palmar.regions.three_tips import tips_region


def test_region_plan_and_toppling_answer(palmar):
    region = palmar("tips", "region", "--json").record
    assert region["allowed_error"]["radius_m"] == pytest.approx(0.04 / 3**0.5, rel=1e-3)
    assert region["radii"]["three_contacts_from_m"] == pytest.approx(0.01)
    plan = palmar("tips", "plan", "--uncertainty", "disk:30", "--opening", 24, "--trial", 500, "--json").record
    assert plan["guaranteed"] and plan["approaches_max"] == 2 and plan["trial"]["caught"] == 500
    assert palmar("tips", "plan", "--uncertainty", "disk:80", "--approaches-max", 1, "--check").status == 1
    assert palmar("tips", "topple", "--json").record["push_height"]["smooth"] == pytest.approx(0.1)
    assert palmar("tips", "topple", "--tip-height", "90", "--check").status == 1


def test_heights_of_closing_lie_between_the_table_and_toppling(palmar):
    heights = palmar("tips", "region", "--height", "100", "--json").record["heights"]
    assert heights["allowed_m"] == pytest.approx([0.010, 0.030 * (1.0 / 0.3 - 0.5)])
    assert heights["topples_on_landing_from_m"] is None
    low = palmar("tips", "region", "--height", "60", "--json").record["heights"]
    assert low["allowed_m"] == pytest.approx([0.010, 0.050])
    none = palmar("tips", "region", "--height", "150", "--friction", "4", "--json").record["heights"]
    assert none["allowed_m"] is None and "topples" in none["reason"]
    tall = palmar("tips", "region", "--height", "150", "--json").record["heights"]
    assert 0.030 < tall["topples_on_landing_from_m"] < 0.040


@pytest.mark.parametrize(
    "words",
    [
        ("region", "--closed", "90"),
        ("region", "--closed", "5"),
        ("region", "--radius", "nan"),
        ("region", "--out", "x.stl"),
        ("region", "--sweep", "40,50", "--out", "x.stl"),
        ("plan", "--uncertainty", "disk:20", "--opening", "200"),
        ("topple", "--tip-height", "200"),
        ("topple", "--mass", "0"),
    ],
)
def test_bad_input_is_one_line(palmar, words):
    answer = palmar("tips", *words)
    assert answer.status == 2 and len(answer.err.strip().splitlines()) == 1


def test_swept_files_hold_the_volume(palmar, tmp_path):
    for ending in ("stl", "ply", "glb"):
        assert palmar("tips", "region", "--sweep", "100,40", "--out", tmp_path / f"x.{ending}").status == 0
    area = tips_region(ThreeTips(tip_radius=0.01, open_radius=0.08, closed_radius=0.02), 0.03, 0.5).area
    stl = (tmp_path / "x.stl").read_bytes()
    rows = np.frombuffer(stl[84:], dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    assert struct.unpack("<I", stl[80:84])[0] == len(rows)
    a, b, c = rows["corners"].astype(float).transpose(1, 0, 2)
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6e9 == pytest.approx(0.06 * area, rel=1e-5)
    glb = (tmp_path / "x.glb").read_bytes()
    assert struct.unpack("<II", glb[4:12]) == (2, len(glb))
    assert json.loads(glb[20 : 20 + struct.unpack("<I", glb[12:16])[0]])["meshes"]
    assert (tmp_path / "x.ply").read_bytes().startswith(b"ply\n")


def test_a_swept_region_is_closed():
    region = tips_region(ThreeTips(tip_radius=0.01, open_radius=0.08, closed_radius=0.02), 0.03, 0.5)
    mesh = prism(region.centre, -0.01, 0.02)
    edges = np.concatenate([mesh.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    once, counts = np.unique(edges, axis=0, return_counts=True)
    assert (counts == 1).all() and {tuple(each) for each in once} == {tuple(each[::-1]) for each in once}
    assert mesh.volume == pytest.approx(0.03 * region.area)


def test_a_planar_region_is_swept_too(palmar, tmp_path):
    answer = palmar(
        "region", "testbed_table", "--closure", "structural", "--sweep", "300,200", "--out", tmp_path / "x.ply"
    )
    assert answer.status == 0 and "100 mm along the axis" in answer.out and "twice" in answer.out
    assert palmar("region", "testbed_table", "--sweep", "300", "--out", tmp_path / "x.svg").status == 2


def test_what_only_the_palm_feels_and_a_tilted_wrist_leave_is_in_the_record(palmar, tmp_path):
    words = ("region", "testbed_table", "--sweep", "300,50", "--out", tmp_path / "x.stl", "--json")
    whole, palm = palmar(*words).record, palmar(*words, "--palm-only").record
    assert palm["swept"]["area_m2"] < 0.5 * whole["swept"]["area_m2"] == pytest.approx(0.5 * whole["area_m2"])
    xs = [x for polygon in palm["swept"]["centre"] for x, _ in polygon[0]]
    assert (min(xs), max(xs)) == pytest.approx((-0.06, 0.06))
    assert palm["swept"]["volume_m3"] == pytest.approx(0.25 * palm["swept"]["area_m2"], rel=1e-3)
    assert whole["swept"]["twice_as_long"]
    left = [each["estimated_area_m2"] for each in whole["swept"]["tilt"]]
    assert left == sorted(left, reverse=True) and left[0] == pytest.approx(whole["area_m2"])
    assert palmar("region", "testbed_table", "--palm-only").status == 2
