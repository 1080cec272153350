"""Loops that motors of limited torque have shut: the bound on the angles, and what soft contacts make of it."""

from __future__ import annotations

from math import acos

import numpy as np
import pytest
import shapely

from palmar.behaviours.close import Closing
from palmar.behaviours.reflex import Drive
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.reopening import widest_gap
from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.worlds.planar.free import free_world
from palmar.worlds.planar.soft import soft_world
from palmar.worlds.run import run


@pytest.mark.parametrize("hand", [(0.06, 0.244, 0.038), (0.03, 0.2, 0.02), (0.06, 0.1, 0.055)])
def test_the_bound_is_above_every_gap_and_not_far(hand: tuple[float, float, float]) -> None:
    """Random angles, distances by another program; the symmetric gap is one of those that count."""
    half_palm, length, size = hand
    bound = widest_gap(*hand)
    psi = np.random.default_rng(1).uniform(0.0, np.pi, (20_000, 2))
    tips = [side * (half_palm + length * np.cos(psi[:, k])) for k, side in ((0, 1.0), (1, -1.0))]
    lines = [
        shapely.linestrings(
            np.stack([[[side * half_palm, 0.0]] * len(psi), np.column_stack([tip, length * np.sin(one)])], axis=1)
        )
        for side, tip, one in zip((1.0, -1.0), tips, psi.T, strict=True)
    ]  # fmt: skip
    gaps = psi.sum(axis=1)[shapely.distance(*lines) >= 2.0 * size]
    assert gaps.max() <= bound
    best = max(gaps.max(), 2.0 * acos((size - half_palm) / length))
    assert best <= bound < best + 0.08


def test_a_loop_that_is_pried_open_is_no_catch() -> None:
    """Two starts before a motor of 0.3 N m that the kernel once called caught when the tips had closed."""
    text = (
        "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nfinger_rate_deg_s = 60\nfinger_mass_kg = 0.4\n"
        "finger_torque_N_m = 0.3\n[object]\nradius_mm = 38\nmass_kg = 0.5\n[contact]\nfriction = 0\nrestitution = 0.6\n"
        'stiffness_N_mm = 100\n[support]\nkind = "free"\n'
    )
    case = parse_case(text, "test")
    starts = np.array([[0.12675655, 0.10016193], [-0.09840259, 0.20689024], [-0.04540043, 0.10760298]])
    rigid = free_world(case)
    codes = capture_all(rigid.hand, starts, np.zeros((3, 2)), 0.6, law=rigid.law).codes
    caught = [Outcome.from_code(int(code)).caught for code in codes]
    assert caught == [False, False, True]
    drive = Drive(1, case.hand.finger_rate)
    soft = [run(soft_world(case, (*start, 0.0), tick=0.05), Closing(drive)).outcome.caught for start in starts]
    assert soft == caught
