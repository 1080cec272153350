"""Closing with both joints of each finger: kernels, events, films and the reflexes under feedback tell the same."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from palmar.faces.plots.film import write_film
from palmar.faces.plots.film_scene import scene
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.regions.jointed_closing import Carried
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.studies.simulate import film, simulate_start, simulate_starts
from palmar.studies.simulate_in_world import simulate_start_in
from palmar.worlds.planar.feedback import feedback_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\n"
DISK = "[object]\nradius_mm = 38\n[contact]\nfriction = 0.7\n"
FREE = '[support]\nkind = "free"\n'
CURL = '[behaviour]\nname = "curl_and_close"\npreshape_deg = 20.3\n'
COUPLED = '[behaviour]\nname = "close_coupled"\nratio = 0.5\n'
BACK = '[behaviour]\nname = "close_coupled"\nratio = -1.0\nbend_deg = 41.0\n'
CENTRIFUGAL = '[behaviour]\nname = "curl_and_close"\npreshape_deg = 117\n'
HELD_UP = (
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nopen_deg = 75\n[object]\nradius_mm = 60\n"
    '[contact]\nfriction = 0.7\n[behaviour]\nname = "curl_and_close"\npreshape_deg = 120\n'
)
MOTIONS = {
    "curl": HAND + DISK + CURL,
    "coupled": HAND + DISK + COUPLED,
    "back": HAND + DISK + BACK,
    "free curl": HAND + DISK + FREE + CENTRIFUGAL,
    "free back": HAND + DISK + FREE + BACK,
}


def starts_of(count: int) -> np.ndarray:
    return np.random.default_rng(6).uniform([-0.3, 0.04], [0.3, 0.28], (count, 2))


@pytest.mark.parametrize("name", MOTIONS)
def test_starts_end_as_those_of_the_region_do(name: str) -> None:
    case, starts = parse_case(MOTIONS[name]), starts_of(300)
    if case.support.kind is SupportKind.FREE:
        codes = capture_all(capture_hand_of(case), starts, restitution=1.0, law=impact_law_of(case)).codes
    else:
        codes = Carried(case).outcomes(np.column_stack([starts, np.zeros(len(starts))]))
    ends = simulate_starts(case, starts)
    assert (ends.codes == codes).all()
    assert len(np.unique(codes)) >= 3
    for k in (0, 100, 200):
        told = simulate_start(case, starts[k])
        assert told.outcome.code == codes[k]
        assert told.pose[:2] == pytest.approx(ends.poses[k, :2], abs=2e-5)


@pytest.mark.parametrize("name", ["curl", "coupled", "back", "free back"])
def test_the_reflex_ends_with_the_same_pose_and_joints(name: str) -> None:
    case, start = parse_case(MOTIONS[name]), (0.1, 0.12)
    told = simulate_start(case, start)
    assert told.outcome.caught is (name != "free back")
    last = run_behaviour(case, (*start, 0.0), Circumstances(tick=0.05)).trace.rows[-1]
    if case.support.kind is SupportKind.TABLE:
        assert told.pose == pytest.approx(last.pose, abs=1e-4)
        assert told.right == pytest.approx(last.seen.right, abs=1e-4)
    base, distal = told.left
    does = case.behaviour
    assert distal == pytest.approx(does.preshape if name == "curl" else does.bend + does.ratio * base)


def events_at(case: Case, start: tuple[float, float]) -> list[tuple[float, str, str]]:
    return [(time, each.kind, each.body) for time, each in simulate_start(case, start).events]


def test_events_name_the_link_and_come_when_feedback_feels_them() -> None:
    case = parse_case(MOTIONS["curl"])
    found = events_at(case, (0.2, 0.1))
    felt = simulate_start_in(case, (0.2, 0.1), feedback_world).events
    touched = {body: time for time, kind, body in found if kind == "touch"}
    assert set(touched) == {"right_link_2", "left_link_2"}
    for time, each in felt:
        if each.kind == "touch":
            assert time == pytest.approx(touched[each.body], abs=0.011)
    assert [kind for _, kind, _ in found].count("stall") == 2
    assert found[-1][1:] == ("end", "frictional")
    assert [time for time, _, _ in found] == sorted(time for time, _, _ in found)


def test_what_the_curl_touches_goes_on_touching_while_the_base_joints_close() -> None:
    case = parse_case(MOTIONS["curl"].replace("20.3", "45"))
    found = [
        each for each in events_at(case, (0.23, 0.06)) if each[2] == "right_link_2" and each[1] in ("touch", "leave")
    ]
    assert found[0][1] == "touch" and found[0][0] < 1.5
    assert all(before[1] != after[1] for before, after in pairwise(found))


def test_a_finger_that_its_curl_holds_up_is_followed_by_the_reflex() -> None:
    case, starts = parse_case(HELD_UP), np.array([[0.01, 0.12], [0.0, 0.4]])
    assert Carried(case).outcomes(np.column_stack([starts, [0.0, 0.0]]))[0] == Outcome.UNDECIDED.code
    ends = simulate_starts(case, starts)
    assert [Outcome.from_code(int(code)) for code in ends.codes] == [Outcome.STRUCTURAL, Outcome.MISSED]
    assert ends.poses[0] == pytest.approx((0.0, 0.06, 0.0), abs=1e-5)
    told = simulate_start(case, starts[0])
    shown = film(case, (0.01, 0.12, 0.0), 50)
    assert shown.poses[-1] == pytest.approx(told.pose, abs=1e-9)
    assert shown.fingers[-1] == pytest.approx((*told.right, *told.left), abs=1e-9)


@pytest.mark.parametrize("name", ["curl", "free back"])
def test_films_show_every_joint(name: str, tmp_path) -> None:
    case, start = parse_case(MOTIONS[name]), (0.1, 0.12, 0.0)
    told = simulate_start(case, start)
    shown = scene(case, start, told)
    assert shown.fingers[0] == pytest.approx(case.open_joints * 2)
    assert shown.fingers[-1] == pytest.approx((*told.right, *told.left))
    assert np.abs(np.diff(shown.fingers, axis=0)).max() < 0.2
    assert np.abs(np.diff(shown.poses[:, :2], axis=0)).max() < 0.02
    assert shown.bodies == (0.137, 0.107)
    for pose, points in zip(shown.poses, shown.contacts, strict=True):
        for point in points:
            assert np.hypot(*(pose[:2] - point)) == pytest.approx(0.038, abs=1e-3)
    write_film(tmp_path / "film.html", case, start, told)
    page = (tmp_path / "film.html").read_text(encoding="utf-8")
    assert all(f'id="{side}-{k}"' in page for side in ("right", "left") for k in (0, 1))
