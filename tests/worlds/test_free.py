"""Closing on free disks: ends as the kernel's, events in order, ways that the film shows, and what is refused."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.studies.simulate import film, simulate_start, simulate_starts
from palmar.worlds.planar.free import free_world

CASE = open_case("zero_g_example")[1]
ROUGH = parse_case(
    "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_thickness_mm = 20\n[object]\nradius_mm = 38\n"
    "[contact]\nfriction = 0.4\nrestitution = 0.5\n[support]\nkind = 'free'\n",
    "rough",
)


@pytest.mark.parametrize("case", [CASE, ROUGH], ids=["elastic", "rough"])
def test_one_start_ends_as_in_the_batch(case: Case) -> None:
    starts = np.random.default_rng(5).uniform([-0.2, 0.06, 0.0, -0.02, -0.05], [0.2, 0.3, 0.0, 0.02, 0.02], (40, 5))
    ends = simulate_starts(case, starts)
    for start, code, pose in zip(starts, ends.codes, ends.poses, strict=True):
        one = simulate_start(case, start)
        assert one.outcome is Outcome.from_code(int(code))
        if one.outcome.caught:
            assert one.pose[:2] == pytest.approx(pose[:2], abs=1e-12)
    assert {Outcome.from_code(int(each)) for each in ends.codes} >= {Outcome.CAGED, Outcome.ESCAPED}


def test_events_come_in_order_and_the_disk_flies_straight_between_them() -> None:
    done = simulate_start(CASE, (0.08, 0.15))
    times = [time for time, _ in done.events]
    assert times == sorted(times)
    assert [each.kind for _, each in done.events][-2:] == ["shut", "end"]
    assert done.events[0][1].body == "right_link"
    shown = film(CASE, (0.08, 0.15, 0.0), 400)
    first = done.events[0][0]
    at = (shown.psi - CASE.hand.open) / CASE.hand.finger_rate
    assert np.ptp(shown.poses[at < first, :2], axis=0).max() == 0.0
    for begin, end in pairwise(times[:-2]):
        part = shown.poses[(at > begin) & (at < end), :2]
        if len(part) > 2:
            assert np.abs(np.diff(part, n=2, axis=0)).max() < 1e-12
    assert shown.poses[-1, :2] == pytest.approx(done.pose[:2], abs=1e-9)
    assert shown.fingers[-1].max() <= np.pi


def test_with_friction_the_disk_is_turned_by_as_much_in_the_film_as_at_the_end() -> None:
    start = (0.1, 0.1, 0.3, 0.0, 0.0)
    done, shown = simulate_start(ROUGH, start), film(ROUGH, start, 600)
    assert done.outcome.caught
    assert abs(done.pose[2] - 0.3) > 0.01
    assert shown.poses[-1, 2] == pytest.approx(done.pose[2], abs=0.02)


def test_a_disk_that_flies_past_is_missed_and_followed_until_the_fingers_end() -> None:
    done = simulate_start(CASE, (0.0, 0.6, 0.0, 0.0, 0.1))
    assert done.outcome is Outcome.MISSED
    closing = np.pi / CASE.hand.finger_rate
    assert done.events[-1][0] == pytest.approx(closing, rel=1e-6)
    assert done.pose[1] == pytest.approx(0.6 + 0.1 * closing, rel=1e-6)


def test_a_start_that_overlaps_is_invalid() -> None:
    assert simulate_start(CASE, (0.0, 0.03)).outcome is Outcome.INVALID


def test_the_velocity_of_the_case_is_that_of_a_start_without_one() -> None:
    moving = CASE.model_copy(update={"start": CASE.start.model_copy(update={"velocity": (0.01, -0.03)})})
    assert simulate_start(moving, (0.05, 0.2)).pose == simulate_start(CASE, (0.05, 0.2, 0.0, 0.01, -0.03)).pose


def test_polygons_tables_and_ranges_are_refused() -> None:
    with pytest.raises(NotCoveredError, match="table"):
        free_world(open_case("testbed_table")[1])
    text = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nshape = 'polygon'\n"
    text += "vertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n[support]\nkind = 'free'\n"
    with pytest.raises(NotCoveredError, match="only disks"):
        simulate_start(parse_case(text, "x"), (0.0, 0.1))
