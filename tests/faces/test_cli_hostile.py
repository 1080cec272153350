"""Whatever a file holds, every command answers or says one line: never a traceback, never a half-written file."""

import io
import json
import math
import time
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
@settings(max_examples=150, deadline=None, derandomize=True)  # a rare draw takes the region half a minute
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


HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n"
DISK = "[object]\nradius_mm = 38\n"


def polygon(*corners: tuple[float, float]) -> str:
    return "[object]\nshape = 'polygon'\nvertices_mm = [" + ",".join(f"[{x!r},{y!r}]" for x, y in corners) + "]\n"


def simulated(path: Path, text: str, start: str, *words: str) -> tuple[int, str, str]:
    path.write_text(text)
    return call("simulate", path, "--start", start, "--json", *words)


@pytest.mark.parametrize(
    ("text", "start", "said"),
    [
        (HAND.replace("[244]", "[244, 0]") + DISK, "0,120", "finger_links_mm"),
        (HAND.replace("[244]", "[]") + DISK, "0,120", "finger_links_mm"),
        (HAND.replace("[244]", "[-1]") + DISK, "0,120", "finger_links_mm"),
        (HAND + "open_deg = 180\n" + DISK, "0,120", "open_deg"),
        (HAND + "open_deg = -1\n" + DISK, "0,120", "open_deg"),
        (HAND + "joint_limits_deg = [[0, 400]]\n" + DISK, "0,120", "joint_limits_deg"),
        (HAND + DISK + "[start]\ntheta_deg = 1e9\n", "0,120", "theta_deg"),
        (HAND + DISK, "0,120,1e9", "at most 1000000"),
        (HAND + DISK + "[contact]\nfriction = -0.1\n", "0,120", "friction"),
        (HAND + polygon((0, 0), (30, 0), (60, 0)), "0,120", "three corners"),
        (HAND + polygon((0, 0), (30, 0), (0, 0), (30, 0)), "0,120", "vertices_mm"),
        (HAND + polygon(*[(k % 10, 0) for k in range(110_000)]), "0,120", "2000"),
        (HAND + polygon(*[(100 * k, 1000 * k) for k in range(150_000)]), "0,120", "larger than"),
        (HAND + DISK + "[support]\npressure_centre_mm = [37, 0]\n", "0,120", "well inside"),
    ],
)  # fmt: skip
def test_what_cannot_be_simulated_is_one_line(tmp_path, text, start, said):
    status, out, err = simulated(tmp_path / "case.toml", text, start)
    assert (status, out) == (2, "")
    assert err.startswith("palmar: ")
    assert err.count("\n") == 1
    assert said in err
    assert len(err) < 500


def test_repeated_and_straight_points_of_a_polygon_change_nothing(tmp_path):
    plain = polygon((-30, -20), (30, -20), (30, 20), (-30, 20))
    dotted = polygon((-30, -20), (-30, -20), (0, -20), (30, -20), (30, 0), (30, 20), (30, 20), (-30, 20), (-30, -20))
    one, other = (simulated(tmp_path / "case.toml", HAND + each, "60,90,20") for each in (plain, dotted))
    assert one[0] == other[0] == 0
    here, there = json.loads(one[1]), json.loads(other[1])
    assert there["outcome"] == here["outcome"]
    assert there["final"]["x_m"] == pytest.approx(here["final"]["x_m"], abs=1e-7)
    assert there["final"]["theta_rad"] == pytest.approx(here["final"]["theta_rad"], abs=1e-5)


@pytest.mark.parametrize("item", [DISK, polygon((-30, -20), (30, -20), (30, 20), (-30, 20))])
def test_overlap_and_no_friction_are_answered(tmp_path, item):
    status, out, err = simulated(tmp_path / "case.toml", HAND + item, "0,10")
    assert (status, err) == (0, "")
    assert json.loads(out)["outcome"] == "invalid"
    smooth = HAND + item + "[contact]\nfriction = 0\n"
    status, out, err = simulated(tmp_path / "case.toml", smooth, "20,120")
    assert (status, err) == (0, "")
    assert json.loads(out)["outcome"] in {"structural", "caged"}


def test_a_polygon_of_many_corners_is_answered_in_time(tmp_path):
    angles = [2.0 * math.pi * k / 2000 for k in range(2000)]
    text = HAND + polygon(*((round(38.0 * math.cos(a), 6), round(38.0 * math.sin(a), 6)) for a in angles))
    begin = time.perf_counter()
    status, out, err = simulated(tmp_path / "case.toml", text, "100,120")
    assert (status, err) == (0, "")
    assert json.loads(out)["outcome"] in {"structural", "frictional", "undecided"}
    assert time.perf_counter() - begin < 60.0
