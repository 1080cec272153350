"""How much friction a squeezed polygon needs.

At a squeeze let s = e_R + e_L be the sum of the elevations of the two contact normals. The forces balance, translation
only, if s >= -2 alpha on the palm and |s| <= 2 alpha off it; the limits count as held.
"""

from __future__ import annotations

import numpy as np

from palmar.mechanics.closure.polygon_outline import RIGHT_ANGLE, Bools, Floats
from palmar.mechanics.closure.polygon_squeeze import FLATTEST, Bout, touch

PRESSING = 1e-9
"""Sums of elevations (rad) up to this are a balance, as of two tips on parallel edges, not a hold."""
HEIGHT_ROUNDING = 1e-10
"""A tip this share of the finger length beside a corner counts as touching it, with every normal between its edges."""


def friction_needed(at: Bout, lift: Floats, psi: Floats) -> Floats:
    """Least friction angle (rad) that holds the polygon at each lift (M,), squeezed at psi (M,); inf where it is not."""
    caught = np.isfinite(psi)
    needed = np.full(at.size, np.inf)
    needed[caught] = _needed_at(at.at(caught), psi[caught], lift[caught])
    return needed


def presses_down(at: Bout, psi: Floats) -> Bools:
    """Whether the fingers, squeezing the polygon on the palm at psi, press it down: s > 0, more than a balance."""
    down = np.isfinite(psi)
    here = at.at(down)
    down[down] = elevation_sums(here, psi[down], np.zeros(here.size))[1] > PRESSING
    return down


def _needed_at(at: Bout, psi: Floats, lift: Floats) -> Floats:
    low, high = elevation_sums(at, psi, lift)
    on_palm = np.maximum(0.0, -0.5 * high)
    off_palm = np.where((low <= 0.0) & (high >= 0.0), 0.0, 0.5 * np.minimum(np.abs(low), np.abs(high)))
    from_below = touch(at, np.maximum(psi - 1e-9, FLATTEST), lift).play < -at.room
    needed = np.where(lift <= 0.0, on_palm, off_palm)
    return np.where(from_below | (needed >= RIGHT_ANGLE), np.inf, needed)


def elevation_sums(at: Bout, psi: Floats, lift: Floats) -> tuple[Floats, Floats]:
    """Least and largest sum s (rad) of the contact elevations; they differ where a tip touches a corner."""
    contact = touch(at, psi, lift)
    sides, h = at.sides, at.half_thickness
    angle = np.concatenate([psi, psi])
    tip = at.finger_length * np.sin(angle) - np.concatenate([lift, lift])
    near = HEIGHT_ROUNDING * at.finger_length
    corner_height = sides.corner(sides.support(angle - RIGHT_ANGLE))[1] - h * np.cos(angle)
    beside_tip = corner_height > tip - near
    low = high = contact.elevations.ravel()
    low = np.where(beside_tip, np.minimum(sides.boundary(tip - near, h)[1], low), low)
    high = np.where(
        beside_tip, np.minimum(np.maximum(sides.boundary(tip + near, h)[1], high), angle - RIGHT_ANGLE), high
    )
    return low.reshape(2, -1).sum(axis=0), high.reshape(2, -1).sum(axis=0)
