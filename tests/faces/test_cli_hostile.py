"""Whatever a file holds, every command answers or says one line: never a traceback, never a half-written file."""

import io
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.faces.cli.main import run

numbers = st.one_of(
    st.floats(1e-6, 1e6).map(repr), st.floats().map(repr), st.integers(-(10**30), 10**30).map(str),
    st.sampled_from(["0", "-0.0", "1e-320", "1e308", '"1..2"', '"0..1e6"', "true", '"x"', "[]", "[1]", "{}", "1979-05-27"]),
)  # fmt: skip


def call(*words: object) -> tuple[int, str, str]:
    out, err, status = io.StringIO(), io.StringIO(), 0
    with redirect_stdout(out), redirect_stderr(err):
        try:
            run([str(word) for word in words])
        except SystemExit as leave:
            status = int(leave.code or 0)
    return status, out.getvalue(), err.getvalue()


@given(numbers, numbers, numbers, numbers, numbers)
@settings(max_examples=150, deadline=None)
@pytest.mark.parametrize("command", ["closure", "region"])
def test_any_numbers_give_an_answer_or_one_line(tmp_path_factory, command, palm, finger, thickness, radius, friction):
    path = tmp_path_factory.mktemp("hostile") / "case.toml"
    path.write_text(
        f"[hand]\npalm_width_mm = {palm}\nfinger_links_mm = [{finger}]\nfinger_thickness_mm = {thickness}\n"
        f"[object]\nradius_mm = {radius}\n[contact]\nfriction = {friction}\n"
    )
    status, out, err = call(command, path, "--json")
    assert status in (0, 2)
    if status == 2:
        assert out == ""
        assert err.startswith("palmar: ")
        assert err.count("\n") == 1
    else:
        assert err == ""
        assert "NaN" not in out
        assert "Infinity" not in out


@pytest.mark.parametrize("command", ["closure", "region", "simulate", "report"])
@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "[hand]"),
        (b"\xff\xfe", "UTF-8"),
        (b"[hand", "TOML"),
        (b"[hand]\npalm_width_mm = 1\nfinger_links_mm = [1]\n[object]\nshape = 'polygon'\n"
         b"vertices_mm = [[0,0],[4,0],[1,1],[0,4]]\n", "convex"),
    ],
)  # fmt: skip
def test_wrong_files_name_the_file(tmp_path, command, content, said):
    path = tmp_path / "case.toml"
    path.write_bytes(content)
    extra = ["--out", tmp_path / "out"] if command == "report" else []
    status, out, err = call(command, path, *extra)
    assert (status, out) == (2, "")
    assert str(path) in err.replace("\n", "")
    assert said in err
    assert not (tmp_path / "out").exists()


def test_a_huge_file_is_refused_at_once(tmp_path):
    path = tmp_path / "huge.toml"
    with path.open("wb") as file:
        file.truncate(1_000_000_000)
    assert call("closure", path)[0] == 2
    assert call("closure", Path("/dev/zero"))[0] == 2
