"""All ways of a disk before a closing finger as one family of curves, and which of them end in a hold.

Slow motion has no memory. A disk pushed by the right finger is, at the finger's angle psi, somewhere on the curve of
centres that just touch the finger: along its side, then around its tip. Call tau the angle at which the disk has, or
would have had, its contact at the very end of the link (beta = 0): it stays the same while the finger pushes. So the
ways of all disks are the curves tau = const, a start belongs to the way that passes through it, and whether it is
caught is a function of tau alone. Smaller tau lie farther out. Derived in docs/derivations/exact_region.md.

Right half only (x >= 0); the left one is its mirror image.
"""

from __future__ import annotations

from math import acos, cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_disk import close_on_disk
from palmar.mechanics.pushing.closing_link import link_place, reach_at, turn_to_tip
from palmar.mechanics.pushing.closing_tables import TIP_NODES, ClosingHand, Tables
from palmar.mechanics.pushing.closing_tip import HALF, falling_from, tip_lean, tip_place
from palmar.mechanics.pushing.first_touch import first_touch
from palmar.mechanics.pushing.interpolation import between
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
NO_START, CAGED = Outcome.INVALID.code, Outcome.CAGED.code
NO_WAY = -1
"""Stands for the fate of a way on which no disk can stand."""
JUST_AFTER = 1e-5
"""A fate is asked of a start this far (rad) along its way, so that the finger is sure to meet it."""
SCANS, RETURN_SCANS, HALVINGS = 64, 24, 60
TAU_TOLERANCE, RISING = 1e-12, 0.02


@compiled
def tau_limits(hand: ClosingHand, tables: Tables) -> tuple[float, float]:
    """The range of tau: from the disk that the tip lets go at the start, to the one at the joint at the end."""
    return hand.first - tables.turn[TIP_NODES - 1], hand.last + turn_to_tip(hand, tables, 0.0)


def telling_taus(hand: ClosingHand, tables: Tables, alpha: float) -> list[float]:
    """Ways at which fates can change, as far as they are known beforehand.

    Those that reach the axis on the tip at the elevation -alpha (the last disk caught, as a rule) or +alpha, between the
    links at psi = 90 deg -+ alpha, and where the axis meets the palm.
    """
    d, length, rho = hand.half_palm, hand.length, hand.radius + hand.half_thickness
    found = []
    for e in (-alpha, alpha):
        cosine = (rho * cos(e) - d) / length
        beta = acos(cosine) - HALF - e if abs(cosine) <= 1.0 else -1.0
        if 0.0 <= beta <= HALF:
            found.append(acos(cosine) - between(tables.turn, beta / HALF * (TIP_NODES - 1)))
        psi = HALF + e
        reach = (rho * sin(psi) - d) / cos(psi) if alpha > 0.0 else -1.0
        if 0.0 <= reach <= length:
            found.append(psi + turn_to_tip(hand, tables, reach))
    psi, along = first_touch(d, length, rho, 0.0, hand.radius)
    if along <= length:
        found.append(psi + turn_to_tip(hand, tables, along))
    elif along > length:
        found.append(psi - between(tables.turn, tip_lean(hand, psi, 0.0, hand.radius) / HALF * (TIP_NODES - 1)))
    return found


@compiled
def lean_at(tables: Tables, turned: float) -> float:
    """beta after the finger has turned by this much since beta = 0; 90 degrees where the tip has let go."""
    turn, nodes = tables.turn, TIP_NODES - 1
    if turned >= turn[nodes]:
        return HALF
    low, high = 0, nodes
    while high - low > 1:
        middle = (low + high) // 2
        if turn[middle] <= turned:
            low = middle
        else:
            high = middle
    position = low + (turned - turn[low]) / (turn[high] - turn[low])
    for _ in range(3):
        step = (turned - between(turn, position)) * between(tables.rate, position) * nodes / HALF
        position = min(max(position + step, 0.0), float(nodes))
    return position / nodes * HALF


@compiled
def contact_on_way(hand: ClosingHand, tables: Tables, tau: float, psi: float) -> tuple[float, float]:
    """(r, beta) at psi on the way tau: r = L on the tip, beta = 0 on the link."""
    if psi < tau:
        return reach_at(hand, tables, tau - psi), 0.0
    return hand.length, lean_at(tables, psi - tau)


@compiled
def place_on_way(hand: ClosingHand, tables: Tables, tau: float, psi: float) -> tuple[float, float]:
    """The disk's centre at psi on the way tau."""
    r, beta = contact_on_way(hand, tables, tau, psi)
    return link_place(hand, psi, r) if psi < tau else tip_place(hand, psi, beta)


@compiled
def begin_of_way(hand: ClosingHand, tables: Tables, alpha: float, tau: float) -> float:
    """First psi at which a disk can stand on the way, clear of palm and open finger; NaN for none.

    The contact begins at the joint at the earliest, where the disk may still be too low for the palm.
    """
    low = max(hand.first, tau - turn_to_tip(hand, tables, 0.0))
    x, y = place_on_way(hand, tables, tau, low)
    if x < 0.0 or low >= hand.last:
        return np.nan
    if y >= hand.radius * (1.0 - 1e-12):
        return low
    before, high = low, min(falling_from(hand, alpha), hand.last)
    if high <= low:
        return np.nan
    while place_on_way(hand, tables, tau, high)[1] < hand.radius:
        before, high = high, high + RISING
        if high >= min(HALF, hand.last):
            return np.nan
    psi = _rise(hand, tables, tau, before, high)
    return psi if place_on_way(hand, tables, tau, psi)[0] >= 0.0 else np.nan


def ways_may_return(hand: ClosingHand) -> bool:
    """Whether a tip can lift a disk from below the palm's level: it is still before the axis when it is as low as R."""
    return hand.length <= hand.radius or hand.half_palm**2 >= hand.length**2 - hand.radius**2


@compiled
def return_of_way(hand: ClosingHand, tables: Tables, alpha: float, tau: float) -> float:
    """psi at which the tip lifts the way off the palm line for good; NaN if it is not below it before.

    Disks that come down to the palm on such a way stay on the palm longer than the way does; what lies on it from here on
    are starts that the tip meets from below.
    """
    low = max(max(hand.first, tau), falling_from(hand, alpha))
    high = min(hand.last, tau + tables.turn[TIP_NODES - 1])
    before, found, last = np.nan, np.nan, np.nan
    for k in range(RETURN_SCANS + 1 if high > low else 0):
        psi = low + (high - low) * k / RETURN_SCANS
        x, y = place_on_way(hand, tables, tau, psi)
        if y >= hand.radius and last == last:
            before, found = last, psi
        if x < 0.0:
            break
        last = psi if y < hand.radius else np.nan
    if found != found:
        return np.nan
    psi = _rise(hand, tables, tau, before, found)
    return psi if place_on_way(hand, tables, tau, psi)[0] >= 0.0 else np.nan


@compiled
def _rise(hand: ClosingHand, tables: Tables, tau: float, low: float, high: float) -> float:
    """psi in [low, high] at which the disk is just clear of the palm line: false position (Illinois), from above."""
    f_low = place_on_way(hand, tables, tau, low)[1] - hand.radius
    f_high = place_on_way(hand, tables, tau, high)[1] - hand.radius
    for _ in range(HALVINGS):
        psi = high - f_high * (high - low) / (f_high - f_low)
        f = place_on_way(hand, tables, tau, psi)[1] - hand.radius
        if f >= 0.0:
            high, f_high, f_low = psi, f, 0.5 * f_low
        else:
            low, f_low, f_high = psi, f, 0.5 * f_high
        if f_high <= 1e-13 * hand.radius or high - low <= 1e-14:
            break
    return high


@compiled
def end_of_way(hand: ClosingHand, tables: Tables, alpha: float, tau: float, begin: float) -> float:
    """psi at which the way ends: on the axis, on the palm, where the tip lets go, or with the motion."""
    last, falls = min(hand.last, tau + tables.turn[TIP_NODES - 1]), falling_from(hand, alpha)
    low = begin
    for k in range(1, SCANS + 1):
        high = begin + (last - begin) * k / SCANS
        if not _arrived(hand, tables, tau, high, falls):
            low = high
            continue
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if _arrived(hand, tables, tau, middle, falls):
                high = middle
            else:
                low = middle
        return high
    return last


@compiled
def _arrived(hand: ClosingHand, tables: Tables, tau: float, psi: float, falls: float) -> bool:
    x, y = place_on_way(hand, tables, tau, psi)
    return x <= 0.0 or (psi > falls and y <= hand.radius)


@compiled
def fate(hand: ClosingHand, tables: Tables, alpha: float, tau: float, returned: bool) -> int:
    """How a way ends, or the part of it that has returned from the palm; NO_START where no disk can stand on it."""
    begin = return_of_way(hand, tables, alpha, tau) if returned else begin_of_way(hand, tables, alpha, tau)
    psi = begin + JUST_AFTER
    if not psi < hand.last:
        return NO_START
    x, y = place_on_way(hand, tables, tau, psi)
    return close_on_disk(hand, tables, alpha, x, max(y, hand.radius)).code


@compiled
def is_caught(hand: ClosingHand, tables: Tables, alpha: float, tau: float, returned: bool) -> int:
    """Whether the disk on a way is caught, 1 or 0; NO_WAY where no disk can stand on it."""
    code = fate(hand, tables, alpha, tau, returned)
    if code == NO_START:
        return NO_WAY
    return 1 if code <= CAGED else 0


@compiled
def fates(
    hand: ClosingHand,
    tables: Tables,
    alpha: float,
    taus: Floats,
    returned: bool,
    caught: NDArray[np.int8],
    ends: Floats,
) -> None:
    """``is_caught`` of each of rising ``taus`` (N,), and in ``ends`` (N,) the tau up to which it is that of the one before.

    ``ends[k]`` is bisected where a way differs from the one before and disks can stand on it, else it is taus[k].
    """
    for k in range(len(taus)):
        caught[k] = is_caught(hand, tables, alpha, taus[k], returned)
        ends[k] = taus[k]
        if k == 0 or caught[k] == caught[k - 1] or caught[k] == NO_WAY:
            continue
        low, high = taus[k - 1], taus[k]
        while high - low > TAU_TOLERANCE:
            middle = 0.5 * (low + high)
            if is_caught(hand, tables, alpha, middle, returned) == caught[k - 1]:
                low = middle
            else:
                high = middle
        ends[k] = high


@compiled
def way_points(hand: ClosingHand, tables: Tables, tau: float, begin: float, end: float, points: Floats) -> float:
    """Fill ``points`` (N, 2) at equal steps of psi; returns a bound (m) of the distance of the chords from the way."""
    step, sharpest = (end - begin) / (len(points) - 1), 0.0
    for k in range(len(points)):
        psi = begin + k * step
        r, beta = contact_on_way(hand, tables, tau, psi)
        points[k, 0], points[k, 1] = link_place(hand, psi, r) if psi < tau else tip_place(hand, psi, beta)
        sharpest = max(sharpest, _bend_on_link(hand) if psi < tau else _bend_on_tip(hand, tables, beta))
    return 1.2 * sharpest * step * step / 8.0


@compiled
def _bend_on_link(hand: ClosingHand) -> float:
    """Bound of |c''| (m) on a link: c'' = (r'' - r) d + (2 r' - rho) n, with 0 < r' <= rho and |r''| <= mu rho."""
    rho = hand.radius + hand.half_thickness
    drag = hand.friction * rho if hand.half_thickness > 0.0 else 0.0
    return hypot(hand.length + drag, rho)


@compiled
def _bend_on_tip(hand: ClosingHand, tables: Tables, beta: float) -> float:
    """Bound of |c''| (m) on the tip: c'' = -L d - rho (1 - g)^2 m - rho g g_beta p with g = beta'."""
    nodes = TIP_NODES - 1
    k = min(int(beta / HALF * nodes), nodes - 1)
    rate, growth = tables.rate[k], (tables.rate[k + 1] - tables.rate[k]) * nodes / HALF
    return hand.length + (hand.radius + hand.half_thickness) * hypot((1.0 - rate) ** 2, rate * growth)


@compiled
def clearance(
    hand: ClosingHand, psi: float, back: float, reach: float, beta: float, clear: bool, points: Floats
) -> None:
    """Centres that just clear the right finger at psi: about the joint, along the link to ``reach``, about its end.

    Fills ``points`` (2 N, 2): N from the direction ``back`` to the finger's normal, N from there to the lean ``beta``.
    ``clear``: the chords are tangents, which keep the clearance; else they cut it.
    """
    half, normal = len(points) // 2, psi + HALF
    _arc(hand, hand.half_palm, 0.0, max(back, normal), normal, clear, points[:half])
    _arc(hand, hand.half_palm + reach * cos(psi), reach * sin(psi), normal, normal - beta, clear, points[half:])


@compiled
def _arc(hand: ClosingHand, x: float, y: float, begin: float, end: float, clear: bool, points: Floats) -> None:
    """An arc of radius rho about (x, y): its ends, and between them corners of tangents or points."""
    last = len(points) - 1
    step = (end - begin) / (last - 1)
    for k in range(last + 1):
        inside = 0 < k < last
        rho = (hand.radius + hand.half_thickness) / (cos(0.5 * step) if clear and inside else 1.0)
        angle = begin + (k - 0.5) * step if inside else (begin if k == 0 else end)
        points[k, 0], points[k, 1] = x + rho * cos(angle), y + rho * sin(angle)
