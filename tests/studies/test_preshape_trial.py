"""The curl that keeps a disk on a circle: by turning the finger, and where friction has no moment about the contact."""

from __future__ import annotations

from math import cos, degrees, pi, radians, sin

import numpy as np
import pytest
from scipy.optimize import brentq

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.studies.preshape_trial import circling_curl, drift
from palmar.worlds.planar.feedback import feedback_world

PROXIMAL, DISTAL, RADIUS = 0.137, 0.107, 0.038


def bed(thickness_mm: float) -> Case:
    return parse_case(
        f"[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_thickness_mm = {thickness_mm}\n"
        "[object]\nradius_mm = 38\n"
    )


def moment(curl: float, offset: float) -> float:
    """Of uniform friction about the contact in the middle of the distal link, the disk turning about the base joint."""
    r, phi = np.meshgrid(RADIUS * np.sqrt((np.arange(400) + 0.5) / 400), (np.arange(120) + 0.5) * pi / 60)
    foot = np.array([PROXIMAL + 0.5 * DISTAL * cos(curl), 0.5 * DISTAL * sin(curl)])
    inward = np.array([-sin(curl), cos(curl)])
    contact, centre = foot + offset * inward, foot + (offset + RADIUS) * inward
    x, y = centre[0] + r * np.cos(phi), centre[1] + r * np.sin(phi)
    far = np.hypot(x, y)
    return float(np.mean(((x - contact[0]) * x + (y - contact[1]) * y) / far))


@pytest.mark.parametrize(("thickness_mm", "ours"), [(0.0, 20.31), (25.0, 26.00), (50.0, 31.98)])
def test_the_curl_is_where_friction_has_no_moment_about_the_contact(thickness_mm: float, ours: float) -> None:
    """``ours``: the integral by other hands; the source prints 19.5 for lines and 28.5 with its thickness."""
    exact = degrees(brentq(moment, 0.1, 1.0, args=(0.5e-3 * thickness_mm,)))
    assert exact == pytest.approx(ours, abs=0.03)
    assert degrees(circling_curl(bed(thickness_mm), feedback_world)) == pytest.approx(exact, abs=0.06)


def test_less_curl_lets_the_disk_roll_outward() -> None:
    case = bed(0.0)
    assert drift(case, radians(10.0), feedback_world) > 2e-3
    assert drift(case, radians(30.0), feedback_world) < -2e-3


def test_in_mujoco_the_disk_circles_too() -> None:
    pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")
    from palmar.worlds.mujoco.world import mujoco_world

    planar, other = (drift(bed(25.0), radians(26.0), make) for make in (feedback_world, mujoco_world))
    assert other == pytest.approx(planar, abs=1e-4)


def test_only_disks_and_two_links() -> None:
    text = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n"
    with pytest.raises(NotCoveredError, match="two links"):
        drift(parse_case(text), 0.3, feedback_world)
