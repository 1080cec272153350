"""A symmetric hand with straight fingers closes on a disk on a table: event to event, in closed form.

Both fingers turn from ``first`` to ``last`` at the same rate; a finger that stalls stays. The disk's centre starts at
(x, y); by mirror symmetry x >= 0, so the right finger comes first. Phases, with rho = R + h and e the elevation of a
contact above the disk's equator:

- link: the contact runs out along the finger, at rho per radian and without turning the disk (section 3.2) unless a
  thick finger's surface drags it (``closing_link``);
- tip: the table of ``closing_tables`` in beta, e = psi - 90 deg - beta;
- both: on the axis, wedged where |e| <= alpha, else carried to the palm (e > 0) or squeezed out (e < 0);
- palm: kept on the palm by link or tip, x follows from psi; wedged where half the angle between palm and finger's
  tangent at the disk is at most alpha; then the other finger goes on alone.

Fingers that collide instead of crossing only end earlier (``meeting``). A start behind a finger that is open by more than 0,
and is hit by the other one from outside, is left ``UNDECIDED``; such starts, polygons, bent links and uneven pressure are
for the stepping kernel.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_link import link_place, link_root, reach_at, spin_to_tip, turn_to_tip
from palmar.mechanics.pushing.closing_tables import PALM_NODES, ClosingHand, Tables
from palmar.mechanics.pushing.closing_tip import HALF, falling_from, tip_lean, tip_leaves, tip_phase, tip_place
from palmar.mechanics.pushing.first_touch import first_touch, overlaps
from palmar.mechanics.pushing.interpolation import between
from palmar.mechanics.pushing.meeting import straight_travel_end
from palmar.models.outcome import Outcome

Floats = NDArray[np.float64]
STRUCTURAL, FRICTIONAL, CAGED = Outcome.STRUCTURAL.code, Outcome.FRICTIONAL.code, Outcome.CAGED.code
ESCAPED, MISSED, INVALID, UNDECIDED = (
    Outcome.ESCAPED.code, Outcome.MISSED.code, Outcome.INVALID.code, Outcome.UNDECIDED.code,
)  # fmt: skip


class End(NamedTuple):
    """How it ended: outcome code, disk's centre and angle, right and left base angle at their stall or end."""

    code: int
    x: float
    y: float
    theta: float
    right: float
    left: float


@compiled
def close_on_disk(hand: ClosingHand, tables: Tables, alpha: float, x: float, y: float) -> End:
    """Carry the disk from (x, y) to the end of the motion."""
    if overlaps(hand, x, y):
        return End(INVALID, x, y, 0.0, hand.first, hand.first)
    side = 1.0 if x >= 0.0 else -1.0
    end = _from_first_touch(hand, tables, alpha, abs(x), y)
    if side > 0.0:
        return end
    return End(end.code, -end.x, end.y, -end.theta, end.left, end.right)


@compiled
def _from_first_touch(hand: ClosingHand, tables: Tables, alpha: float, x: float, y: float) -> End:
    rho = hand.radius + hand.half_thickness
    psi, along = first_touch(hand.half_palm, hand.length, rho, x, y)
    if not psi >= hand.first - 1e-12:
        other, _ = first_touch(hand.half_palm, hand.length, rho, -x, y)
        code = UNDECIDED if other > hand.first and other < hand.last else MISSED
        return End(code, x, y, 0.0, hand.last, hand.last)
    if psi >= hand.last:
        return _at_rest(hand, x, y, 0.0, MISSED)
    if along <= hand.length:
        return _on_link(hand, tables, alpha, psi, along)
    return _on_tip(hand, tables, alpha, psi, tip_lean(hand, psi, x, y), 0.0)


@compiled
def _at_rest(hand: ClosingHand, x: float, y: float, theta: float, outside: int) -> End:
    """The fingers end at ``last`` without a hold: caged if the disk lies below the tips and cannot pass between them."""
    tip_x, tip_y = hand.half_palm + hand.length * cos(hand.last), hand.length * sin(hand.last)
    gap = 2.0 * (tip_x - hand.half_thickness)
    inside = y < tip_y and abs(x) * sin(hand.last) < hand.half_palm * sin(hand.last) + y * cos(hand.last)
    code = CAGED if inside and gap < 2.0 * hand.radius else outside
    return End(code, x, y, theta, hand.last, hand.last)


@compiled
def _on_link(hand: ClosingHand, tables: Tables, alpha: float, psi0: float, r0: float) -> End:
    """Pushed by the right link from contact r0 at psi0: to the tip, the axis, the palm, or the end."""
    tip = psi0 + turn_to_tip(hand, tables, r0)
    stop = min(tip, hand.last)
    x, y = link_place(hand, stop, reach_at(hand, tables, tip - stop))
    axis, palm = np.inf, np.inf
    if x <= 0.0:
        axis = link_root(hand, tables, tip, 0.0, psi0, stop, True)
    falls = max(psi0, falling_from(hand, alpha))
    if stop > falls and y < hand.radius:
        palm = link_root(hand, tables, tip, hand.radius, falls, stop, False)
    here = min(axis, palm, stop)
    theta = spin_to_tip(hand, tables, r0) - spin_to_tip(hand, tables, reach_at(hand, tables, tip - here))
    if axis <= palm and axis <= stop:
        return _turned(_both_links(hand, alpha, axis), theta)
    if palm <= stop:
        return _palm(hand, tables, alpha, palm, theta)
    if tip <= hand.last:
        return _on_tip(hand, tables, alpha, tip, 0.0, theta)
    return _at_rest(hand, x, y, theta, ESCAPED)


@compiled
def _turned(end: End, theta: float) -> End:
    return End(end.code, end.x, end.y, end.theta + theta, end.right, end.left)


@compiled
def _both_links(hand: ClosingHand, alpha: float, psi: float) -> End:
    """On the axis between both links at psi."""
    d, length, rho = hand.half_palm, hand.length, hand.radius + hand.half_thickness
    if psi - HALF > alpha:
        return _down_the_axis(hand)
    grip = HALF - alpha
    if psi < grip and alpha > 0.0 and rho * cos(alpha) - d <= length * sin(alpha):
        psi = grip
    tip = asin(min(d / hypot(rho, length), 1.0)) + atan2(length, rho)
    holds = psi >= grip and alpha > 0.0
    if (psi if holds else tip) > hand.last:
        y = (rho - d * sin(hand.last)) / cos(hand.last)
        return End(ESCAPED, 0.0, y, 0.0, hand.last, hand.last)
    if holds:
        y = (rho - d * sin(psi)) / cos(psi) if abs(psi - HALF) > 1e-9 else length
        return End(FRICTIONAL, 0.0, y, 0.0, psi, psi)
    return _both_tips(hand, alpha, max(psi, tip), tip - HALF)


@compiled
def _both_tips(hand: ClosingHand, alpha: float, psi: float, e: float) -> End:
    """On the axis between both tips at psi, which touch at elevation e."""
    d, length, rho = hand.half_palm, hand.length, hand.radius + hand.half_thickness
    if abs(e) <= alpha and alpha > 0.0:
        return End(FRICTIONAL, 0.0, length * sin(psi) - rho * sin(e), 0.0, psi, psi)
    if e > 0.0:
        return _down_the_axis(hand)
    leaves = min(hand.last, acos(-min(d / (length + rho), 1.0)))
    tip_x = d + length * cos(leaves)
    y = length * sin(leaves) + sqrt(max(rho * rho - tip_x * tip_x, 0.0))
    return End(ESCAPED, 0.0, y, 0.0, hand.last, hand.last)


@compiled
def _down_the_axis(hand: ClosingHand) -> End:
    """Pressed down the axis onto the palm; caged with play if the fingers end before they reach it there."""
    d, length, h, radius = hand.half_palm, hand.length, hand.half_thickness, hand.radius
    psi = _touch_on_palm(d, length, radius + h, radius, 0.0)
    if psi <= hand.last:
        return End(STRUCTURAL, 0.0, radius, 0.0, psi, psi)
    rho, c, s = radius + h, cos(hand.last), sin(hand.last)
    y = (d * s - rho) / -c
    if -d * c + y * s > length:
        tip_x = d + length * c
        y = length * s - sqrt(max(rho * rho - tip_x * tip_x, 0.0))
    return End(CAGED, 0.0, y, 0.0, hand.last, hand.last)


@compiled
def _touch_on_palm(d: float, length: float, rho: float, radius: float, x: float) -> float:
    """psi at which the right finger touches a disk on the palm at x; NaN never."""
    psi, _ = first_touch(d, length, rho, x, radius)
    return psi


@compiled
def _on_tip(hand: ClosingHand, tables: Tables, alpha: float, psi0: float, beta0: float, theta0: float) -> End:
    """Pushed by the right tip alone: to the axis, the palm, the end, or past the disk (beta = 90 degrees)."""
    psi, beta, theta = tip_phase(hand, tables, psi0, beta0, theta0, hand.radius)
    x, y = tip_place(hand, psi, beta)
    if beta < HALF and psi < hand.last - 1e-12 and x > y - hand.radius:
        return _palm(hand, tables, alpha, psi, theta)
    return _after_tip(hand, alpha, psi, beta, theta)


@compiled
def _after_tip(hand: ClosingHand, alpha: float, psi: float, beta: float, theta: float) -> End:
    """The end of a tip phase anywhere but on the palm."""
    x, y = tip_place(hand, psi, beta)
    if beta >= HALF:
        return End(ESCAPED, x, y, theta, hand.last, hand.last)
    if psi >= hand.last - 1e-12:
        return _at_rest(hand, x, y, theta, ESCAPED)
    end = _both_tips(hand, alpha, psi, psi - HALF - beta)
    return _turned(end, theta)


@compiled
def _palm(hand: ClosingHand, tables: Tables, alpha: float, psi: float, theta: float) -> End:
    """Kept on the palm by the right finger, from psi: to the axis, a wedge, off the palm, or the end."""
    d, length, radius = hand.half_palm, hand.length, hand.radius
    rho = radius + hand.half_thickness
    centred = _touch_on_palm(d, length, rho, radius, 0.0)
    wedge = max(pi - 2.0 * alpha, psi) if alpha > 0.0 else np.inf
    tip = pi - asin(min(radius / hypot(length, rho), 1.0)) - atan2(rho, length)
    stop = min(wedge, hand.last)
    if centred <= min(tip, stop):
        return End(STRUCTURAL, 0.0, radius, theta + _palm_spin(tables, psi, centred), centred, centred)
    if stop <= tip:
        x = d - (rho - radius * cos(stop)) / sin(stop)
        theta += _palm_spin(tables, psi, stop)
        if stop >= hand.last:
            return _at_rest(hand, x, radius, theta, ESCAPED)
        return _wedged(hand, x, theta, stop)
    return _palm_by_tip(hand, tables, alpha, psi, max(psi, tip), theta)


@compiled
def _palm_spin(tables: Tables, begin: float, end: float) -> float:
    """The disk's turn on the palm from one psi to another; it rests where neither link nor tip moves it."""
    turn = 0.0
    for part in range(2):
        low, high = tables.palm_range[part, 0], tables.palm_range[part, 1]
        if high > low:
            scale, values = (PALM_NODES - 1) / (high - low), tables.palm_spin[part]
            turn += between(values, (min(max(end, low), high) - low) * scale)
            turn -= between(values, (min(max(begin, low), high) - low) * scale)
    return turn


@compiled
def _wedged(hand: ClosingHand, x: float, theta: float, right: float) -> End:
    """The right finger has stalled with the disk at (x, R); the left one goes on until it touches.

    If it then presses the disk into the wedge, the normals span the plane. If not, its tip touches between the palm and
    the point opposite to the right finger's contact; the line through these two contacts leans even less from the normals
    than the wedge's, so it lies in both cones and the left finger stalls, too.
    """
    rho = hand.radius + hand.half_thickness
    left, along = first_touch(hand.half_palm, hand.length, rho, -x, hand.radius)
    end = straight_travel_end(hand, right)
    if not left <= end:
        return End(FRICTIONAL, x, hand.radius, theta, right, end)
    rise = hand.radius - hand.length * sin(left)
    if along <= hand.length or rise <= 0.0:
        return End(STRUCTURAL, x, hand.radius, theta, right, left)
    drop = rho * -cos(right)
    if _touch_is_by_tip(hand, x, right):
        drop = hand.length * sin(right) - hand.radius
    if rise < drop - 1e-9 * rho:
        return End(STRUCTURAL, x, hand.radius, theta, right, left)
    return End(FRICTIONAL, x, hand.radius, theta, right, left)


@compiled
def _touch_is_by_tip(hand: ClosingHand, x: float, psi: float) -> bool:
    """Whether the right finger at psi touches the disk on the palm at x with its tip."""
    return (x - hand.half_palm) * cos(psi) + hand.radius * sin(psi) > hand.length


@compiled
def _palm_by_tip(hand: ClosingHand, tables: Tables, alpha: float, begin: float, psi: float, theta: float) -> End:
    """Kept on the palm by the right tip, which sinks along the disk until it would lift it."""
    d, length, radius, rho = hand.half_palm, hand.length, hand.radius, hand.radius + hand.half_thickness
    rise = (length * sin(psi) - radius) / rho
    if alpha > 0.0 and asin(min(rise, 1.0)) >= HALF - 2.0 * alpha:
        x = d + length * cos(psi) - rho * sqrt(max(1.0 - rise * rise, 0.0))
        return _wedged(hand, x, theta + _palm_spin(tables, begin, psi), psi)
    low, high = psi, pi - 1e-12
    if not tip_leaves(hand, tables, low):
        for _ in range(60):
            middle = 0.5 * (low + high)
            if tip_leaves(hand, tables, middle):
                high = middle
            else:
                low = middle
    else:
        high = low
    centred = _touch_on_palm(d, length, rho, radius, 0.0)
    if centred <= min(high, hand.last):
        e = asin((length * sin(centred) - radius) / rho)
        code = STRUCTURAL if e >= 0.0 else FRICTIONAL
        return End(code, 0.0, radius, theta + _palm_spin(tables, begin, centred), centred, centred)
    stop = min(high, hand.last)
    rise = (length * sin(stop) - radius) / rho
    theta += _palm_spin(tables, begin, stop)
    if stop >= hand.last:
        return _at_rest(hand, d + length * cos(stop) - rho * sqrt(max(1.0 - rise * rise, 0.0)), radius, theta, ESCAPED)
    psi, beta, theta = tip_phase(hand, tables, stop, max(stop - HALF - asin(rise), 0.0), theta, -np.inf)
    return _after_tip(hand, alpha, psi, beta, theta)
