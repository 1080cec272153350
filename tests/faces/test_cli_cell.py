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


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("table", "--trials", "0"), "--trials = 0: must be 1 to 100000"),
        (("table", "--seed", "-1"), "--seed = -1: must not be negative"),
        (("table", "--error-mm", "-3"), "--error-mm"),
        (("table", "--fault", "gremlins"), "must be one of none, camera-killed"),
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
