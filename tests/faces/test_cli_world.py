"""`--world mujoco`: the same commands and the same JSON; one plain line where MuJoCo is missing or has no such world."""

import sys

import pytest


def mujoco_needed():
    pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")


def test_one_start_in_both_worlds(palmar):
    mujoco_needed()
    planar, other = (
        palmar("simulate", "testbed_table", "--start", "60,120", "--world", world, "--json").record
        for world in ("planar", "mujoco")
    )
    assert planar.keys() == other.keys()
    assert planar["final"].keys() == other["final"].keys()
    assert (other["outcome"], other["caught"]) == (planar["outcome"], True)
    assert other["final"]["y_m"] == pytest.approx(planar["final"]["y_m"], abs=3e-3)
    assert [len(each) for each in other["final"]["finger_rad"]] == [2, 2]
    assert other["events"][-1]["kind"] == "end"
    assert {"touch", "stall"} <= {each["kind"] for each in other["events"]}


def test_many_starts_in_order(palmar, tmp_path):
    mujoco_needed()
    path = tmp_path / "starts.csv"
    path.write_text("x_mm,y_mm\n0,120\n0,20\n0,600\n", encoding="utf-8")
    answer = palmar("simulate", "testbed_table", "--starts", path, "--world", "mujoco", "--json")
    assert [each["outcome"] for each in answer.record["results"]] == ["frictional", "invalid", "missed"]
    assert answer.record["results"][1]["y_m"] == pytest.approx(0.02)


def test_a_free_disk_keeps_its_velocity(palmar):
    mujoco_needed()
    words = ("--start", "0,400", "--velocity", "0,-50", "--world", "mujoco", "--json")
    answer = palmar("simulate", "zero_g_example", *words)
    assert answer.record["outcome"] in ("caged", "escaped")


def test_a_behaviour_in_both_worlds(palmar):
    mujoco_needed()
    words = ("behaviours", "run", "testbed_table", "--behaviour", "scoop", "--sensors", "palm", "--start", "0,100")
    planar, other = (palmar(*words, "--world", world, "--json").record for world in ("planar", "mujoco"))
    assert planar.keys() == other.keys()
    assert (other["outcome"], other["ended"], other["verdict"]) == (
        planar["outcome"],
        planar["ended"],
        planar["verdict"],
    )


@pytest.mark.parametrize("words", [("simulate",), ("behaviours", "run")])
def test_without_mujoco_a_line_says_how_to_get_it(palmar, monkeypatch, words):
    for name in [each for each in sys.modules if each.startswith("palmar.worlds.mujoco")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "mujoco", None)
    answer = palmar(*words, "testbed_table", "--world", "mujoco")
    assert answer.status == 2
    assert answer.out == ""
    assert answer.err.strip().count("\n") == 0
    assert "palmar[mujoco]" in answer.err


def test_what_the_world_lacks_is_said_in_a_line(palmar):
    mujoco_needed()
    answer = palmar("behaviours", "run", "disk_on_a_wall", "--world", "mujoco")
    assert (answer.status, answer.out) == (2, "")
    assert "no wall" in answer.err


def test_films_are_of_the_planar_world(palmar, tmp_path):
    answer = palmar("simulate", "testbed_table", "--world", "mujoco", "--animate", tmp_path / "film.gif")
    assert answer.status == 2
    assert "--animate" in answer.err
