"""`palmar cell run`: the record that scripts rely on, and one plain line for misuse."""

import pytest

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")


def test_a_floating_cylinder_is_caught(palmar):
    answer = palmar("cell", "run", "floating", "--trials", "1", "--seed", "3", "--json")
    assert (answer.status, answer.err) == (0, "")
    record = answer.record
    assert (record["trials"], record["success"], record["unsafe"], record["failures"]) == (1, 1, 0, {})
    assert (record["eye"], record["eye_note"]) == ("pose", None)
    assert record["results"][0]["trace"][-1][1] == "grip"


def test_a_cylinder_is_caught_by_what_a_camera_sees(palmar):
    answer = palmar("cell", "run", "floating", "--trials", "1", "--seed", "3", "--eye", "camera", "--json")
    record = answer.record
    if record["eye_note"] is not None:
        pytest.skip(record["eye_note"])
    assert (record["eye"], record["success"], record["unsafe"]) == ("camera", 1, 0)


def test_without_a_way_to_render_the_camera_is_replaced_and_that_is_said(palmar, monkeypatch):
    from palmar.worlds.mujoco.cell.renderer import surface

    surface.cache_clear()
    monkeypatch.setenv("MUJOCO_GL", "off")
    answer = palmar("cell", "run", "floating", "--trials", "1", "--seed", "3", "--eye", "camera", "--json")
    surface.cache_clear()
    assert answer.status == 0
    assert answer.record["eye"] == "pose"
    assert "MUJOCO_GL=off" in answer.record["eye_note"]
    assert answer.err == f"palmar: {answer.record['eye_note']}\n"


def test_in_real_time_the_record_tells_how_times_were_kept(palmar):
    pytest.importorskip("zenoh", reason="needs the extra palmar[realtime]")
    words = ("--trials", "1", "--seed", "35", "--fault", "controller-killed", "--real-time", "--json")
    record = palmar("cell", "run", "floating", *words).record
    assert (record["trials"], record["success"], record["unsafe"], record["failures"]) == (1, 0, 0, {"stopped": 1})
    assert (record["real_time"], record["missed_deadlines"], record["late_replies"]) == (True, 1, 1)
    assert 0.0 < record["real_time_factor"] <= 1.0
    for name in ("jitter_s", "reply_s"):
        assert set(record[name]) == {"median", "p95", "p99", "max"}
    assert record["jitter_s"]["median"] <= record["jitter_s"]["p95"] <= record["jitter_s"]["max"]
    assert set(record["sightings"]) == {"received", "stale", "dropped", "malformed"}
    assert record["timings"][0]["at_rest_s"] < 1.0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("table", "--trials", "0"), "--trials = 0: must be 1 to 100000"),
        (("table", "--seed", "-1"), "--seed = -1: must not be negative"),
        (("table", "--error-mm", "-3"), "--error-mm"),
        (("table", "--fault", "gremlins"), "must be one of none, camera-killed"),
        (("table", "--view", "film.gif", "--real-time"), "films trials in lock-step; leave out --real-time"),
        (("table", "--view", "film.avi"), "the name must end in .gif or .mp4"),
        (("table", "--eye", "third"), "third"),
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
