"""The outline of an upright cylinder in a picture, and how it moves with axis and radius.

Seen in plan, along the axis, an outline is a circle (c, r) and what rays do with it. Where the outline is a side of the
cylinder the ray's plan touches the circle: |n . (c - o)| = r with the camera's o and n across the ray. Where it is a rim
the ray meets the rim's plane on the circle: |q - c| = r. The derivation is on the page "The camera's eye".
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan2, hypot, pi

import numpy as np
from numpy.typing import NDArray

from palmar.worlds.cell.camera_model import PinholeCamera

Floats = NDArray[np.float64]
Counts = NDArray[np.int_]


@dataclass(frozen=True)
class Upright:
    """An upright cylinder: axis x, y and radius (m), heights (m) of its lower and its upper rim."""

    x: float
    y: float
    radius: float
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class Outline:
    """Points (n, 3) in the world, the pixels (n, 2) at which they are seen, unit normals (n, 2) out of the body's picture,
    how far (n, 3) out each moves with x, y, radius (px/m), and the piece (n,) it is on.

    Pieces are 0, upper rim; 1, a side; 2, lower rim; 3, the other side.
    """

    points: Floats
    pixels: Floats
    out: Floats
    moves: Floats
    pieces: Counts


def outline(camera: PinholeCamera, body: Upright, spacing: float) -> Outline:
    """About ``spacing`` (px) between its points; the camera is outside of the circle.

    Along it e(u; p) = 0 for the pixel u and p = (x, y, radius), so that u goes out by -(de/dp) / (de/du) dp.
    """
    points, pieces = _points(camera, body, spacing)
    pixels = camera.pixels(points)
    along = np.roll(pixels, -1, axis=0) - np.roll(pixels, 1, axis=0)
    out = np.stack([along[:, 1], -along[:, 0]], axis=1) / np.maximum(np.linalg.norm(along, axis=1), 1e-9)[:, None]
    out *= np.sign(((pixels - pixels.mean(axis=0)) * out).sum())
    more, slopes = off_outline(camera, body, pixels + 0.25 * out)
    less, _ = off_outline(camera, body, pixels - 0.25 * out)
    return Outline(points, pixels, out, -slopes / np.maximum(2.0 * (more - less), 1e-6)[:, None], pieces)


def _points(camera: PinholeCamera, body: Upright, spacing: float) -> tuple[Floats, Counts]:
    """Seen from above a rim's plane its far half bounds the picture of an upper rim, its near half that of a lower one;
    from below it is the other way round.
    """
    east, north = camera.place[0] - body.x, camera.place[1] - body.y
    toward, half = atan2(north, east), acos(min(body.radius / hypot(east, north), 1.0))
    above, over = camera.place[2] > body.high, camera.place[2] > body.low
    upper = (toward + half, toward + 2.0 * pi - half) if above else (toward + half, toward - half)
    lower = (toward - half, toward + half) if over else (toward + 2.0 * pi - half, toward + half)
    corners = [(upper[0], body.high), (upper[1], body.high), (lower[0], body.low), (lower[1], body.low)]
    points: list[Floats] = []
    pieces: list[Counts] = []
    for one, other in zip(corners, (*corners[1:], corners[0]), strict=True):
        share = np.linspace(0.0, 1.0, 9)
        if one[1] == other[1]:
            angle, height = one[0] + share * (other[0] - one[0]), np.full(9, one[1])
        else:
            angle, height = np.full(9, one[0]), one[1] + share * (other[1] - one[1])
        length = _length(camera, _on(body, angle, height))
        at = (np.arange(max(round(length[-1] / spacing), 1)) + 0.5) * length[-1]
        at /= len(at)
        points.append(_on(body, np.interp(at, length, angle), np.interp(at, length, height)))
        pieces.append(np.full(len(at), len(pieces)))
    return np.concatenate(points), np.concatenate(pieces)


def _on(body: Upright, angle: Floats, height: Floats) -> Floats:
    return np.stack([body.x + body.radius * np.cos(angle), body.y + body.radius * np.sin(angle), height], axis=-1)


def _length(camera: PinholeCamera, points: Floats) -> Floats:
    steps = np.linalg.norm(np.diff(camera.pixels(points), axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def off_outline(camera: PinholeCamera, body: Upright, pixels: Floats) -> tuple[Floats, Floats]:
    """How far (n,) in m pixels (n, 2) lie outside of the outline, seen in plan; derivatives (n, 3) by x, y, radius.

    Which of the three equations holds is settled by the height at which the ray passes the axis.
    """
    rays = camera.rays(pixels)
    plan = rays[:, :2]
    to_axis = np.array([body.x, body.y]) - camera.place[:2]
    square = np.maximum((plan**2).sum(axis=1), 1e-12)
    height = camera.place[2] + rays[:, 2] * (plan @ to_axis) / square
    across = np.stack([-plan[:, 1], plan[:, 0]], axis=1) / np.sqrt(square)[:, None]
    beside = across @ to_axis
    side = np.abs(beside) - body.radius
    slope = np.sign(beside)[:, None] * across
    rim = np.where(height > body.high, body.high, body.low)
    level = (height > body.high) | (height < body.low)
    falls = np.where(np.abs(rays[:, 2]) < 1e-9, 1e-9, rays[:, 2])
    met = plan * ((rim - camera.place[2]) / falls)[:, None] - to_axis
    far = np.maximum(np.linalg.norm(met, axis=1), 1e-12)
    off = np.where(level, far - body.radius, side)
    by_axis = np.where(level[:, None], -met / far[:, None], slope)
    return off, np.concatenate([by_axis, np.full((len(off), 1), -1.0)], axis=1)
