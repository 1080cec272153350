"""`palmar cell run`: the record that scripts rely on, and one plain line for misuse."""

import pytest

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")


def test_a_floating_cylinder_is_caught(palmar):
    answer = palmar("cell", "run", "floating", "--trials", "1", "--seed", "3", "--json")
    assert (answer.status, answer.err) == (0, "")
    record = answer.record
    assert (record["trials"], record["success"], record["unsafe"], record["failures"]) == (1, 1, 0, {})
    assert record["camera"] == "pose"
    assert record["results"][0]["trace"][-1][1] == "grip"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("table", "--trials", "0"), "--trials = 0: must be 1 to 100000"),
        (("table", "--seed", "-1"), "--seed = -1: must not be negative"),
        (("table", "--error-mm", "-3"), "--error-mm"),
        (("table", "--fault", "gremlins"), "must be one of none, camera-killed"),
        (("table", "--view", "film.avi"), "the name must end in .gif or .mp4"),
        (("moon",), "moon"),
    ],
)
def test_misuse_is_one_plain_line(palmar, words, said):
    answer = palmar("cell", "run", *words)
    assert answer.status == 2
    assert said in answer.err
    assert answer.err.count("\n") == 1


def test_a_prediction_and_where_the_arm_serves_are_told(palmar, tmp_path):
    told = palmar("cell", "predict", "floating", "--json").record
    assert told["certain"][0]["approaches"] == 1 and 0.005 < told["certain"][0]["error_m"] < 0.03
    assert told["heights"] is None
    words = ("cell", "workspace", "floating", "--spacing-mm", "20")
    here = palmar(*words, "--json", "--out", tmp_path / "x.stl").record
    assert here["served"] and here["region_share"] == pytest.approx(1.0)
    assert here["area_with_error_m2"] < here["area_m2"]
    assert (tmp_path / "x.stl").stat().st_size > 84
    assert palmar(*words, "--at", "300,0", "--out", tmp_path / "x.svg", "--check").status == 1
    assert (tmp_path / "x.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize(
    "words",
    [
        ("workspace", "table", "--out", "x.dxf"),
        ("workspace", "table", "--at", "3"),
        ("workspace", "table", "--spacing-mm", "0"),
        ("predict", "align"),
    ],
)
def test_misuse_of_the_theory_is_one_plain_line(palmar, words):
    told = palmar("cell", *words)
    assert told.status == 2 and told.err.count("\n") == 1
