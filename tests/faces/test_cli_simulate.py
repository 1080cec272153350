"""`palmar simulate`: one start with its events, many starts from a file, and what is refused."""

import math

import numba
import numpy as np
import pytest

CASE = "chapter3_example"
ANSWERS = {}
"""Records of starts that several tests look at."""


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Single starts gain nothing from threads, and the test workers already share the cores."""
    before = numba.get_num_threads()
    numba.set_num_threads(1)
    yield
    numba.set_num_threads(before)


def starts(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def one(palmar, start, *words):
    if (start, *words) not in ANSWERS:
        answer = palmar("simulate", CASE, "--start", start, "--json", *words)
        assert (answer.status, answer.err) == (0, "")
        ANSWERS[start, *words] = answer.record
    return ANSWERS[start, *words]


def test_the_record_holds_what_the_contract_says(palmar):
    record = one(palmar, "2283.5,500")
    assert set(record) >= {"outcome", "caught", "final", "events"}
    assert set(record["final"]) >= {"x_m", "y_m", "theta_rad", "finger_rad"}
    left, right = record["final"]["finger_rad"]
    assert len(left) == len(right) == 1
    assert all(set(each) >= {"t_s", "kind", "body"} for each in record["events"])


def test_just_inside_is_caught_and_just_outside_escapes(palmar):
    inside, outside = one(palmar, "2283.5,500"), one(palmar, "2284.1,500")
    assert (inside["outcome"], inside["caught"]) == ("frictional", True)
    assert (outside["outcome"], outside["caught"]) == ("escaped", False)
    assert outside["final"]["x_m"] == pytest.approx(0.0, abs=1e-6)
    assert outside["final"]["y_m"] == pytest.approx(2.291, abs=1e-3)


@pytest.mark.parametrize("start", ["2283.5,500", "1500,1200", "2284.1,500"])
def test_a_mirrored_start_gives_the_mirrored_answer(palmar, start):
    here, there = one(palmar, start), one(palmar, f"-{start}")
    assert (here["outcome"], here["caught"]) == (there["outcome"], there["caught"])
    assert there["final"]["x_m"] == pytest.approx(-here["final"]["x_m"], abs=1e-9)
    assert there["final"]["y_m"] == pytest.approx(here["final"]["y_m"], abs=1e-9)
    assert there["final"]["theta_rad"] == pytest.approx(-here["final"]["theta_rad"], abs=1e-9)
    assert there["final"]["finger_rad"] == [pytest.approx(each) for each in here["final"]["finger_rad"][::-1]]
    swap = {"right": "left", "left": "right"}
    mirrored = [
        ("_".join(swap.get(word, word) for word in each["body"].split("_")), each["kind"]) for each in here["events"]
    ]
    assert sorted(mirrored) == sorted((each["body"], each["kind"]) for each in there["events"])


def test_events_are_ordered_in_time_and_end_with_the_outcome(palmar):
    record = one(palmar, "2283.5,500")
    times = [each["t_s"] for each in record["events"]]
    assert times == sorted(times)
    assert 0.0 <= times[0] <= times[-1] <= 6.0
    assert (record["events"][-1]["kind"], record["events"][-1]["body"]) == ("end", record["outcome"])
    psi = max(record["final"]["finger_rad"][0])
    assert times[-1] == pytest.approx(math.degrees(psi) / 30.0)


def test_the_start_angle_is_carried_along(palmar):
    plain, turned = one(palmar, "1500,1200"), one(palmar, "1500,1200,-30")
    assert turned["final"]["theta_rad"] - plain["final"]["theta_rad"] == pytest.approx(math.radians(-30.0))
    assert turned["final"]["x_m"] == plain["final"]["x_m"]


def test_overlap_and_never_touched_are_answers(palmar):
    invalid = one(palmar, "-23,50")
    assert (invalid["outcome"], invalid["caught"], invalid["events"]) == ("invalid", False, [])
    assert (invalid["final"]["x_m"], invalid["final"]["y_m"]) == (pytest.approx(-0.023), pytest.approx(0.05))
    missed = one(palmar, "-900,90000")
    assert missed["outcome"] == "missed"
    assert missed["final"]["y_m"] == pytest.approx(90.0)


def test_exit_status_follows_the_answer_only_when_asked(palmar):
    assert palmar("simulate", CASE, "--start", "2283.5,500", "--check").status == 0
    assert palmar("simulate", CASE, "--start", "2284.1,500").status == 0
    assert palmar("simulate", CASE, "--start", "2284.1,500", "--check").status == 1
    assert palmar("simulate", CASE, "--start=-23,50", "--check").status == 1


def test_the_text_says_where_it_ends_and_lists_the_events(palmar):
    answer = palmar("simulate", CASE, "--start", "2283.5,500")
    assert "frictional: the object ends at (0.00, 2196.62) mm" in answer.out
    assert "leave  right link" in answer.out


def test_without_a_start_the_case_says_where(palmar):
    record = palmar("simulate", "testbed_table", "--json").record
    assert record["caught"]
    assert record["final"]["x_m"] == pytest.approx(0.0, abs=1e-9)
    assert [len(each) for each in record["final"]["finger_rad"]] == [2, 2]


def test_a_file_of_starts_gives_one_result_a_row_in_order(palmar, tmp_path):
    path = starts(tmp_path / "s.csv", "y_mm,x_mm,theta_deg\n500,2283.5,0\n500,2284.1,0\n\n50,-23,5\n500,-2283.5,0\n")
    answer = palmar("simulate", CASE, "--starts", path, "--json")
    results = answer.record["results"]
    assert [each["outcome"] for each in results] == ["frictional", "escaped", "invalid", "frictional"]
    assert [each["caught"] for each in results] == [True, False, False, True]
    for start, each in (("2283.5,500", results[0]), ("2284.1,500", results[1])):
        final = one(palmar, start)["final"]
        assert (each["x_m"], each["y_m"]) == (pytest.approx(final["x_m"]), pytest.approx(final["y_m"]))
    assert palmar("simulate", CASE, "--starts", path, "--check").status == 1
    told = palmar("simulate", CASE, "--starts", path).out.split()
    assert told[told.index("frictional") + 1] == "2"
    assert told[told.index("starts") + 1] == "4"


def test_a_device_that_is_not_there_is_one_line_and_never_the_processors_instead(palmar, tmp_path, monkeypatch):
    monkeypatch.setattr("numba.cuda.is_available", lambda: False)
    path, spec = starts(tmp_path / "s.csv", "x_mm,y_mm\n500,2283.5\n"), tmp_path / "spec.toml"
    spec.write_text('[sweep]\ncase = "testbed_table"\n[vary]\n"start.at_mm.0" = [0.0, 1.0]\n')
    for words in (("simulate", CASE, "--starts", path), ("sweep", spec, "--out", tmp_path / "out")):
        answer = palmar(*words, "--device", "gpu", "--json")
        assert (answer.status, answer.out, answer.err.count("\n")) == (2, "", 1)
        assert 'device "gpu": ' in answer.err
    assert not (tmp_path / "out").exists()


def test_a_device_that_is_there_carries_them(palmar, tmp_path, monkeypatch):
    carried = []
    monkeypatch.setattr("palmar.worlds.planar.on_gpu.refuse_without_gpu", lambda: None)
    monkeypatch.setattr(
        "palmar.worlds.planar.on_gpu.table_ends", lambda world, places: carried.append(places) or world.ends(places)
    )
    path = starts(tmp_path / "s.csv", "x_mm,y_mm\n2283.5,500\n")
    answer = palmar("simulate", CASE, "--starts", path, "--device", "gpu", "--json")
    assert [each["outcome"] for each in answer.record["results"]] == ["frictional"]
    assert np.allclose(carried, [[[2.2835, 0.5]]])


def test_a_file_with_a_heading_only_has_no_results(palmar, tmp_path):
    path = starts(tmp_path / "s.csv", "x_mm,y_mm\n")
    assert palmar("simulate", CASE, "--starts", path, "--json").record == {"results": []}
    assert palmar("simulate", CASE, "--starts", path).status == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1"),
        ("x,y\n1,2\n", "must name x_mm,y_mm"),
        ("x_mm\n1\n", "must name x_mm,y_mm"),
        ("x_mm,y_mm,x_mm\n1,2,3\n", "must name x_mm,y_mm"),
        ("x_mm,y_mm,mass\n1,2,3\n", "theta_deg"),
        ("x_mm,y_mm\n1,900\n2,nan\n", "line 3: y_mm"),
        ("x_mm,y_mm\n1,900\ninf,2\n", "line 3: x_mm"),
        ("x_mm,y_mm\n1,900\n\n1,two\n", "line 4: y_mm = 'two'"),
        ("x_mm,y_mm\n1,900\n1\n", "line 3: has 1 values"),
        ("x_mm,y_mm\n1,900,3\n", "line 2: has 3 values"),
        ("x_mm,y_mm,vx_mm_s\n1,900,0\n1,900,5\n", "velocity"),
    ],
)
def test_a_bad_file_of_starts_is_one_line_that_says_where(palmar, tmp_path, text, said):
    answer = palmar("simulate", CASE, "--starts", starts(tmp_path / "s.csv", text), "--json")
    assert (answer.status, answer.out, answer.err.count("\n")) == (2, "", 1)
    assert said in answer.err


def test_a_file_that_cannot_be_read_is_one_line(palmar, tmp_path):
    (tmp_path / "b.csv").write_bytes(b"x_mm,y_mm\n\xff,1\n")
    for name in ("b.csv", "none.csv", "."):
        answer = palmar("simulate", CASE, "--starts", tmp_path / name)
        assert (answer.status, answer.err.count("\n")) == (2, 1)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--start", "1"], "X_MM,Y_MM[,THETA_DEG]"),
        (["--start", "1,2,3,4"], "X_MM,Y_MM[,THETA_DEG]"),
        (["--start", "a,2"], "must be a finite number"),
        (["--start", "nan,2"], "must be a finite number"),
        (["--start", "1e9,2"], "at most 1000000"),
        (["--start", "0,900", "--velocity", "5"], "VX,VY"),
        (["--start", "0,900", "--velocity", "-5,0"], "quasi-static sliding"),
        (["--start", "0,900", "--starts", "x.csv"], "cannot be combined"),
        (["--world", "moon"], "planar"),
        (["--device", "gpu"], "--device = gpu: is for --starts"),
    ],
)
def test_bad_options_are_one_line(palmar, words, said):
    answer = palmar("simulate", CASE, *words)
    assert (answer.status, answer.out, answer.err.count("\n")) == (2, "", 1)
    assert said in answer.err


def test_no_velocity_is_allowed_on_a_table(palmar):
    assert one(palmar, "2283.5,500", "--velocity", "0,-0")["caught"]


def test_a_free_disk_has_impacts_and_a_velocity(palmar, tmp_path):
    answer = palmar("simulate", "zero_g_example", "--start", "80,150", "--velocity", "0,-10", "--json")
    assert answer.record["outcome"] == "caged"
    assert {"impact", "shut", "end"} == {each["kind"] for each in answer.record["events"]}
    film = tmp_path / "film.html"
    assert palmar("simulate", "zero_g_example", "--start", "80,150", "--animate", str(film)).status == 0
    assert "right link strikes" in film.read_text(encoding="utf-8")


def test_free_starts_come_from_a_file_with_their_velocities(palmar, tmp_path):
    starts = tmp_path / "starts.csv"
    starts.write_text("x_mm,y_mm,vx_mm_s,vy_mm_s\n80,150,0,0\n0,500,0,100\n0,120,0,0\n", encoding="utf-8")
    answer = palmar("simulate", "zero_g_example", "--starts", str(starts), "--json")
    assert [each["outcome"] for each in answer.record["results"]] == ["caged", "missed", "caged"]


def test_a_film_before_a_wall_shows_it(palmar, tmp_path):
    case = tmp_path / "wall.toml"
    case.write_text(
        "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nopen_deg = 75\n[object]\nradius_mm = 38\n"
        "[contact]\nfriction = 0.3\n[support]\nwall_mm = 250\n",
        encoding="utf-8",
    )
    film = tmp_path / "film.html"
    answer = palmar("simulate", str(case), "--start", "30,212", "--animate", str(film), "--json")
    assert answer.record["outcome"] == "frictional"
    assert {"wall", "right_link"} <= {each["body"] for each in answer.record["events"]}
    assert 'class="wall"' in film.read_text(encoding="utf-8")
