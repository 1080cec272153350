"""Whether some height above the palm exists at which friction holds a squeezed polygon.

Good postures are those of polygon_staircase: a squeeze there is a hold. Derived in docs/derivations/polygons.md:

- Up to 90 deg, raising the object and closing further only raises the sum of the elevations. So a hold exists if the
  fingers squeeze the object on the palm by then and some good posture up to 90 deg leaves room.
- Beyond, the lifts blocked at one psi form an interval. Its upper end, the crest, is where an object held higher and
  higher is squeezed at last. Holds begin where the crest, while it rises, comes to lie under the staircase, which is at
  a step of it, or where the fingers, having passed under an object above a former crest, come to squeeze it later.
"""

from __future__ import annotations

import numpy as np

from palmar.mechanics.closure.bracketing import falling_zero, halved
from palmar.mechanics.closure.polygon_friction import friction_needed
from palmar.mechanics.closure.polygon_outline import RIGHT_ANGLE, Bools, Floats, Indices
from palmar.mechanics.closure.polygon_squeeze import Bout, squeeze, touch
from palmar.mechanics.closure.polygon_staircase import first_good, has_room, reach

ANGLE_TOLERANCE = 1e-10
"""Friction angles (rad) that differ by less count as equal: the limit counts as held."""
NODES = 49
"""Finger angles beyond 90 deg at which the crest is looked at."""
LEAST_HALVINGS = 32
ZOOMS, ZOOM_NODES = 6, 17
ABOVE = (1e-6, 1e-3)
"""How far over a crest the object is tried, as shares of the finger length."""
BATCH = 20_000


def holds_off_palm(at: Bout, alpha: Floats, palm_psi: Floats) -> Bools:
    """Whether the friction angle alpha > 0 (rad) holds the polygon at some height, for each orientation (M,).

    ``palm_psi`` (M,) is where the fingers squeeze it on the palm. Whatever is said to be held is held. Holds that only
    a second crest offers are looked for at nodes 2 deg apart.
    """
    upright = np.full(at.size, RIGHT_ANGLE)
    held = palm_psi < RIGHT_ANGLE
    early = np.flatnonzero(held)
    some = first_good(at.at(early), alpha[early], (upright - alpha)[early], upright[early], any_will_do=True)
    held[early] = np.isfinite(some)
    rest = np.flatnonzero(~held)
    low = np.where(np.isfinite(palm_psi), np.maximum(palm_psi, upright), upright)[rest]
    first = first_good(at.at(rest), alpha[rest], low, np.full(len(rest), at.last_psi))
    rest, first = rest[np.isfinite(first)], first[np.isfinite(first)]
    held[rest] = _held(at.at(rest), alpha[rest], crest(at.at(rest), first))
    rest = rest[~held[rest]]
    for start in range(0, len(rest), BATCH):
        left = rest[start : start + BATCH]
        held[left] = _held_later(at.at(left), alpha[left])
    return held


def _held(at: Bout, alpha: Floats, lift: Floats) -> Bools:
    held = lift >= 0.0
    here, height = at.at(held), lift[held]
    held[held] = friction_needed(here, height, squeeze(here, height)) <= alpha[held] + ANGLE_TOLERANCE
    return held


def _held_later(at: Bout, alpha: Floats) -> Bools:
    """Tries the crest wherever it comes to lie under the staircase, at the nodes there, and above each former crest."""
    nodes = np.linspace(RIGHT_ANGLE, at.last_psi, NODES)
    item, psi = np.repeat(np.arange(at.size), NODES), np.tile(nodes, at.size)
    touched = np.flatnonzero(_could_touch(at.at(item), psi))
    lift = np.full(len(item), -1.0)
    lift[touched] = crest(at.at(item[touched]), psi[touched])
    good = has_room(at.at(item), psi, reach(at.at(item), psi, alpha[item]))
    enters = np.flatnonzero(good[1:] & ~good[:-1] & (lift[1:] >= 0.0) & (item[1:] == item[:-1]))
    here, limit = at.at(item[enters]), alpha[item[enters]]
    into = halved(lambda each: ~has_room(here, each, reach(here, each, limit)), psi[enters], psi[enters + 1])[1]
    over = _above_crests(at, lift.reshape(-1, NODES), good.reshape(-1, NODES), nodes)
    items = np.concatenate([item[enters], item[good], over[0]])
    lifts = np.concatenate([crest(here, into), lift[good], over[1]])
    held = np.zeros(at.size, dtype=np.bool_)
    np.logical_or.at(held, items, _held(at.at(items), alpha[items], lifts))
    return held


def _could_touch(at: Bout, psi: Floats) -> Bools:
    """Whether a polygon at some height could be touched from both sides at psi beyond 90 deg.

    It would have to span the way between a tip and the other finger's line, and, no higher than the tips, that between
    the tips.
    """
    gap, angle = at.half_palm + at.finger_length * np.cos(psi), np.tile(psi, 2) - RIGHT_ANGLE
    sides, h = at.sides, at.half_thickness
    (x, y), (x_low, y_low) = sides.corner(sides.support(angle)), sides.corner(sides.support(angle - 2.0 * RIGHT_ANGLE))
    across = (x - x_low) * np.cos(angle) + (y - y_low) * np.sin(angle)
    spans = across.reshape(2, -1).min(axis=0) + 2.0 * h >= 2.0 * gap * np.sin(psi) - at.room
    tip = np.tile(at.finger_length * np.sin(psi), 2)
    x_most, y_most = sides.corner(sides.support(np.zeros(len(tip))))
    reached = np.where(y_most <= tip, x_most + h, sides.boundary(tip, h)[0])
    touched: Bools = spans & (reached.reshape(2, -1).sum(axis=0) >= 2.0 * gap - at.room)
    return touched


def crest(at: Bout, psi: Floats) -> Floats:
    """Upper end (m) of the lifts that are blocked at each finger angle beyond 90 deg; -1 where none is.

    The play is convex in the lift, with the rate -tan e_R - tan e_L.
    """
    bottom, top = np.zeros(at.size), at.finger_length * np.sin(psi) + at.half_thickness
    least, _ = halved(lambda lift: touch(at, psi, lift).elevations.sum(axis=0) > 0.0, bottom, top, LEAST_HALVINGS)
    blocked = touch(at, psi, least).play < -at.room
    upper = np.full(at.size, -1.0)
    here, angle = at.at(blocked), psi[blocked]

    def lack(some: Indices, lift: Floats) -> tuple[Floats, Floats]:
        contact = touch(here.at(some), angle[some], lift)
        return -at.room - contact.play, np.tan(contact.elevations).sum(axis=0)

    upper[blocked] = falling_zero(lack, least[blocked], top[blocked])
    return upper


def _above_crests(at: Bout, crests: Floats, good: Bools, psi: Floats) -> tuple[Indices, Floats]:
    """Items, and lifts just above each crest, where the fingers pass under the object before they come to good nodes."""
    falls = (crests[:, 1:-1] > np.maximum(crests[:, :-2], -0.5)) & (crests[:, 1:-1] >= crests[:, 2:])
    good_later = np.logical_or.accumulate(good[:, ::-1], axis=1)[:, ::-1]
    item, node = np.nonzero(falls & good_later[:, 2:])
    low, high, top = psi[node], psi[node + 2], crests[item, node + 1]
    shares = np.linspace(0.0, 1.0, ZOOM_NODES)
    for _ in range(ZOOMS if len(item) else 0):
        between = low[:, None] + (high - low)[:, None] * shares
        found = crest(at.at(np.repeat(item, ZOOM_NODES)), between.ravel()).reshape(between.shape)
        best, each = found.argmax(axis=1), np.arange(len(item))
        top = np.maximum(top, found[each, best])
        low, high = between[each, np.maximum(best - 1, 0)], between[each, np.minimum(best + 1, ZOOM_NODES - 1)]
    lifts = top[:, None] + at.finger_length * np.array(ABOVE)
    return np.repeat(item, len(ABOVE)), lifts.ravel()
