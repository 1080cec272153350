"""The disks that postures within joint limits hold, asked posture by posture: no stance, tangent or margin is known here.

A posture is a set of joint angles of both fingers alike. Of the disks about (0, y) it touches the one that its links leave
room for. On the palm that disk is held if its contact pushes down or holds by friction; off the palm if there is friction
enough at the contact, or if the room has a peak there: one contact below the middle and one above.
"""

from __future__ import annotations

from math import pi

import numpy as np

from palmar.mechanics.closure.closing_links import LimitedHand

Floats = np.ndarray
HEIGHTS, BEST, ROUNDS, CHILDREN, SHRINK = 81, 12, 40, 40, 0.8


def touched_on_palm(points: Floats, h: float) -> Floats:
    """Radius (N,) of the disk on the palm that a finger through ``points`` (N, n + 1, 2) touches.

    |p - (0, R)| = R + h gives R = (x^2 + y^2 - h^2) / (2 (y + h)) for a point; least over points spaced along the finger.
    """
    shares = np.linspace(0.0, 1.0, 81)[:, None]
    start, step = points[:, :-1, None, :], np.diff(points, axis=1)[:, :, None, :]
    x, y = np.moveaxis((start + shares * step).reshape(len(points), -1, 2), -1, 0)
    y = np.maximum(y, 0.0)
    return ((x**2 + y**2 - h**2) / (2.0 * np.maximum(y + h, 1e-12))).min(axis=1)


def lifted(points: Floats, h: float, heights: Floats) -> tuple[Floats, Floats]:
    """Radius (N, M) of the disk at (0, height) that each finger touches, and its contact's elevation; heights (N, M)."""
    c = np.stack([np.zeros_like(heights), heights], axis=-1)[:, :, None, :]
    start, step = points[:, None, :-1, :], np.diff(points, axis=1)[:, None, :, :]
    along = ((c - start) * step).sum(-1) / (step**2).sum(-1)
    off = start + np.clip(along, 0.0, 1.0)[..., None] * step - c
    far = np.hypot(off[..., 0], off[..., 1])
    at = far.argmin(-1)[..., None]
    x, y = (np.take_along_axis(off[..., i], at, -1)[..., 0] for i in (0, 1))
    return far.min(-1) - h, np.arctan2(y, x)


def placed(hand: LimitedHand, angles: Floats) -> tuple[Floats, np.ndarray]:
    """Joints and tip (N, n + 1, 2) at joint angles (N, n), and which of them palm line, plane and coupling allow."""
    turned = angles.cumsum(axis=1)
    steps = np.stack([np.cos(turned), np.sin(turned)], axis=-1) * np.array(hand.links)[:, None]
    first = np.broadcast_to([hand.half_palm, 0.0], (len(angles), 1, 2))
    points = np.concatenate([first, first + steps.cumsum(axis=1)], axis=1)
    able = (points[..., 1] >= -1e-12).all(-1)
    if not hand.crossing:
        able &= (points[..., 0] >= hand.half_thickness).all(-1)
    if hand.coupling is not None:
        base, bend, ratio = hand.coupling
        able &= angles[:, 1] >= bend + ratio * (angles[:, 0] - base) - 1e-12
    return points, able


def held_by(hand: LimitedHand, angles: Floats) -> tuple[Floats, Floats]:
    """Smallest and largest radius (N,) that each posture (N, n) holds: inf and 0 where it holds none."""
    points, able = placed(hand, angles)
    alpha = hand.friction_angle
    radius = touched_on_palm(points, hand.half_thickness)
    elevation = lifted(points, hand.half_thickness, radius[:, None])[1][:, 0]
    on_palm = (elevation >= -alpha) & (elevation <= pi) & (radius > 0.0)
    heights = np.broadcast_to(np.linspace(0.0, hand.size, HEIGHTS), (len(points), HEIGHTS))
    room, elevations = lifted(points, hand.half_thickness, heights)
    off = (room <= heights) & (room > 0.0)
    held = off & (np.abs(elevations) <= alpha) if alpha else np.zeros_like(off)
    held[:, 1:-1] |= (elevations[:, :-2] <= 0.0) & (elevations[:, 2:] >= 0.0) & off[:, 1:-1]
    every = np.column_stack([np.where(on_palm, radius, np.nan), np.where(held, room, np.nan)])
    every[~able] = np.nan
    return np.nan_to_num(every, nan=np.inf).min(axis=1), np.nan_to_num(every, nan=0.0).max(axis=1)


def scanned(hand: LimitedHand, nodes: int = 61) -> tuple[float, float]:
    """Smallest and largest radius met by a scan over both joint angles of two links."""
    axes = np.meshgrid(*(np.linspace(*limit, nodes) for limit in hand.limits), indexing="ij")
    low, high = held_by(hand, np.stack(axes, axis=-1).reshape(-1, len(hand.links)))
    return float(low.min()), float(high.max())


def climbed(hand: LimitedHand, seed: int, postures: int = 4000) -> float:
    """Largest radius met from random postures of any number of links, the best of which are varied by less and less."""
    chance = np.random.default_rng(seed)
    low, high = np.array(hand.limits).T
    angles = chance.uniform(low, high, (postures, len(low)))
    angles[0] = low
    radii = held_by(hand, angles)[1]
    spread = 0.2
    for _ in range(ROUNDS):
        best = np.argsort(radii)[-BEST:]
        angles, radii = angles[best], radii[best]
        more = np.repeat(angles, CHILDREN, axis=0) + spread * (high - low) * chance.normal(
            size=(BEST * CHILDREN, len(low))
        )
        more = np.clip(more, low, high)
        angles, radii = np.concatenate([angles, more]), np.concatenate([radii, held_by(hand, more)[1]])
        spread *= SHRINK
    return float(radii.max())
