"""How fast an object can move out along the line finger that pushes it, at worst, whatever its orientation.

In the finger's frame, d along it and n its normal, a contact at the distance r_c from the joint moves at r_c n per radian.
One contact: the twist is r_c times a function of the orientation, found at orientations all round; two contacts, an edge
flush on the finger: found at distances all along. With o and s the contact's offset along d and the height of the pressure
centre over the finger, its distance r = r_c - o from the joint grows at s + v_d.
"""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.contact_solve import CONTACT_WIDTH, workspace
from palmar.mechanics.pushing.motion_solve import solve_motion
from palmar.mechanics.pushing.slider import Slider

Floats = NDArray[np.float64]
ORIENTATIONS, DISTANCES = 1440, 129
BESIDE = 1e-6
"""How far (rad) beside a flush edge its two corners are tried alone."""
BESIDE_LEAN = 0.01
"""Added (rad) to the largest lean found, for orientations between those tried."""


class Advance(NamedTuple):
    """Distances r (N,) from 0 to the finger's length (m), bounds (N,) of r' (m per radian) up to each, both rising; and the
    largest angle (rad) from the normal back towards the joint at which the pressure centre moves.
    """

    at: Floats
    growth: Floats
    lean: float


def advance_bound(slider: Slider, friction: float, length: float) -> Advance:
    """The bounds for one object; to what is found the largest change between neighbouring orientations is added."""
    at = np.linspace(0.0, length, DISTANCES)
    corners = slider.core
    edges = np.roll(corners, -1, axis=0) - corners
    flush = np.arctan2(-edges[:, 1], -edges[:, 0]) if len(corners) > 1 else np.empty(0)
    angles = np.linspace(0.0, 2.0 * pi, ORIENTATIONS, endpoint=False)
    tried = np.sort(np.concatenate([angles, flush - BESIDE, flush + BESIDE]) % (2.0 * pi))
    contacts = np.array([_pushed_at(slider, friction, float(angle)) for angle in tried])
    ratio, offset, height, corner, leans = contacts.T
    growth = ratio[:, None] * np.maximum(at + offset[:, None], 0.0) + height[:, None]
    same = corner == np.roll(corner, -1)
    change = np.abs(np.roll(growth, -1, axis=0) - growth)[same]
    worst = growth.max(axis=0) + (change.max(axis=0) if len(change) else 0.0)
    for edge in range(len(corners) if len(corners) > 1 else 0):
        flush_growth, flush_lean = _pushed_flush(slider, friction, edge, at)
        worst, leans = np.maximum(worst, flush_growth), np.append(leans, flush_lean)
    return Advance(at, np.maximum.accumulate(np.maximum(worst, height.max())), float(leans.max()) + BESIDE_LEAN)


def _axes(angle: float) -> tuple[Floats, Floats]:
    """d and n in the object's frame when its frame is turned by ``angle`` against the finger's."""
    return np.array([np.cos(angle), -np.sin(angle)]), np.array([np.sin(angle), np.cos(angle)])


def _pushed_at(slider: Slider, friction: float, angle: float) -> tuple[float, float, float, float, float]:
    """(largest v_d for r_c = 1, offset o (m), height s (m), corner, lean) where the finger touches one corner."""
    along, normal = _axes(angle)
    corner = int(np.argmin(slider.core @ normal))
    point = slider.core[corner] - slider.rounding * normal
    contacts = np.zeros((1, CONTACT_WIDTH))
    contacts[0] = (*point, *normal, *normal, friction)
    fastest, lean = _fastest(slider, contacts, along, normal, 1.0)
    return fastest, float(point @ along), float(-point @ normal), corner, lean


def _pushed_flush(slider: Slider, friction: float, edge: int, at: Floats) -> tuple[Floats, float]:
    """r' at distances ``at`` with an edge flush on the finger, and the largest lean."""
    first, second = slider.core[edge], slider.core[(edge + 1) % len(slider.core)]
    direction = (second - first) / np.hypot(*(second - first))
    along, normal = -direction, np.array([-direction[1], direction[0]])
    bounds, leans = np.empty(len(at)), np.empty(len(at))
    for k, r in enumerate(at):
        contacts = np.zeros((2, CONTACT_WIDTH))
        for row, corner in enumerate((first, second)):
            point = corner - slider.rounding * normal
            speed = max(float(r + point @ along), 0.0)
            contacts[row] = (*point, *normal, *(speed * normal), friction)
        speed = float(np.hypot(contacts[:, 4], contacts[:, 5]).max())
        bounds[k], leans[k] = _fastest(slider, contacts, along, normal, speed)
    return bounds - first @ normal + slider.rounding, float(leans.max())


def _fastest(slider: Slider, contacts: Floats, along: Floats, normal: Floats, speed: float) -> tuple[float, float]:
    """The largest v_d and lean over all admissible motions; the hand's speed, which bounds it, where none is found."""
    space = workspace()
    found = solve_motion(slider.surface, contacts, len(contacts), (0.0, 0.0, 0.0), space)
    if found <= 0:
        return speed, 0.5 * pi
    velocities = space.motions[:found, :2]
    out, up = velocities @ along, velocities @ normal
    return float(out.max()), float(np.arctan2(-out, up).max())
