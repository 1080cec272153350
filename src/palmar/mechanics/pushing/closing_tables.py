"""What a disk does on a closing fingertip, on a thick link, or between finger and palm, as functions of one number.

Seen from the turning finger, a disk on the fingertip is described by one angle: beta, from the finger's pushing normal
n to the contact normal m (towards the disk's centre). Quasi-static motion has no memory, so beta' is a function of beta
alone, for any friction: beta' = 1 + (L / rho) (sin beta - cos beta tan gamma), gamma from ``drag``. On the side of a link
the contact's distance r from the joint serves likewise, r' = rho - r tan gamma; the surface of a thick finger moves
inwards at h per radian and drags the disk. One table a hand serves every start. A disk kept on the palm by a finger has
its place given by psi, and only its spin depends on friction: one table over psi. Derived in
docs/derivations/tip_phase.md.
"""

from __future__ import annotations

from math import asin, atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled, compiled_to_allocate
from palmar.mechanics.pushing.contact_solve import CONTACT_WIDTH, Workspace, workspace
from palmar.mechanics.pushing.drag import drag_table, slipping_from, sticking_lean
from palmar.mechanics.pushing.limit_surface import LimitSurface
from palmar.mechanics.pushing.motion_solve import solve_motion

Floats = NDArray[np.float64]
TIP_NODES, LINK_NODES, PALM_NODES, PALM_SAMPLES = 2049, 1025, 257, 64


class ClosingHand(NamedTuple):
    """Half palm D, finger length L, half thickness h, disk radius R (m), friction, first and last base angle (rad).

    ``alone`` is where a finger would end if the other were not there to be met; 0: they pass each other (``meeting``).
    """

    half_palm: float
    length: float
    half_thickness: float
    radius: float
    friction: float
    first: float
    last: float
    alone: float = 0.0


class Tables(NamedTuple):
    """``turn`` and ``spin``: psi and the disk's angle since beta = 0, at equal steps of beta up to 90 degrees.

    ``rate`` is dbeta/dpsi there; ``path_x``, ``path_y`` the disk's centre from the base joint if psi is 0 at beta = 0:
    any other tip phase is this path turned about the joint. ``link_turn`` and ``link_spin``: how far finger and disk
    turn until the contact reaches the tip, at equal steps of its distance from the joint; ``link_reach``: that distance
    at equal steps of the turn that is left; all three empty where the distance grows at R + h (lines, or no friction).
    ``palm_spin`` (2, N): the disk's angle at equal steps of psi over the two ranges ``palm_range`` (2, 2) in which the
    link, and the tip, move it along the palm.
    """

    turn: Floats
    spin: Floats
    rate: Floats
    path_x: Floats
    path_y: Floats
    link_turn: Floats
    link_spin: Floats
    link_reach: Floats
    palm_spin: Floats
    palm_range: Floats


@compiled_to_allocate
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
def _rates_on_tip(hand: ClosingHand, drag: Floats, slips: float, beta: float) -> tuple[float, float]:
    """(beta', theta') per radian of the finger."""
    c, s, rho = cos(beta), sin(beta), hand.radius + hand.half_thickness
    sideways = s + hand.half_thickness / hand.length
    t = sideways / c if c > 1e-9 else np.inf
    if hand.friction == 0.0:
        return 1.0 + hand.length / rho * s, 0.0
    leaning = hand.friction if t >= slips else sticking_lean(drag, t)
    k = _rim_speed(min(t, slips), leaning)
    speed = hand.length * c * sqrt(1.0 + leaning * leaning)
    return 1.0 + hand.length / rho * (s - c * leaning), -k * speed / hand.radius


@compiled
def _rim_speed(t: float, leaning: float) -> float:
    """k of ``drag`` for a contact that sticks at t with tan gamma = ``leaning``."""
    return (t - leaning) / sqrt(1.0 + leaning * leaning)


@compiled
def _fill_tip(hand: ClosingHand, drag: Floats, slips: float, turn: Floats, spin: Floats, rate: Floats) -> None:
    """Simpson's rule in beta for psi and theta: dpsi = dbeta / beta', dtheta = theta' dbeta / beta'."""
    step = 0.5 * pi / (TIP_NODES - 1)
    g, w = _rates_on_tip(hand, drag, slips, 0.0)
    rate[0] = g
    for k in range(1, TIP_NODES):
        middle_g, middle_w = _rates_on_tip(hand, drag, slips, (k - 0.5) * step)
        next_g, next_w = _rates_on_tip(hand, drag, slips, k * step)
        turn[k] = turn[k - 1] + step / 6.0 * (1.0 / g + 4.0 / middle_g + 1.0 / next_g)
        spin[k] = spin[k - 1] + step / 6.0 * (w / g + 4.0 * middle_w / middle_g + next_w / next_g)
        g, w = next_g, next_w
        rate[k] = g


@compiled
def _rates_on_link(hand: ClosingHand, drag: Floats, slips: float, r: float) -> tuple[float, float]:
    """(r', theta') per radian of a finger whose thick side touches at distance r from the joint."""
    h, rho = hand.half_thickness, hand.radius + hand.half_thickness
    if r * slips <= h:
        k = _rim_speed(slips, hand.friction)
        return rho - hand.friction * r, -k * r * sqrt(1.0 + hand.friction**2) / hand.radius
    leaning = sticking_lean(drag, h / r)
    return rho - r * leaning, -_rim_speed(h / r, leaning) * r * sqrt(1.0 + leaning * leaning) / hand.radius


@compiled
def _fill_link(hand: ClosingHand, drag: Floats, slips: float, turn: Floats, spin: Floats, reach: Floats) -> None:
    """``turn`` and ``spin`` by Simpson's rule in r, down from the tip; ``reach`` by Runge and Kutta's in the turn."""
    step = hand.length / (LINK_NODES - 1)
    g, w = _rates_on_link(hand, drag, slips, hand.length)
    for k in range(LINK_NODES - 2, -1, -1):
        middle_g, middle_w = _rates_on_link(hand, drag, slips, (k + 0.5) * step)
        next_g, next_w = _rates_on_link(hand, drag, slips, k * step)
        turn[k] = turn[k + 1] + step / 6.0 * (1.0 / g + 4.0 / middle_g + 1.0 / next_g)
        spin[k] = spin[k + 1] + step / 6.0 * (w / g + 4.0 * middle_w / middle_g + next_w / next_g)
        g, w = next_g, next_w
    step = turn[0] / (LINK_NODES - 1)
    reach[0] = hand.length
    for k in range(1, LINK_NODES):
        r = reach[k - 1]
        one = _rates_on_link(hand, drag, slips, r)[0]
        two = _rates_on_link(hand, drag, slips, max(r - 0.5 * step * one, 0.0))[0]
        three = _rates_on_link(hand, drag, slips, max(r - 0.5 * step * two, 0.0))[0]
        four = _rates_on_link(hand, drag, slips, max(r - step * three, 0.0))[0]
        reach[k] = max(r - step / 6.0 * (one + 2.0 * two + 2.0 * three + four), 0.0)


@compiled_to_allocate
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


@compiled_to_allocate
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


def build_tables(hand: ClosingHand, surface: LimitSurface, *, spin: bool = True) -> Tables:
    """Tables for one hand and disk; the limit surface matters only with friction.

    ``spin`` = False leaves out how the disk turns on the palm, which takes longest and does not decide where it goes.
    """
    hand = ClosingHand(*map(float, hand))
    turn, turned, rate = np.zeros(TIP_NODES), np.zeros(TIP_NODES), np.zeros(TIP_NODES)
    thick = hand.friction > 0.0 and hand.half_thickness > 0.0
    link_turn, link_spin, link_reach = np.zeros((3, LINK_NODES if thick else 0))
    drag = drag_table(surface, hand.radius) if hand.friction > 0.0 else np.zeros(4)
    slips = slipping_from(drag, hand.friction) if hand.friction > 0.0 else 0.0
    _fill_tip(hand, drag, slips, turn, turned, rate)
    if thick:
        _fill_link(hand, drag, slips, link_turn, link_spin, link_reach)
    rho, across = hand.radius + hand.half_thickness, turn - np.linspace(0.0, 0.5 * pi, TIP_NODES)
    tip = pi - asin(min(hand.radius / hypot(hand.length, rho), 1.0)) - atan2(rho, hand.length)
    last = min(hand.last, pi - 1e-9)
    palm_spin = np.zeros((2, PALM_NODES))
    palm_range = np.array([[0.5 * pi, max(min(tip, last), 0.5 * pi)], [max(tip, 0.5 * pi), max(tip, last, 0.5 * pi)]])
    if hand.friction > 0.0 and spin:
        _fill_palm(hand, surface, palm_spin, palm_range)
    path_x = hand.length * np.cos(turn) - rho * np.sin(across)
    path_y = hand.length * np.sin(turn) + rho * np.cos(across)
    return Tables(turn, turned, rate, path_x, path_y, link_turn, link_spin, link_reach, palm_spin, palm_range)
