"""`palmar push` and `palmar identify`: synthetic pushes with known answers, recorded ones where they are."""

import csv
import math

import numpy as np
import pytest

from palmar.mechanics.pushing.push import Pusher, push
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.objects import Disk
from palmar.models.support import Support
from reference.planar_pushes import PUSHER_RADIUS, data_file

HEADS = "x0_m,y0_m,theta0_rad,tip_x0_m,tip_y0_m,tip_x1_m,tip_y1_m"
RADIUS = 0.05
RECORDED = data_file()
HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137]\n"


@pytest.fixture
def disk(tmp_path):
    path = tmp_path / "disk.toml"
    path.write_text(f"{HAND}[object]\nradius_mm = {1e3 * RADIUS}\n[contact]\nfriction = 0.25\n")
    return path


def paths(folder, *rows, heads=HEADS):
    path = folder / "pushes.csv"
    path.write_text("\n".join([heads, *(",".join(map(str, row)) for row in rows)]) + "\n")
    return path


def predicted(palmar, case, path, *words):
    answer = palmar("push", case, "--paths", path, "--pusher-radius-mm", 5, "--json", *words)
    assert (answer.status, answer.err) == (0, "")
    return answer.record


def test_a_push_through_the_centre_moves_the_disk_by_the_pushers_travel(palmar, disk, tmp_path):
    gap, travel = 0.055, 0.03
    rows = []
    for k in range(8):
        c, s = math.cos(0.3 + k), math.sin(0.3 + k)
        rows.append(
            (0.2, -0.1, 0.5, 0.2 - gap * c, -0.1 - gap * s, 0.2 + (travel - gap) * c, -0.1 + (travel - gap) * s)
        )
    record = predicted(palmar, disk, paths(tmp_path, *rows))
    for k, (x, y, theta) in enumerate(record["poses"]):
        assert (x, y) == (
            pytest.approx(0.2 + travel * math.cos(0.3 + k)),
            pytest.approx(-0.1 + travel * math.sin(0.3 + k)),
        )
        assert theta == pytest.approx(0.5, abs=1e-6)
    assert record["outcomes"] == ["pushed"] * 8
    assert record["mean_errors"] is None


def test_a_pusher_that_starts_inside_is_moved_out_and_one_that_misses_moves_nothing(palmar, disk, tmp_path):
    inside = (0.0, 0.0, 0.0, -0.05, 0.0, 0.0, 0.0)
    touching = (0.0, 0.0, 0.0, -0.055, 0.0, 0.0, 0.0)
    beside = (0.0, 0.0, 0.0, -0.2, 0.1, 0.2, 0.1)
    record = predicted(palmar, disk, paths(tmp_path, inside, touching, beside))
    assert record["poses"][0] == pytest.approx(record["poses"][1])
    assert record["poses"][0] == pytest.approx([0.055, 0.0, 0.0], abs=1e-9)
    assert record["poses"][2] == [0.0, 0.0, 0.0]
    assert record["outcomes"] == ["pushed", "pushed", "missed"]


def test_a_polygon_is_pushed_in_its_own_frame(palmar, tmp_path):
    """The same triangle with its frame's origin elsewhere: the same motion of its corners."""
    corners = np.array([(45.0, 45.0), (-80.9, 45.0), (45.0, -80.87)])
    ends = []
    for shift in (np.zeros(2), np.array([10.0, -20.0])):
        case = tmp_path / "tri.toml"
        vertices = (corners - shift).tolist()
        case.write_text(f'{HAND}[object]\nshape = "polygon"\nvertices_mm = {vertices}\n[contact]\nfriction = 0.2\n')
        x, y = 1e-3 * shift
        record = predicted(palmar, case, paths(tmp_path, (x, y, 0.0, 0.03, 0.06, 0.03, 0.02)))
        x, y, theta = record["poses"][0]
        turn = np.array([[math.cos(theta), -math.sin(theta)], [math.sin(theta), math.cos(theta)]])
        ends.append(1e-3 * (corners - shift) @ turn.T + (x, y))
    np.testing.assert_allclose(*ends, atol=1e-7)
    assert abs(theta) > 0.01


def test_the_written_file_holds_the_poses_and_can_be_read_again(palmar, disk, tmp_path):
    rows = [("a,b", 0.0, 0.0, 0.0, -0.06, 0.01, 0.0, 0.01), ("c", 0.1, 0.0, 1.0, 0.03, 0.0, 0.08, 0.01)]
    given = paths(tmp_path, ('"a,b"', *rows[0][1:]), rows[1], heads=f"shape,{HEADS}")
    out = tmp_path / "ends.csv"
    record = predicted(palmar, disk, given, "--out", out)
    with out.open(newline="") as file:
        written = list(csv.DictReader(file))
    assert [each["shape"] for each in written] == ["a,b", "c"]
    ends = [[float(each[name]) for name in ("x1_m", "y1_m", "theta1_rad")] for each in written]
    assert ends == record["poses"]
    again = predicted(palmar, disk, out)
    assert again["mean_errors"] == {"position_m": 0.0, "angle_rad": 0.0}
    assert predicted(palmar, disk, out, "--shape", "c")["poses"] == record["poses"][1:]


def test_the_text_counts_and_states_the_mean_error(palmar, disk, tmp_path):
    row = (0.0, 0.0, 0.0, -0.055, 0.0, -0.045, 0.0, 0.012, 0.0, 0.0)
    path = paths(tmp_path, row, heads=f"{HEADS},x1_m,y1_m,theta1_rad")
    answer = palmar("push", disk, "--paths", path, "--pusher-radius-mm", "5")
    assert answer.status == 0
    assert "2.00 mm, 0.00 deg" in answer.out
    told = answer.out.split()
    assert told[told.index("pushed") + 1] == "1"


def test_no_rows_are_no_poses(palmar, disk, tmp_path):
    record = predicted(palmar, disk, paths(tmp_path))
    assert (record["poses"], record["outcomes"]) == ([], [])
    assert palmar("push", disk, "--paths", paths(tmp_path), "--pusher-radius-mm", "5").status == 0


GOOD = (0.0, 0.0, 0.0, -0.06, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("rows", "heads", "said"),
    [
        ([GOOD, (*GOOD[:6], "x")], HEADS, "line 3, tip_y1_m = 'x'"),
        ([GOOD, GOOD, (*GOOD[:6], "nan")], HEADS, "line 4, tip_y1_m"),
        ([GOOD, GOOD[:6]], HEADS, "line 3 = 6 values"),
        ([(1e9, *GOOD[1:])], HEADS, "line 2, x0_m"),
        ([GOOD], HEADS.replace("x0_m,", "x_m,", 1), "column x0_m"),
        ([(*GOOD, 0.0)], f"{HEADS},x1_m", "column y1_m"),
    ],
)
def test_a_bad_row_is_named_in_one_line(palmar, disk, tmp_path, rows, heads, said):
    answer = palmar("push", disk, "--paths", paths(tmp_path, *rows, heads=heads), "--pusher-radius-mm", "5", "--json")
    assert (answer.status, answer.out, answer.err.count("\n")) == (2, "", 1)
    assert said in answer.err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--pusher-radius-mm", "-5"], "greater than 0"),
        (["--pusher-radius-mm", "0"], "greater than 0"),
        (["--pusher-radius-mm", "big"], "finite number"),
        (["--pusher-radius-mm", "5", "--shape", "hex"], "the file holds"),
        (["--pusher-radius-mm", "5", "--out", "ends.txt"], ".csv"),
        ([], "--pusher-radius-mm"),
    ],
)
def test_bad_options_are_one_line(palmar, disk, tmp_path, words, said):
    answer = palmar("push", disk, "--paths", paths(tmp_path, GOOD), *words)
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert said in answer.err


def test_pushes_need_a_table(palmar, tmp_path):
    answer = palmar("push", "testbed_free", "--paths", paths(tmp_path, GOOD), "--pusher-radius-mm", "5")
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert "table" in answer.err


@pytest.mark.parametrize("offset", [49, 500])
def test_a_centre_of_pressure_that_no_pressure_has_is_refused(palmar, disk, tmp_path, offset):
    disk.write_text(disk.read_text() + f"[support]\npressure_centre_mm = [{offset}, 0]\n")
    answer = palmar("push", disk, "--paths", paths(tmp_path, GOOD), "--pusher-radius-mm", "5")
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert f"support.pressure_centre_mm = [{offset}, 0]: must lie well inside" in answer.err


@pytest.fixture(scope="module")
def synthetic(tmp_path_factory):
    """Sixty pushes of a disk at friction 0.35 under uniform pressure, ends with a little noise."""
    rng = np.random.default_rng(3)
    count, radius = 60, 0.00475
    starts = np.column_stack((rng.uniform(-0.1, 0.1, (count, 2)), rng.uniform(-3.0, 3.0, count)))
    away, aim = rng.uniform(-math.pi, math.pi, count), rng.uniform(-0.7, 0.7, count)
    tip = starts[:, :2] + (RADIUS + radius) * np.column_stack((np.cos(away), np.sin(away)))
    ahead = tip - 0.04 * np.column_stack((np.cos(away + aim), np.sin(away + aim)))
    lines = np.hstack((tip, ahead))
    done = push(slider_of(Disk(radius=RADIUS), Support()), Pusher(radius, 0.35), starts, lines)
    ends = done.poses + rng.normal(0.0, (2e-4, 2e-4, 3e-3), (count, 3))
    path = tmp_path_factory.mktemp("pushes") / "recorded.csv"
    np.savetxt(
        path, np.hstack((starts, lines, ends)), delimiter=",", comments="", header=f"{HEADS},x1_m,y1_m,theta1_rad"
    )
    return path


def test_identification_finds_the_friction_behind_synthetic_pushes(palmar, disk, synthetic):
    answer = palmar("identify", disk, "--pushes", synthetic, "--share", "0.5", "--seed", "1", "--json")
    assert answer.status == 0
    assert "fit on 30 of 60" in answer.err
    record = answer.record
    assert abs(record["friction"] - 0.35) < 4.0 * record["friction_error"] < 0.2
    assert abs(record["length_m"] - 2.0 / 3.0 * RADIUS) < 4.0 * record["length_error_m"]
    assert record["pushes"] == {"fitted": 30, "tested": 30}
    before, after = record["mean_errors"]["before"], record["mean_errors"]["after"]
    assert after["position_m"] < min(before["position_m"], 1e-3)
    assert np.array(record["covariance"]["values"]).shape == (len(record["covariance"]["of"]),) * 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--share", "0"], "between 0 and 1"),
        (["--share", "1.5"], "between 0 and 1"),
        (["--share", "0.05"], "at least 12"),
        (["--share", "0.999"], "leaves none"),
        (["--seed", "-1"], "whole number"),
        (["--seed", "1.5"], "whole number"),
        (["--shape", "hex"], "the file holds: none"),
        (["--pusher-radius-mm", "-1"], "greater than 0"),
    ],
)
def test_identify_refuses_in_one_line(palmar, disk, synthetic, words, said):
    answer = palmar("identify", disk, "--pushes", synthetic, *words, "--json")
    lines = [line for line in answer.err.splitlines() if not line.startswith("palmar: fit on")]
    assert (answer.status, answer.out, len(lines)) == (2, "", 1)
    assert said in lines[0]


def test_identify_needs_recorded_ends_and_one_shape(palmar, disk, tmp_path):
    answer = palmar("identify", disk, "--pushes", paths(tmp_path, *[GOOD] * 60))
    assert answer.status == 2
    assert "recorded ends" in answer.err
    answer = palmar("identify", disk, "--pushes", paths(tmp_path, ("a", *GOOD), ("b", *GOOD), heads=f"shape,{HEADS}"))
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert "must name one of: a, b" in answer.err


def test_pushes_that_show_nothing_are_said_to(palmar, disk, tmp_path):
    heads = f"{HEADS},x1_m,y1_m,theta1_rad"
    missed = paths(tmp_path, *[(0, 0, 0, -1, 1, 1, 1, 0, 0, 0)] * 40, heads=heads)
    answer = palmar("identify", disk, "--pushes", missed, "--share", "0.5")
    assert (answer.status, answer.out) == (2, "")
    assert "show neither friction nor pressure" in answer.err
    straight = [(0, 0, 0, -0.055, 0, -0.001 * k, 0, 0.01, 0, 0) for k in range(10, 50)]
    answer = palmar("identify", disk, "--pushes", paths(tmp_path, *straight, heads=heads), "--share", "0.5")
    assert (answer.status, "which these pushes do not show" in answer.out) == (0, True)


@pytest.mark.skipif(RECORDED is None, reason="the recorded pushes are not here; PALMAR_DATA can name their folder")
def test_recorded_pushes_of_a_square_are_predicted_and_identified(palmar, tmp_path):
    case = tmp_path / "rect1.toml"
    vertices = [[45, 45], [-45, 45], [-45, -45], [45, -45]]
    case.write_text(f'{HAND}[object]\nshape = "polygon"\nvertices_mm = {vertices}\n[contact]\nfriction = 0.2\n')
    radius = 1e3 * PUSHER_RADIUS
    words = ("--shape", "rect1", "--pusher-radius-mm", radius, "--json")
    record = palmar("push", case, "--paths", RECORDED, *words).record
    assert len(record["poses"]) == 314
    assert record["mean_errors"]["position_m"] < 2.7e-3
    found = palmar("identify", case, "--pushes", RECORDED, *words).record
    assert found["mean_errors"]["after"]["position_m"] < 2.51e-3 < 1.1 * found["mean_errors"]["before"]["position_m"]
    assert math.degrees(found["mean_errors"]["after"]["angle_rad"]) < 3.69
