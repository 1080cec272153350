"""Brute-force decision whether a 2-jointed hand (one link a finger) can hold a convex polygon at a given orientation.

The polygon is put at many heights above the palm. At each one both fingers turn from open in small steps; the room
beside the polygon is measured by horizontal rays, from its corners to the finger and from the tip of the finger to its
edges. Where the room of both sides together first vanishes the fingers squeeze it; steps that come near to that are cut
up again and again. The forces that the touching bodies can exert are then taken as directions in the plane, and the grasp
holds if no open half plane is free of them, which is to say if no gap between neighbouring directions exceeds 180 degrees.

Heights at which the answer comes near to yes are cut up likewise. Nothing is assumed of how room, contact or answer
depend on angle and height, except that features far below the steps may be missed. Fingers have the length 1. Thick ones
are taken as lines before a polygon that is grown by half their thickness, its round corners cut into short edges.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

PSI = np.concatenate([np.linspace(1e-7, 2.8, 81), np.pi - np.geomspace(np.pi - 2.8, 1e-6, 40)[1:]])
"""Finger angles, closer where the fingers fold onto the palm and the room changes fast."""
HEIGHT_STEPS, HEIGHT_CUTS, PIECES, LOOKED_AT_AGAIN = 40, 9, 8, 4
HALVINGS, DIP_CUTS = 40, 8
NEVER, TINY = np.inf, 1e-12


@dataclass(frozen=True)
class Cases:
    """B polygons, already turned and grown, the original's lowest corner at height 0: x and y (B, N).

    Half palms and friction angles (B,); all fingers have one half thickness.
    """

    x: Floats
    y: Floats
    half_palm: Floats
    friction_angle: Floats
    half_thickness: float = 0.0

    def at(self, index: Indices) -> Cases:
        return replace(
            self,
            x=self.x[index],
            y=self.y[index],
            half_palm=self.half_palm[index],
            friction_angle=self.friction_angle[index],
        )

    def lifted(self, height: Floats) -> Cases:
        return replace(self, y=self.y + height[:, None])


def cases(
    polygons: list[Floats],
    orientations: Floats,
    half_palm: Floats,
    friction_angle: Floats,
    half_thickness: float = 0.0,
) -> Cases:
    """Polygons, each (N, 2) counter-clockwise with its own N, turned and set on the ground."""
    grown = [each if half_thickness == 0.0 else rounded(each, half_thickness) for each in polygons]
    most = max(len(each) for each in grown)
    padded = np.stack([np.concatenate([each, np.repeat(each[-1:], most - len(each), axis=0)]) for each in grown])
    c, s = np.cos(orientations)[:, None], np.sin(orientations)[:, None]
    x, y = padded[..., 0] * c - padded[..., 1] * s, padded[..., 0] * s + padded[..., 1] * c
    lowest = np.array([(each @ [si, co]).min() for each, si, co in zip(polygons, s[:, 0], c[:, 0], strict=True)])
    return Cases(x, y - lowest[:, None], half_palm, friction_angle, half_thickness)


def rounded(polygon: Floats, radius: float) -> Floats:
    """A polygon grown by a radius, with corners every two degrees of its arcs."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    normals = np.arctan2(-edges[:, 0], edges[:, 1])
    pieces = []
    for corner, before, after in zip(polygon, np.roll(normals, 1), normals, strict=True):
        turn = np.mod(after - before, 2.0 * np.pi)
        angles = before + turn * np.linspace(0.0, 1.0, int(np.ceil(np.degrees(turn) / 2.0)) + 1)
        pieces.append(corner + radius * np.column_stack([np.cos(angles), np.sin(angles)]))
    return np.concatenate(pieces)


def one_side(x: Floats, y: Floats, half_palm: Floats, psi: Floats) -> tuple[Floats, Floats]:
    """Room (B, S) between polygons and right fingers at angles psi (B, S), and the elevations of the normals there.

    Rays run along x. A ray from a corner that meets the finger ends on the finger's side: the normal is the finger's.
    A ray from the fingertip, or from the base where that is over the polygon's bottom, ends on an edge: the normal is
    the edge's.
    """
    cotangent, tip_x, tip_y = 1.0 / np.tan(psi), half_palm[:, None] + np.cos(psi), np.sin(psi)
    room, elevation = np.full_like(psi, NEVER), np.zeros_like(psi)
    for corner in range(x.shape[1]):
        here = x[:, corner, None], y[:, corner, None]
        after = x[:, (corner + 1) % x.shape[1], None], y[:, (corner + 1) % x.shape[1], None]
        on_finger = half_palm[:, None] + here[1] * cotangent
        to_finger = np.where((here[1] >= -TINY) & (here[1] <= tip_y), on_finger - here[0], NEVER)
        nearer = to_finger < room
        room, elevation = np.where(nearer, to_finger, room), np.where(nearer, psi - 0.5 * np.pi, elevation)
        rise = np.where(after[1] > here[1], after[1] - here[1], np.nan)  # the right boundary climbs
        normal = np.arctan2(here[0] - after[0], rise)
        ends = [(tip_x, tip_y)] + ([(half_palm[:, None], np.zeros_like(psi))] if (y < -TINY).any() else [])
        for end_x, end_y in ends:
            share = (end_y - here[1]) / rise
            to_edge = np.where((share >= 0.0) & (share <= 1.0), end_x - here[0] - share * (after[0] - here[0]), NEVER)
            nearer = to_edge < room
            room, elevation = np.where(nearer, to_edge, room), np.where(nearer, normal, elevation)
    return room, elevation


def both_sides(some: Cases, psi: Floats) -> tuple[Floats, Floats, Floats]:
    """Room (B, S) of both sides together at angles psi (B, S), and the elevations at the right and the left."""
    right, e_right = one_side(some.x, some.y, some.half_palm, psi)
    left, e_left = one_side(-some.x[:, ::-1], some.y[:, ::-1], some.half_palm, psi)
    return right + left, e_right, e_left


def squeeze(some: Cases) -> Floats:
    """First finger angle (B,) without room; inf if there is always room."""
    count = len(some.half_palm)
    room = both_sides(some, np.broadcast_to(PSI, (count, len(PSI))))[0]
    lost = room < 0.0
    first = np.where(lost.any(axis=1), lost.argmax(axis=1), len(PSI))
    least = (room[:, 1:-1] <= room[:, :-2]) & (room[:, 1:-1] <= room[:, 2:]) & (room[:, 1:-1] < 0.5)
    item, node = np.nonzero(least & (np.arange(1, len(PSI) - 1) < first[:, None]))
    last = np.append(PSI, NEVER)[first]
    np.minimum.at(last, item, dip_bottom(some.at(item), PSI[node], PSI[node + 2]))
    caught = np.flatnonzero(np.isfinite(last))
    low = np.append(1e-9, PSI)[np.searchsorted(PSI, last[caught])]
    last[caught] = first_lost(some.at(caught), low, last[caught])
    return last


def first_lost(some: Cases, low: Floats, high: Floats) -> Floats:
    """Where the room is lost between an angle with room and one without."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        lost = both_sides(some, middle[:, None])[0][:, 0] < 0.0
        low, high = np.where(lost, low, middle), np.where(lost, middle, high)
    return high


def dip_bottom(some: Cases, low: Floats, high: Floats) -> Floats:
    """An angle without room in an interval with room at its ends; inf where none is found by cutting up its least room."""
    each, found = np.arange(len(low)), np.full(len(low), NEVER)
    for _ in range(DIP_CUTS if len(low) else 0):
        psi = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, PIECES + 1)
        room = both_sides(some, psi)[0]
        lowest, lost = room.argmin(axis=1), room < 0.0
        found = np.where(lost.any(axis=1), np.minimum(found, psi[each, lost.argmax(axis=1)]), found)
        low, high = psi[each, np.maximum(lowest - 1, 0)], psi[each, np.minimum(lowest + 1, PIECES)]
    return found


def largest_gap(friction_angle: Floats, e_right: Floats, e_left: Floats, on_palm: bool) -> Floats:
    """Largest angle between neighbouring directions of the forces that palm and fingers can exert."""
    middle = [e_right + np.pi, -e_left] + ([np.full_like(e_left, 0.5 * np.pi)] if on_palm else [])
    rays = np.concatenate([np.stack(middle) - friction_angle, np.stack(middle) + friction_angle])
    rays = np.sort(np.mod(rays, 2.0 * np.pi), axis=0)
    return np.concatenate([np.diff(rays, axis=0), rays[:1] + 2.0 * np.pi - rays[-1:]]).max(axis=0)


def margin(some: Cases, on_palm: bool) -> tuple[Floats, Floats, Floats]:
    """180 degrees minus the largest gap (-inf without a squeeze); the finger angle; the sum of the elevations."""
    psi = squeeze(some)
    last = np.pi - np.arcsin(some.half_thickness)  # there a finger's round tip rests on the palm
    caught = np.flatnonzero((psi < last) & (psi > 1e-6))
    value, total = np.full(len(psi), -NEVER), np.full(len(psi), np.nan)
    here = some.at(caught)
    _, e_right, e_left = (each[:, 0] for each in both_sides(here, psi[caught][:, None]))
    value[caught] = np.pi - largest_gap(here.friction_angle, e_right, e_left, on_palm)
    total[caught] = e_right + e_left
    return value, psi, total


def palm_margin(some: Cases) -> Floats:
    """Margin (B,) in rad with the polygon on the palm; at least 0 where it is held."""
    return margin(some, True)[0]


def pinch_margin(some: Cases) -> Floats:
    """Largest margin (B,) in rad met at heights above the palm, or the first that is at least 0.

    Two tips that touch opposite corners are seen as a sum of elevations that changes its sign between two heights
    however close, while the finger angle does not jump. They hold with a margin of twice the friction angle.
    """
    count = len(some.half_palm)
    best = np.full(count, -NEVER)
    item = np.repeat(np.arange(count), HEIGHT_STEPS)
    low = np.tile(np.arange(HEIGHT_STEPS) / HEIGHT_STEPS, count)
    high = low + 1.0 / HEIGHT_STEPS
    for cut in range(HEIGHT_CUTS):
        pieces = 1 if cut == 0 else PIECES
        heights = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, pieces + 1)
        here = some.at(np.repeat(item, pieces + 1)).lifted(heights.ravel())
        value, psi, total = (each.reshape(heights.shape) for each in margin(here, False))
        np.maximum.at(best, item, value.max(axis=1))
        with np.errstate(invalid="ignore"):
            opposed = (total[:, :-1] > 0.0) & (total[:, 1:] < 0.0) & (np.abs(np.diff(psi, axis=1)) < 0.1 / 4.0**cut)
        across = opposed.any(axis=1)
        if cut == HEIGHT_CUTS - 1:
            np.maximum.at(best, item, np.where(across, 2.0 * some.friction_angle[item], -NEVER))
        keep = np.flatnonzero((best[item] < 0.0) & (across | among_best(value.max(axis=1), item)))
        cell = np.where(across, opposed.argmax(axis=1), value.argmax(axis=1))[keep]
        before, after = np.maximum(cell - 1, 0), np.minimum(cell + 1, pieces)
        item, low, high = item[keep], heights[keep, before], heights[keep, after]
    return best


def among_best(value: Floats, item: Indices) -> NDArray[np.bool_]:
    """Whether each value is among the few best, and not the worst possible, of its item."""
    order = np.lexsort((-value, item))
    rank = np.empty(len(order), dtype=np.intp)
    rank[order] = np.arange(len(order)) - np.searchsorted(item[order], item[order])
    return (rank < LOOKED_AT_AGAIN) & np.isfinite(value)
