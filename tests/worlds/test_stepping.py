"""Polygons and thick fingers carried in steps: frames, symmetry, agreement with the event-to-event kernel."""

import numpy as np
import pytest

from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.studies.simulate import simulate_start, simulate_starts
from palmar.worlds.planar.stepping import stepping_world
from palmar.worlds.planar.table import covered, table_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n"
BOX = 'shape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
DISK = parse_case(f"{HAND}[object]\nradius_mm = 38\n[contact]\nfriction = 0.7\n")


def test_both_kernels_agree_on_disks():
    rng = np.random.default_rng(2)
    starts = np.column_stack([rng.uniform(0.0, 0.29, 40), rng.uniform(0.04, 0.25, 40)])
    fast = table_world(DISK).ends(starts)
    slow = stepping_world(DISK).ends(np.column_stack([starts, np.zeros(40)]))
    assert np.array_equal(fast.codes, slow.codes)
    held = np.isin(fast.codes, [Outcome.STRUCTURAL.code, Outcome.FRICTIONAL.code])
    assert held.sum() > 10
    assert slow.poses[held, :2] == pytest.approx(fast.poses[held, :2], abs=1e-5)


def test_a_polygon_given_in_another_frame_ends_in_the_same_place():
    here = parse_case(f"{HAND}[object]\n{BOX}")
    moved = BOX.replace("-30,", "-10,").replace("[30,", "[50,").replace("[-30", "[-10")
    there = parse_case(f"{HAND}[object]\n{moved}")
    assert not covered(here)
    start, theta = np.array([0.05, 0.12]), 0.3
    shift = 0.02 * np.array([np.cos(theta), np.sin(theta)])
    one, other = simulate_start(here, [*start, theta]), simulate_start(there, [*(start - shift), theta])
    assert one.outcome is other.outcome
    end_shift = 0.02 * np.array([np.cos(other.pose[2]), np.sin(other.pose[2])])
    assert np.array(other.pose[:2]) + end_shift == pytest.approx(np.array(one.pose[:2]), abs=1e-5)


def test_thick_colliding_fingers_hold_the_test_beds_disk():
    thick = HAND.replace("[244]\n", '[244]\nfinger_thickness_mm = 25\nfingers = "colliding"\n')
    case = parse_case(f"{thick}[object]\nradius_mm = 38\n[contact]\nfriction = 0.7\n")
    ends = simulate_starts(case, [[0.0, 0.1], [0.1, 0.08], [0.0, 0.02], [0.6, 0.6]])
    outcomes = [Outcome.from_code(int(code)) for code in ends.codes]
    assert outcomes[0].caught
    assert outcomes[1].caught
    assert outcomes[2:] == [Outcome.INVALID, Outcome.MISSED]


def test_events_are_in_order_and_end_with_the_outcome():
    result = simulate_start(parse_case(f"{HAND}[object]\n{BOX}"), [0.1, 0.1, 0.2])
    times = [time for time, _ in result.events]
    assert times == sorted(times)
    assert (result.events[-1][1].kind, result.events[-1][1].body) == ("end", result.outcome.value)
