"""One disk on one turning fingertip, followed through the table of its hand to where the tip phase ends."""

from __future__ import annotations

from math import asin, atan, atan2, cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_tables import TIP_NODES, ClosingHand, Tables
from palmar.mechanics.pushing.interpolation import between

Floats = NDArray[np.float64]
HALF = 0.5 * pi


@compiled
def tip_phase(
    hand: ClosingHand, tables: Tables, psi0: float, beta0: float, theta0: float, floor: float
) -> tuple[float, float, float]:
    """(psi, beta, theta) at which the tip phase from (psi0, beta0) ends; ``floor`` is the height of a disk on the palm."""
    step, nodes = HALF / (TIP_NODES - 1), TIP_NODES - 1
    turn0, spin0 = between(tables.turn, beta0 / step), between(tables.spin, beta0 / step)
    offset, falls = psi0 - turn0, falling_from(hand, atan(hand.friction))
    c, s = cos(offset), sin(offset)
    if _room_at(hand, tables, offset, c, s, nodes, floor, falls) > 0.0:
        return offset + tables.turn[nodes], HALF, theta0 + tables.spin[nodes] - spin0
    first, last = int(beta0 / step), nodes
    while last - first > 1:
        middle = (first + last) // 2
        if _room_at(hand, tables, offset, c, s, middle, floor, falls) > 0.0:
            first = middle
        else:
            last = middle
    beta = _tip_event(hand, tables, offset, max(first * step, beta0), last * step, floor, falls)
    return offset + between(tables.turn, beta / step), beta, theta0 + between(tables.spin, beta / step) - spin0


@compiled
def _tip_event(
    hand: ClosingHand, tables: Tables, offset: float, low: float, high: float, floor: float, falls: float
) -> float:
    """beta in [low, high] where the room falls to 0: false position, its stale end halved (Illinois)."""
    c, s = cos(offset), sin(offset)
    f_low = _room_between(hand, tables, offset, c, s, low, floor, falls)
    f_high = _room_between(hand, tables, offset, c, s, high, floor, falls)
    if f_low <= 0.0:
        return low
    for _ in range(40):
        beta = high - f_high * (high - low) / (f_high - f_low)
        room = _room_between(hand, tables, offset, c, s, beta, floor, falls)
        if abs(room) <= 1e-14 * hand.length or abs(high - low) <= 1e-15:
            return beta
        if room * f_high < 0.0:
            low, f_low = high, f_high
        else:
            f_low *= 0.5
        high, f_high = beta, room
    return high


@compiled
def falling_from(hand: ClosingHand, alpha: float) -> float:
    """psi up to which a pushed disk surely rises: 90 degrees, less where a thick finger's surface drags it down."""
    return HALF - alpha if hand.half_thickness > 0.0 else HALF


@compiled
def tip_place(hand: ClosingHand, psi: float, beta: float) -> tuple[float, float]:
    """The disk's centre on the right tip."""
    rho = hand.radius + hand.half_thickness
    x = hand.half_palm + hand.length * cos(psi) - rho * sin(psi - beta)
    return x, hand.length * sin(psi) + rho * cos(psi - beta)


@compiled
def tip_lean(hand: ClosingHand, psi: float, x: float, y: float) -> float:
    """beta of a disk at (x, y) that the tip touches at psi."""
    mx, my = x - hand.half_palm - hand.length * cos(psi), y - hand.length * sin(psi)
    return atan2(mx * cos(psi) + my * sin(psi), my * cos(psi) - mx * sin(psi))


@compiled
def _room_at(
    hand: ClosingHand, tables: Tables, offset: float, c: float, s: float, k: int, floor: float, falls: float
) -> float:
    """Length left at a node of the table, the path turned by ``offset`` with cosine c and sine s."""
    u, v = tables.path_x[k], tables.path_y[k]
    return _room(hand, offset + tables.turn[k], hand.half_palm + c * u - s * v, s * u + c * v, floor, falls)


@compiled
def _room_between(
    hand: ClosingHand, tables: Tables, offset: float, c: float, s: float, beta: float, floor: float, falls: float
) -> float:
    """The same between nodes."""
    position = beta / HALF * (TIP_NODES - 1)
    u, v = between(tables.path_x, position), between(tables.path_y, position)
    turn = between(tables.turn, position)
    return _room(hand, offset + turn, hand.half_palm + c * u - s * v, s * u + c * v, floor, falls)


@compiled
def _room(hand: ClosingHand, psi: float, x: float, y: float, floor: float, falls: float) -> float:
    """Length left before the tip phase ends: on the axis, on the palm (from psi = ``falls``), or at the end of travel."""
    room = min(x, (hand.last - psi) * hand.length)
    return min(room, y - floor) if psi > falls else room


@compiled
def tip_leaves(hand: ClosingHand, tables: Tables, psi: float) -> bool:
    """Whether the tip alone would move a disk on the palm upwards."""
    rho = hand.radius + hand.half_thickness
    rise = (hand.length * sin(psi) - hand.radius) / rho
    if rise <= -1.0:
        return True
    beta = psi - HALF - asin(min(rise, 1.0))
    if beta >= HALF:
        return True
    rate = between(tables.rate, max(beta, 0.0) / HALF * (TIP_NODES - 1))
    return hand.length * cos(psi) - rho * (1.0 - rate) * sin(psi - beta) >= 0.0
