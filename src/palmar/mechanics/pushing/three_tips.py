"""Three round tips at 120 degrees close radially on a disk on a table: which starts do they catch?

With s the radius of the circle of tip centres and rho = R + r_t, the disk's centre is a point among three disks of radius
rho about the tips. Two of these overlap exactly while s < 2 rho / sqrt 3, the *caging radius*. Hence

- before that at most one tip touches the disk at a time, and
- from then on what is between the tips stays there: a start is caught exactly if its centre is between them at that moment.

On one tip the disk is described by beta, the angle from the tip's motion to the contact normal. It grows at

    rho dbeta/dw = g(beta) = sin beta - cos beta tan gamma,       tan gamma = min(tan Gamma(tan beta), mu),

w being the tip's way and Gamma the drag of a contact that sticks (``drag``). Without friction g = sin beta, so that
tan(beta/2) grows as exp(w / rho) and the disk's centre runs along a tractrix. A tip holds a caught disk within 30 degrees of
its motion when it is caged; beyond 90 degrees it has left it behind, and no other tip will ever touch it.
Derived in docs/derivations/three_tips.md.
"""

from __future__ import annotations

from math import acos, atan, cos, exp, hypot, log, pi, sqrt, tan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.drag import lean
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
CAGE = 2.0 / sqrt(3.0)
"""Caging radius over rho."""
WITHIN = pi / 6.0
"""Greatest |beta| (rad) of a disk that is just caged."""
AXES = np.array([[0.0, 1.0], [-0.5 * sqrt(3.0), -0.5], [0.5 * sqrt(3.0), -0.5]])
"""Directions of the tips from the middle (3, 2)."""
NODES, LOWEST = 4096, -12.0
"""Steps of the table of ways in ln tan(beta / 2), and where it begins; before it g is proportional to beta."""


class Drift(NamedTuple):
    """``way``: of a tip until beta = 90 degrees, over rho, at equal steps of u = ln tan(beta/2) from LOWEST to 0."""

    u: Floats
    way: Floats


def drift(drag: Floats | None, friction: float) -> Drift:
    """The table for a contact with this friction; ``drag`` from ``drag.drag_table``, None without friction."""
    u = np.linspace(LOWEST, 0.0, 2 * NODES + 1)
    slowing = np.array([1.0 / _growth(drag, friction, 2.0 * atan(exp(each))) for each in u])
    parts = (u[2] - u[0]) / 6.0 * (slowing[:-1:2] + 4.0 * slowing[1::2] + slowing[2::2])
    return Drift(u[::2], np.concatenate([np.cumsum(parts[::-1])[::-1], [0.0]]))


def _growth(drag: Floats | None, friction: float, beta: float) -> float:
    """g(beta) / sin beta."""
    if drag is None or friction == 0.0:
        return 1.0
    sideways = tan(beta)
    return float(1.0 - lean(drag, friction, sideways) / sideways)


def ways(table: Drift, beta: Floats) -> Floats:
    """Way over rho until the tip has lost the disk, for |beta| in [0, 90 degrees]; inf at 0."""
    with np.errstate(divide="ignore"):
        u = np.log(np.tan(0.5 * beta))
    slope = (table.way[1] - table.way[0]) / (table.u[1] - table.u[0])
    before = table.way[0] + slope * (u - LOWEST)
    found: Floats = np.where(u < LOWEST, before, np.interp(u, table.u, table.way))
    return found


def leans(table: Drift, way: Floats) -> Floats:
    """|beta| (rad) at which so much way over rho is left; above 90 degrees (as 180) where less than none is."""
    slope = (table.way[1] - table.way[0]) / (table.u[1] - table.u[0])
    u = np.where(
        way > table.way[0],
        LOWEST + (way - table.way[0]) / slope,
        np.interp(way, table.way[::-1], table.u[::-1]),
    )
    found: Floats = np.where(way < 0.0, pi, 2.0 * np.arctan(np.exp(u)))
    return found


def first_touches(centres: Floats, rho: float, opened: float) -> tuple[Floats, Floats]:
    """For each tip and centre (N, 3): s at which the tip touches a disk that rests, -inf for never, and |beta| then."""
    along = centres @ AXES.T
    across = np.abs(centres[:, :1] * AXES[:, 1] - centres[:, 1:] * AXES[:, 0])
    touched = across < rho
    ahead = np.sqrt(np.maximum(rho * rho - across * across, 0.0))
    at = np.where(touched & (along + ahead <= opened), along + ahead, -np.inf)
    return at, np.arcsin(np.minimum(across / rho, 1.0))


def ends(radii: tuple[float, float, float, float], friction: float, table: Drift, centres: Floats) -> NDArray[np.int8]:
    """Codes of the outcomes (N,) for centres (N, 2) of disks; ``radii``: of disk, tips, open and closed circle (m).

    STRUCTURAL: three contacts. FRICTIONAL: caged, but two tips have pinched the disk, which stalls them; the third stands on
    the other side. CAGED: between the tips with play. ESCAPED, MISSED, INVALID as their names say.
    """
    radius, tip, opened, closed = radii
    rho = radius + tip
    caging = CAGE * rho
    centres = np.asarray(centres, dtype=float)
    at, beta = first_touches(centres, rho, opened)
    first = np.argmax(at, axis=1)[:, None]
    touch, lean0 = np.take_along_axis(at, first, 1)[:, 0], np.take_along_axis(beta, first, 1)[:, 0]
    overlap = (np.hypot(*(centres[:, None, :] - opened * AXES).transpose(2, 0, 1)) < rho).any(axis=1)
    between = (-centres @ AXES.T).max(axis=1) <= 0.5 * min(caging, opened)
    in_time = touch > caging
    left = ways(table, lean0)
    pushed = leans(table, left - (touch - caging) / rho)
    caught = np.where(in_time, pushed <= WITHIN, between) & (closed < caging)
    stop = max(closed, rho)
    codes = np.where(touch > stop, Outcome.ESCAPED.code, Outcome.MISSED.code).astype(np.int8)
    codes[caught] = Outcome.STRUCTURAL.code if closed <= rho else Outcome.CAGED.code
    codes[caught & _pinched(table, (rho, closed, friction), touch, left)] = Outcome.FRICTIONAL.code
    codes[overlap] = Outcome.INVALID.code
    return codes


def _pinched(table: Drift, of: tuple[float, float, float], touch: Floats, left: Floats) -> NDArray[np.bool_]:
    """Whether a second tip meets a caged disk so nearly opposite to the first that both contacts are wedged.

    Two tips touch at beta = 30 degrees - eta with cos eta = s / caging radius, eta being the angle between normal and
    chord; they wedge the disk if eta < alpha, else they push it out of their chord, to the third.
    """
    rho, closed, friction = of
    if friction == 0.0:
        return np.zeros(len(touch), dtype=np.bool_)
    stop = max(CAGE * rho * cos(atan(friction)), closed, rho)
    if stop >= CAGE * rho:
        return np.zeros(len(touch), dtype=np.bool_)
    lean_then = leans(table, left - (touch - stop) / rho)
    met: NDArray[np.bool_] = (touch > stop) & (lean_then > WITHIN - acos(min(stop / (CAGE * rho), 1.0)))
    return met


def frictionless_area(rho: float, opened: float) -> float:
    """Area (m^2) of the region without friction, closing at least to the caging radius.

    rho^2 (sqrt 3 + pi/2 - 6 beta_o) with tan(beta_o / 2) = tan 15 deg exp(-(opened - caging) / rho): however far the hand
    opens, at most 3.3028 rho^2. Opened less than the caging radius: the room between the three disks.
    """
    caging = CAGE * rho
    if opened <= rho:
        return 0.0
    if opened < caging:
        half = 0.5 * sqrt(3.0) * opened
        lens = rho * rho * acos(half / rho) - half * sqrt(rho * rho - half * half)
        return 0.75 * sqrt(3.0) * opened**2 - 0.5 * pi * rho * rho + 3.0 * lens
    beta = 2.0 * atan(tan(0.5 * WITHIN) * exp(-(opened - caging) / rho))
    return rho * rho * (sqrt(3.0) + 0.5 * pi - 6.0 * beta)


def allowed_error(rho: float, opened: float, closed: float) -> float:
    """Radius (m) of the largest circle in the region, about the middle, for any friction and pressure about the centre."""
    return max(min(opened - rho, rho / sqrt(3.0)), 0.0) if closed < CAGE * rho else 0.0


def held_radii(tip: float, opened: float, closed: float) -> tuple[float, float, float]:
    """Disk radii (m): from the first on it is caged, from the second on three tips touch it, up to the third it fits in."""
    return max(closed / CAGE - tip, 0.0), max(closed - tip, 0.0), max(opened - tip, 0.0)


def lost_way(beta: float) -> float:
    """Way over rho until a frictionless disk touched at beta (rad) has left the tip: ln cot(beta / 2)."""
    return -log(tan(0.5 * beta))


def squeezed_place(rho: float, s: float) -> float:
    """Distance (m) from the middle, away from the third tip, of a disk that two tips touch inside their chord.

    s/2 - sqrt(rho^2 - 3 s^2/4); it falls to 0 at s = rho, where the third tip touches too.
    """
    return 0.5 * s - sqrt(max(rho * rho - 0.75 * s * s, 0.0))


def distance_apart(s: float) -> float:
    """Distance (m) of two tip centres on a circle of radius s."""
    return hypot(1.5 * s, 0.5 * sqrt(3.0) * s)
