"""One disk on the side of a closing finger: how far out it is when, and where it meets the axis or the palm.

The contact runs out along the finger, r' = rho - r tan gamma with gamma from ``drag``. For a line finger, and for any
finger without friction, tan gamma = 0 and r grows at rho per radian.
"""

from __future__ import annotations

from math import cos, sin

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables
from palmar.mechanics.pushing.interpolation import between

LAST_STEP = 1e-5
"""Step (rad) from which the next one would be of its third power, 1e-15."""


@compiled
def turn_to_tip(hand: ClosingHand, tables: Tables, r: float) -> float:
    """How far the finger turns (rad) until a contact at r reaches the tip."""
    if len(tables.link_turn) == 0:
        return (hand.length - r) / (hand.radius + hand.half_thickness)
    return between(tables.link_turn, r / hand.length * (len(tables.link_turn) - 1))


@compiled
def reach_at(hand: ClosingHand, tables: Tables, left: float) -> float:
    """Distance r of the contact from the joint when the finger has ``left`` (rad) to turn until it reaches the tip."""
    if len(tables.link_turn) == 0:
        return hand.length - (hand.radius + hand.half_thickness) * left
    return between(tables.link_reach, left / tables.link_turn[0] * (len(tables.link_reach) - 1))


@compiled
def spin_to_tip(hand: ClosingHand, tables: Tables, r: float) -> float:
    """How far the disk turns (rad) until a contact at r reaches the tip."""
    if len(tables.link_turn) == 0:
        return 0.0
    return between(tables.link_spin, r / hand.length * (len(tables.link_spin) - 1))


@compiled
def link_place(hand: ClosingHand, psi: float, r: float) -> tuple[float, float]:
    """The disk's centre on the right finger's side."""
    rho = hand.radius + hand.half_thickness
    return hand.half_palm + r * cos(psi) - rho * sin(psi), r * sin(psi) + rho * cos(psi)


@compiled
def link_root(
    hand: ClosingHand, tables: Tables, tip: float, level: float, low: float, high: float, horizontal: bool
) -> float:
    """psi in [low, high] where x (horizontal) or y of the disk that is to reach the tip at ``tip`` falls to ``level``.

    It is above at low, below at high: Halley's method inside the bracket, with r' = rho, x' = -r sin psi, y' = r cos psi.
    Of third order where nothing drags, so that the step after one of ``LAST_STEP`` is left out; else repeated to the end.
    """
    rho = hand.radius + hand.half_thickness
    psi, last = 0.5 * (low + high), LAST_STEP if len(tables.link_turn) == 0 else 1e-12
    for _ in range(60):
        r, c, s = reach_at(hand, tables, tip - psi), cos(psi), sin(psi)
        value = (hand.half_palm + r * c - rho * s if horizontal else r * s + rho * c) - level
        slope, bend = (-r * s, -rho * s - r * c) if horizontal else (r * c, rho * c - r * s)
        if value > 0.0:
            low = psi
        else:
            high = psi
        below = slope * slope - 0.5 * value * bend
        step = psi - value * slope / below if below > 0.0 else low
        if not low < step < high:
            step = 0.5 * (low + high)
        if abs(step - psi) <= last:
            return step
        psi = step
    return psi
