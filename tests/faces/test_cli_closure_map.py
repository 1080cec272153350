"""`palmar closure` of jointed fingers and `palmar closure map`, as scripts and people see them."""

import math

import pytest

CASES = ["proximal_palm", "distal_palm", "distal_proximal", "distal_proximal_palm", "overall"]


def test_map_at_points(palmar):
    answer = palmar("closure", "map", "--points", "0.25,0.5;0.48,0.25;0,0.5", "--json")
    assert (answer.status, answer.err) == (0, "")
    record = answer.record
    assert (record["distal"], record["proximal"]) == ([0.25, 0.48, 0.0], [0.5, 0.25, 0.5])
    assert list(record["radius_max"]) == list(record["radius_min"]) == CASES
    assert record["radius_max"]["overall"][0] == pytest.approx(0.6035534, abs=1e-7)
    assert record["radius_max"]["distal_proximal"][1] is None
    assert record["radius_max"]["proximal_palm"][2] == pytest.approx(0.5)
    assert "0.6035534" in palmar("closure", "map", "--points", "0.25,0.5").out


def test_where_no_palm_is_left_there_is_no_hand(palmar):
    record = palmar("closure", "map", "--points", "0.5,0.5;0.25,0.5;3,4", "--json").record
    assert record["distal"] == [0.5, 0.25, 3.0]
    assert [each is None for each in record["radius_max"]["overall"]] == [True, False, True]


def test_map_on_a_grid_and_its_picture(palmar, tmp_path):
    path = tmp_path / "map.svg"
    record = palmar("closure", "map", "--grid", "5", "--out", path, "--json").record
    assert len(record["distal"]) == len(record["radius_min"]["distal_palm"]) == 25
    assert record["radius_max"]["overall"].count(None) > 15
    said = path.read_text()
    assert "overall" in said
    assert "R* = 0.6036" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--grid", "0"], "from 2 to 1000"),
        (["--grid", "1001"], "from 2 to 1000"),
        (["--grid", "2.5"], "whole number"),
        (["--points", "-0.1,0.5"], "at least 0"),
        (["--points", "0.5"], "Q,P;Q,P"),
        (["--points", "0.1,0.2;;"], "Q,P;Q,P"),
        (["--points", "nan,0.5"], "finite number"),
        (["--grid", "5", "--points", "0.1,0.2"], "exactly one"),
        (["--grid", "5", "--out", "x.dxf"], "svg, pdf or png"),
        ([], "exactly one"),
    ],
)
def test_bad_input_is_one_line(palmar, words, said):
    answer = palmar("closure", "map", *words)
    assert (answer.status, answer.out, answer.err.count("\n")) == (2, "", 1)
    assert said in answer.err


def case_file(tmp_path, links, radius=38.0, friction=0.7, more=""):
    path = tmp_path / "case.toml"
    path.write_text(
        f"[hand]\npalm_width_mm = 120.0\nfinger_links_mm = {links}\n{more}[object]\nradius_mm = {radius}\n"
        f"[contact]\nfriction = {friction}\n"
    )
    return path


def test_two_links(palmar):
    record = palmar("closure", "testbed_table", "--json").record
    assert record["structural"] == pytest.approx({"radius_min_m": 0.0, "radius_max_m": 0.17748}, abs=1e-6)
    assert record["frictional"]["radius_max_m"] == pytest.approx(0.3068306, abs=1e-7)
    assert record["kept_straight"]["structural"]["radius_max_m"] == pytest.approx(0.06)
    cradle = record["cases"]["distal_proximal"]
    assert cradle["intervals_m"][1] == pytest.approx([0.06, 0.165])
    assert "proximal links and palm" in record["object"]["reason"]


def test_the_reason_names_the_contacts_and_the_distance(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, [137.0, 107.0], 200.0, 0.0), "--json").record
    assert record["frictional"] == record["structural"]
    assert record["object"]["structural"] is False
    assert "too large by 22.5 mm: the largest disk is held by distal links and palm" in record["object"]["reason"]
    assert palmar("closure", case_file(tmp_path, [137.0, 107.0], 400.0, 0.7), "--check").status == 1


def test_more_links_and_thick_ones(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, [60.0, 50.0, 40.0], friction=0.0), "--json").record
    assert record["structural"]["radius_max_m"] == pytest.approx(0.1271, abs=5e-5)
    assert record["largest"]["contacts"]
    thick = case_file(tmp_path, [137.0, 107.0], friction=0.0, more="finger_thickness_mm = 1e-6\n")
    thin = palmar("closure", thick, "--json").record["structural"]["radius_max_m"]
    assert thin == pytest.approx(0.17748005107, abs=1e-8)


def test_fingers_bend_within_joint_limits(palmar, tmp_path):
    limits = "joint_limits_deg = [[0.0, 180.0], [0.0, {}]]\n"
    record = palmar("closure", case_file(tmp_path, [137.0, 107.0], more=limits.format("90.0")), "--json").record
    assert record["structural"]["radius_max_m"] == pytest.approx(0.17748, rel=1e-4)
    assert record["kept_straight"]["structural"]["radius_max_m"] == pytest.approx(0.06)
    assert record["largest"]["right_angles_rad"][1] <= 0.5 * math.pi
    stiff = palmar("closure", case_file(tmp_path, [137.0, 107.0], more=limits.format("0.01")), "--json").record
    assert stiff["structural"]["radius_max_m"] == pytest.approx(0.06, rel=1e-2)


def test_many_links_with_limits_are_kept_straight(palmar, tmp_path):
    limits = f"joint_limits_deg = {[[0.0, 180.0]] + [[0.0, 90.0]] * 3}\n"
    record = palmar("closure", case_file(tmp_path, [87.0, 50.0, 50.0, 57.0], more=limits), "--json").record
    assert record["structural"]["radius_max_m"] == pytest.approx(0.06)
    assert "kept straight" in record["notes"][0]


def test_ranges(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, [137.0, 107.0], '"150..190"'), "--json").record
    assert record["object"]["structural"] is False
    assert record["object"]["frictional"] is True
    assert "at the worst end of the ranges" in record["object"]["reason"]
