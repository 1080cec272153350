"""Films of one closing motion: what they show, and the files they are written to."""

import json
import math
import re
import shutil
import sys

import numba
import numpy as np
import pytest
from PIL import Image
from shapely import LineString, Point, Polygon

from palmar.errors import InputError, OutputError
from palmar.faces.plots.film import known_ending, write_film
from palmar.faces.plots.film_scene import pace_of, scene, ticks
from palmar.faces.plots.hand import finger_points
from palmar.faces.plots.sheet import Extent
from palmar.geometry.polygon import turned
from palmar.models.case_file import parse_case
from palmar.models.shipped import open_case
from palmar.studies.simulate import simulate_start

CAUGHT, LOST = (2.2835, 0.5), (2.2841, 0.5)
QUICK = """
[hand]
palm_width_mm = 120
finger_links_mm = [137, 107]
finger_thickness_mm = 12.5
fingers = "colliding"
open_deg = 30
finger_rate_deg_s = 100
[object]
radius_mm = 38
[contact]
friction = 0
"""


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Single starts gain nothing from threads, and the test workers already share the cores."""
    before = numba.get_num_threads()
    numba.set_num_threads(1)
    yield
    numba.set_num_threads(before)


def filmed(start, theta=0.0, case=None):
    """Case, place and result of one start."""
    case = case or open_case("chapter3_example")[1]
    return case, (*start, theta), simulate_start(case, (*start, theta))


@pytest.fixture(scope="module")
def caught():
    return filmed(CAUGHT, math.radians(10.0))


def data(page):
    return json.loads(re.search(r'<script type="application/json" id="film">(.*?)</script>', page, re.S)[1])


def test_the_scene_runs_from_the_start_to_the_last_event(caught):
    case, start, result = caught
    film = scene(case, start, result)
    assert film.times[0] == 0.0
    assert film.duration == pytest.approx(result.events[-1][0])
    assert np.all(np.diff(film.times) > 0.0)
    np.testing.assert_allclose(film.poses[0], start, atol=1e-9)
    np.testing.assert_allclose(film.poses[-1], result.pose)
    assert [time for time, _ in film.events] == [time for time, _ in result.events]
    assert film.verdict == "Caught: held by friction; it ends at (0.0, 2196.6) mm, turned −16.9°"


def test_contacts_lie_on_the_disk_and_only_between_touch_and_leave(caught):
    film = scene(*caught)
    assert {len(each) for each in film.contacts} == {1, 2}
    for pose, points in zip(film.poses, film.contacts, strict=True):
        for point in points:
            assert math.dist(pose[:2], point) == pytest.approx(0.5, abs=1e-3)
    assert len(film.contacts[-1]) == 2
    missed = scene(*filmed((20.0, 20.0)))
    assert set(map(len, missed.contacts)) == {0}


THICK = """
[hand]
palm_width_mm = 120
finger_links_mm = [137, 107]
finger_thickness_mm = 25
fingers = "colliding"
[object]
shape = "polygon"
vertices_mm = [[0, 0], [60, 0], [60, 40], [10, 50]]
[contact]
friction = 0.5
"""
OFF_CENTRE = """
[hand]
palm_width_mm = 120
finger_links_mm = [244]
[object]
radius_mm = 38
[support]
pressure_centre_mm = [15, 5]
"""


@pytest.mark.parametrize(("text", "start"), [(THICK, (0.1, 0.09, 0.4)), (OFF_CENTRE, (0.12, 0.1, 0.4))])
def test_what_is_carried_in_steps_is_filmed_too(text, start, tmp_path):
    case = parse_case(text)
    result = simulate_start(case, start)
    film = scene(case, start, result)
    assert film.outcome.caught
    np.testing.assert_allclose(film.poses[0], start, atol=1e-9)
    np.testing.assert_allclose(film.poses[-1], result.pose)
    steps = np.abs(np.diff(film.poses, axis=0))
    assert steps[-1].max() <= 2.0 * steps[:-1].max()  # the frames lead to the same end
    assert np.all(np.diff(film.fingers, axis=0) >= 0.0)
    assert len(film.contacts[0]) == 0
    assert len(film.contacts[-1]) >= 2
    write_film(tmp_path / "film.html", case, start, result)
    page = (tmp_path / "film.html").read_text(encoding="utf-8")
    assert page.count('class="contact"') == max(map(len, film.contacts))
    write_film(tmp_path / "film.gif", case, start, result)
    with Image.open(tmp_path / "film.gif") as image:
        assert image.n_frames > 50


def test_contacts_lie_on_the_outline_of_a_polygon_and_on_the_finger():
    case, start = parse_case(THICK), (0.1, 0.09, 0.4)
    film = scene(case, start, simulate_start(case, start))
    for pose, (right, left), points in zip(film.poses, film.fingers, film.contacts, strict=True):
        outline = Polygon(turned(case.object.vertices, pose[2]) + pose[:2]).exterior
        lines = [LineString(finger_points(case.hand, (psi,), left=k == 1)) for k, psi in enumerate((right, left))]
        surfaces = [line.buffer(case.hand.half_thickness, 200).exterior for line in lines]
        palm = LineString([(-0.06, 0.0), (0.06, 0.0)])
        for point in points:
            assert outline.distance(Point(point)) < 5e-4
            assert min(surface.distance(Point(point)) for surface in (*surfaces, palm)) < 5e-4


def test_everything_stays_within_the_extent():
    film = scene(*filmed((-1.9, 1.2)))
    box = film.extent
    assert np.all(film.poses[:, 0] - 0.5 >= box.left)
    assert np.all(film.poses[:, 1] + 0.5 <= box.top)
    assert (box.left, box.right) == (pytest.approx(-3.0), pytest.approx(3.0))


@pytest.mark.parametrize(("rate", "pace"), [(15.0, 1.0), (1.0, 10.0), (3000.0, 0.005)])
def test_the_pace_suits_the_eye(rate, pace):
    case = parse_case(QUICK.replace("= 100", f"= {rate}"))
    film = scene(*filmed((0.0, 0.12), case=case))
    assert film.pace == pytest.approx(pace)
    assert 3.0 <= film.duration / film.pace <= 10.0


@pytest.mark.parametrize("duration", [0.0, 1e-320, 1e300, float("inf")])
def test_any_duration_has_a_pace(duration):
    assert 0.0 < pace_of(duration) < float("inf")


def test_ticks_are_round_millimetres():
    assert ticks(-0.03, 0.021, Extent(-0.1, 0.0, 0.1, 0.05)) == [-20.0, 0.0, 20.0]
    assert ticks(0.0, 1e-6, Extent(0.0, 0.0, 1e-6, 1e-6)) == pytest.approx([1e-4 * k for k in range(11)])


def test_a_gif_moves_in_even_steps_and_ends_with_a_rest(tmp_path):
    path = tmp_path / "film.GIF"
    write_film(path, *filmed((0.01, 0.12), case=parse_case(QUICK)))
    assert list(tmp_path.iterdir()) == [path]
    assert path.stat().st_size < 2_000_000
    with Image.open(path) as image:
        times, pictures = [], []
        for k in range(image.n_frames):
            image.seek(k)
            times.append(image.info["duration"])
            pictures.append(np.asarray(image.convert("RGB"), dtype=int))
    assert 20 < len(pictures) <= 201
    assert set(times[:-1]) == {50}
    assert times[-1] == 1500
    assert pictures[0].shape[0] % 2 == pictures[0].shape[1] % 2 == 0
    assert tuple(pictures[0][1, 1]) == (255, 255, 255)
    assert np.abs(pictures[0] - pictures[-1]).max() > 100


def test_the_page_holds_the_same_motion(tmp_path, caught):
    path = tmp_path / "film.html"
    write_film(path, *caught)
    page, result = path.read_text(encoding="utf-8"), caught[2]
    held = data(page)
    assert len(held["times"]) == len(held["poses"]) == len(held["fingers"]) == len(held["contacts"])
    assert held["times"][-1] == pytest.approx(result.events[-1][0])
    x, y, theta = result.pose
    np.testing.assert_allclose(held["poses"][-1], (1e3 * x, 1e3 * y, math.degrees(theta)), rtol=1e-5)
    np.testing.assert_allclose(held["fingers"][-1], np.degrees((result.right[0], result.left[0])), rtol=1e-5)
    assert page.count("data-time=") == len(result.events)
    assert "right tip touches" in page
    assert list(tmp_path.iterdir()) == [path]


def test_the_page_asks_nothing_of_the_network(tmp_path, caught):
    path = tmp_path / "film.html"
    write_film(path, *caught)
    page = path.read_text(encoding="utf-8")
    assert "default-src 'none'" in page
    assert re.findall(r"(?:https?:)?//[a-z]", page.replace("// ", "")) == []
    assert re.findall(r"\b(?:src|href)=|@import|url\(|fetch\(|\$[a-z]", page) == []


def test_an_invalid_start_is_one_still_picture(tmp_path):
    given = filmed((0.1, 0.1))
    write_film(tmp_path / "film.html", *given)
    page = (tmp_path / "film.html").read_text(encoding="utf-8")
    assert "No start: it overlaps the open hand." in page
    assert data(page)["times"] == [0.0]
    write_film(tmp_path / "film.gif", *given)
    with Image.open(tmp_path / "film.gif") as image:
        assert image.n_frames == 1


def test_mp4_goes_through_ffmpeg_where_there_is_one(tmp_path, monkeypatch):
    given, program = filmed((0.01, 0.12), case=parse_case(QUICK)), tmp_path / "bin" / "ffmpeg"
    program.parent.mkdir()
    monkeypatch.setenv("PATH", str(program.parent))
    assert shutil.which("ffmpeg") is None
    with pytest.raises(OutputError, match="needs the program ffmpeg"):
        write_film(tmp_path / "film.mp4", *given)
    program.write_text(
        f"#!{sys.executable}\nimport sys\ndata = sys.stdin.buffer.read()\n"
        "open(sys.argv[-1], 'w').write(f'{len(data)} {\" \".join(sys.argv)}')\n"
    )
    program.chmod(0o755)
    write_film(tmp_path / "film.mp4", *given)
    size, words = (tmp_path / "film.mp4").read_text().split(" ", 1)
    width, height = map(int, re.search(r"-s (\d+)x(\d+)", words).groups())
    assert width % 2 == height % 2 == 0
    assert int(size) % (3 * width * height) == 0
    assert int(size) // (3 * width * height) > 50
    assert "-f mp4" in words
    program.write_text(f"#!{sys.executable}\nimport sys\nsys.exit('no codec')\n")
    with pytest.raises(OutputError, match="ffmpeg cannot make the film: no codec"):
        write_film(tmp_path / "other.mp4", *given)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["bin", "film.mp4"]


@pytest.mark.parametrize("name", ["film.avi", "film", "film.svg"])
def test_other_endings_are_refused(name, tmp_path):
    with pytest.raises(InputError, match=r"--animate.*must end in one of \.gif, \.mp4, \.html"):
        known_ending(tmp_path / name)


def test_a_film_that_cannot_be_written_leaves_nothing(tmp_path, caught):
    with pytest.raises(OutputError, match="cannot be written"):
        write_film(tmp_path / "nowhere" / "film.html", *caught)
    assert list(tmp_path.iterdir()) == []


def test_the_command_writes_the_film(palmar, tmp_path):
    path = tmp_path / "film.html"
    answer = palmar("simulate", "chapter3_example", "--start", "2284.1,500", "--animate", path, "--json")
    assert (answer.status, answer.record["outcome"]) == (0, "escaped")
    assert "Not caught: touched, then left" in path.read_text(encoding="utf-8")
    answer = palmar("simulate", "chapter3_example", "--start", "2284.1,500", "--animate", "film.avi")
    assert (answer.status, answer.err.count("\n")) == (2, 1)
