"""Recorded pushes: the file format, the objects on their supports, and the real data where they are present."""

import numpy as np
import pytest

from palmar.errors import InputError
from palmar.mechanics.pushing.limit_surface import UNIFORM_DISK, UNIFORM_POLYGON
from palmar.mechanics.pushing.push import Pusher, PushOutcome
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.support import Pressure, Support
from palmar.studies.pushes import end_errors, mean_errors, predict, read_pushes
from reference.planar_pushes import OBJECTS, PEER, PUSHER_RADIUS, data_file

HEADER = "shape,x0_m,y0_m,theta0_rad,x1_m,y1_m,theta1_rad,tip_x0_m,tip_y0_m,tip_x1_m,tip_y1_m"
ROW = "disk,0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1.0"
DATA = data_file()
needs_data = pytest.mark.skipif(DATA is None, reason="the recorded pushes are not here (set PALMAR_DATA)")


def written(tmp_path, *lines, encoding="utf-8"):
    path = tmp_path / "pushes.csv"
    path.write_text("\n".join(lines) + "\n", encoding=encoding)
    return path


def test_reading(tmp_path):
    pushes = read_pushes(written(tmp_path, HEADER, ROW, "", ROW.replace("disk", "block")))
    assert len(pushes) == 2 and pushes.shapes == ("disk", "block")
    assert pushes.starts[0] == pytest.approx([0.1, 0.2, 0.3])
    assert pushes.ends is not None and pushes.ends[1] == pytest.approx([0.4, 0.5, 0.6])
    assert pushes.paths[0] == pytest.approx([0.7, 0.8, 0.9, 1.0])
    assert len(pushes.of("block")) == 1


def test_ends_and_names_are_optional_and_columns_may_stand_in_any_order(tmp_path):
    path = written(tmp_path, "tip_x0_m,tip_y0_m,tip_x1_m,tip_y1_m,theta0_rad,y0_m,x0_m,note", "1,2,3,4,5,6,7,hello")
    pushes = read_pushes(written(tmp_path, *path.read_text().splitlines(), encoding="utf-8-sig"))
    assert pushes.ends is None and pushes.shapes == ("",)
    assert pushes.starts[0].tolist() == [7.0, 6.0, 5.0]
    assert len(read_pushes(written(tmp_path, HEADER))) == 0


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ([""], ["is empty", "x0_m"]),
        ([HEADER.replace("theta0_rad", "theta0"), ROW], ["theta0_rad", "is missing"]),
        ([HEADER.replace("theta1_rad", "theta1"), ROW], ["theta1_rad", "is missing"]),
        ([HEADER + ",x0_m", ROW + ",1"], ["x0_m", "twice"]),
        ([HEADER, ROW, ROW + ",1"], ["line 3", "12 values", "must have 11"]),
        ([HEADER, "", ROW.replace("0.5", "five")], ["line 3", "y1_m", "'five'", "must be a number"]),
        ([HEADER, ROW.replace("0.8", "nan")], ["line 2", "tip_y0_m", "'nan'"]),
        ([HEADER, ROW.replace("0.8", "2000")], ["line 2", "tip_y0_m", "between -1000 and 1000"]),
        ([HEADER, ROW.replace("0.3", "")], ["line 2", "theta0_rad", "must be a number"]),
        ([HEADER, '"disk' + ROW], ["line 2", "is not CSV"]),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, lines, words):
    with pytest.raises(InputError) as caught:
        read_pushes(written(tmp_path, *lines))
    assert "pushes.csv" in str(caught.value)
    for word in words:
        assert word in str(caught.value)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_pushes(tmp_path / "none.csv")
    (tmp_path / "odd.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="not text"):
        read_pushes(tmp_path / "odd.csv")


def test_objects_on_their_supports():
    disk, block = OBJECTS["ellip1"], OBJECTS["rect3"]
    assert slider_of(disk, Support()).surface.kind == UNIFORM_DISK
    assert slider_of(block, Support()).surface.kind == UNIFORM_POLYGON
    rim, centre = (slider_of(disk, Support(pressure=each)).surface.length for each in (Pressure.RIM, Pressure.CENTRE))
    assert centre == pytest.approx(0.0525 / 2.0, rel=1e-2) and rim == pytest.approx(0.0525 * 0.75, rel=1e-2)
    shifted = slider_of(block, Support(pressure_centre=(0.004, -0.002)))
    assert shifted.centre == pytest.approx((0.004, -0.002), abs=1e-12)
    assert slider_of(OBJECTS["tri1"], Support()).centre == pytest.approx((0.00303, 0.00304), abs=1e-5)


def test_angles_are_compared_the_short_way_round():
    errors = end_errors(np.array([[0.0, 0.0, 3.1]]), np.array([[3.0, 4.0, -3.1]]))
    assert errors.position == pytest.approx([5.0]) and errors.angle == pytest.approx([2.0 * np.pi - 6.2])


@needs_data
def test_uniform_pressure_and_one_friction_come_within_a_tenth_of_the_fitted_peer():
    pushes, errors = read_pushes(DATA), []
    assert len(pushes) == 1620
    for name, thing in OBJECTS.items():
        some = pushes.of(name)
        done = predict(slider_of(thing, Support()), Pusher(PUSHER_RADIUS, 0.2), some)
        assert PushOutcome.UNDECIDED not in done.outcomes
        errors.append(end_errors(done.poses, some.ends))
    position, angle = mean_errors(errors)
    peer = np.mean(list(PEER.values()), axis=0)
    assert 1e3 * position == pytest.approx(2.955, abs=0.005) and 1e3 * position < 1.1 * peer[0]
    assert np.degrees(angle) == pytest.approx(3.886, abs=0.01) and np.degrees(angle) < 1.1 * peer[1]
