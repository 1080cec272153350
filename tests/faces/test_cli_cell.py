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
