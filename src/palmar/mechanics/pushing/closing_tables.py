"""What a disk does on a closing fingertip, or between a closing finger and the palm, as functions of one number.

Seen from the turning finger, a disk on the fingertip is described by one angle: beta, from the finger's pushing normal
n to the contact normal m (towards the disk's centre). Quasi-static motion has no memory, so beta' is a function of beta
alone, for any friction; one table a hand serves every start. Likewise a disk kept on the palm by a finger has its place
given by psi, and only its spin depends on friction: one table over psi. Without friction the tip obeys
beta' = 1 + (L / rho) sin beta (docs/derivations/tip_phase.md), which the table must reproduce.
"""

from __future__ import annotations

from math import asin, atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.contact_solve import CONTACT_WIDTH, Workspace, workspace
from palmar.mechanics.pushing.limit_surface import LimitSurface
from palmar.mechanics.pushing.motion_solve import solve_motion

Floats = NDArray[np.float64]
TIP_NODES, PALM_NODES, PALM_SAMPLES = 2049, 257, 64


class ClosingHand(NamedTuple):
    """Half palm D, finger length L, half thickness h, disk radius R (m), friction, first and last base angle (rad)."""

    half_palm: float
    length: float
    half_thickness: float
    radius: float
    friction: float
    first: float
    last: float


class Tables(NamedTuple):
    """``turn`` and ``spin``: psi and the disk's angle since beta = 0, at equal steps of beta up to 90 degrees.

    ``rate`` is dbeta/dpsi there; ``path_x``, ``path_y`` the disk's centre from the base joint if psi is 0 at beta = 0:
    any other tip phase is this path turned about the joint. ``palm_spin`` (2, N): the disk's angle at equal steps of psi
    over the two ranges ``palm_range`` (2, 2) in which the link, and the tip, move it along the palm.
    """

    turn: Floats
    spin: Floats
    rate: Floats
    path_x: Floats
    path_y: Floats
    palm_spin: Floats
    palm_range: Floats


@compiled
def tip_rates(
    hand: ClosingHand, surface: LimitSurface, beta: float, space: Workspace, contact: Floats
) -> tuple[float, float]:
    """(beta', theta') per radian of the finger, for the finger along x: n = (0, 1)."""
    rho = hand.radius + hand.half_thickness
    mx, my = sin(beta), cos(beta)
    px, py = -my, mx
    contact[0, 0], contact[0, 1] = -hand.radius * mx, -hand.radius * my
    contact[0, 2], contact[0, 3] = mx, my
    contact[0, 4], contact[0, 5] = hand.half_thickness * px, hand.length + hand.half_thickness * py
    contact[0, 6] = hand.friction
    push = hand.length * my
    found = solve_motion(surface, contact, 1, (push * mx, push * my, 0.0), space)
    if found <= 0:
        return np.nan, np.nan
    vx, vy, omega = space.motions[0, 0], space.motions[0, 1], space.motions[0, 2]
    return 1.0 - (vx * px + (vy - hand.length) * py) / rho, omega


@compiled
def palm_spin_rate(hand: ClosingHand, surface: LimitSurface, psi: float, space: Workspace, contacts: Floats) -> float:
    """theta' per radian of a finger that keeps the disk on the palm; NaN where they wedge it or cannot hold it there."""
    d, length, h, radius = hand.half_palm, hand.length, hand.half_thickness, hand.radius
    rho = radius + h
    foot = (radius - rho * cos(psi)) / sin(psi)
    nx, ny, reach = -sin(psi), cos(psi), foot
    if foot > length:
        rise = (length * sin(psi) - radius) / rho
        if abs(rise) >= 1.0:
            return np.nan
        nx, ny, reach = -sqrt(1.0 - rise * rise), -rise, length
    tip_x, tip_y = -reach * sin(psi) - h * ny, reach * cos(psi) + h * nx
    contacts[0, :] = np.array([0.0, -radius, 0.0, 1.0, 0.0, 0.0, hand.friction])
    contacts[1, :] = np.array([-radius * nx, -radius * ny, nx, ny, tip_x, tip_y, hand.friction])
    slide = (nx * tip_x + ny * tip_y) / nx
    found = solve_motion(surface, contacts, 2, (slide, 0.0, 0.0), space)
    if found <= 0 or abs(space.motions[0, 1]) > 1e-6 * (hypot(tip_x, tip_y) + d):
        return np.nan
    return space.motions[0, 2]


@compiled
def _fill_tip(hand: ClosingHand, surface: LimitSurface, turn: Floats, spin: Floats, rate: Floats) -> None:
    """Runge-Kutta of fourth order in beta for psi and theta: dpsi = dbeta / beta', dtheta = theta' dbeta / beta'."""
    space, contact = workspace(), np.zeros((1, CONTACT_WIDTH))
    step = 0.5 * pi / (TIP_NODES - 1)
    g, w = tip_rates(hand, surface, 0.0, space, contact)
    rate[0] = g
    for k in range(1, TIP_NODES):
        beta = k * step
        middle_g, middle_w = tip_rates(hand, surface, beta - 0.5 * step, space, contact)
        next_g, next_w = tip_rates(hand, surface, beta, space, contact)
        turn[k] = turn[k - 1] + step / 6.0 * (1.0 / g + 4.0 / middle_g + 1.0 / next_g)
        spin[k] = spin[k - 1] + step / 6.0 * (w / g + 4.0 * middle_w / middle_g + next_w / next_g)
        g, w = next_g, next_w
        rate[k] = g


@compiled
def _range_that_moves(
    hand: ClosingHand, surface: LimitSurface, low: float, high: float, space: Workspace, contacts: Floats
) -> tuple[float, float]:
    """The part of [low, high] in which the finger moves the disk along the palm: neither wedged nor lifted; else empty."""
    first, last = high, low
    step = (high - low) / PALM_SAMPLES
    for k in range(PALM_SAMPLES):
        psi = low + (k + 0.5) * step
        rate = palm_spin_rate(hand, surface, psi, space, contacts)
        if rate == rate:
            first, last = min(first, psi), psi
        elif last > low:
            break
    if last < first:
        return low, low
    for edge in range(2):
        inside, outside = (first, max(first - step, low)) if edge == 0 else (last, min(last + step, high))
        rate = palm_spin_rate(hand, surface, outside, space, contacts)
        if rate == rate:
            inside = outside
        while abs(outside - inside) > 1e-13:
            middle = 0.5 * (inside + outside)
            rate = palm_spin_rate(hand, surface, middle, space, contacts)
            inside, outside = (middle, outside) if rate == rate else (inside, middle)
        first, last = (inside, last) if edge == 0 else (first, inside)
    return first, last


@compiled
def _fill_palm(hand: ClosingHand, surface: LimitSurface, spin: Floats, ranges: Floats) -> None:
    """Simpson's rule in psi, up to where the finger wedges the disk or lifts it; ``ranges`` as given are cut to that."""
    space, contacts = workspace(), np.zeros((2, CONTACT_WIDTH))
    for part in range(2):
        low, high = _range_that_moves(hand, surface, ranges[part, 0], ranges[part, 1], space, contacts)
        ranges[part, 0], ranges[part, 1] = low, high
        step = (high - low) / (PALM_NODES - 1)
        if step <= 0.0:
            continue
        last = palm_spin_rate(hand, surface, low, space, contacts)
        for k in range(1, PALM_NODES):
            psi = high if k == PALM_NODES - 1 else low + k * step
            middle = palm_spin_rate(hand, surface, psi - 0.5 * step, space, contacts)
            now = palm_spin_rate(hand, surface, psi, space, contacts)
            spin[part, k] = spin[part, k - 1] + step * (last + 4.0 * middle + now) / 6.0
            last = now


def build_tables(hand: ClosingHand, surface: LimitSurface) -> Tables:
    """Tables for one hand and disk; the limit surface matters only with friction."""
    hand = ClosingHand(*map(float, hand))
    turn, spin, rate = np.zeros(TIP_NODES), np.zeros(TIP_NODES), np.zeros(TIP_NODES)
    _fill_tip(hand, surface, turn, spin, rate)
    rho, across = hand.radius + hand.half_thickness, turn - np.linspace(0.0, 0.5 * pi, TIP_NODES)
    tip = pi - asin(min(hand.radius / hypot(hand.length, rho), 1.0)) - atan2(rho, hand.length)
    last = min(hand.last, pi - 1e-9)
    palm_spin = np.zeros((2, PALM_NODES))
    palm_range = np.array([[0.5 * pi, max(min(tip, last), 0.5 * pi)], [max(tip, 0.5 * pi), max(tip, last, 0.5 * pi)]])
    if hand.friction > 0.0:
        _fill_palm(hand, surface, palm_spin, palm_range)
    path_x = hand.length * np.cos(turn) - rho * np.sin(across)
    path_y = hand.length * np.sin(turn) + rho * np.cos(across)
    return Tables(turn, spin, rate, path_x, path_y, palm_spin, palm_range)
