"""What the slow reference closes on what: hand, object, numerical parameters, and what comes out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Hand:
    """Half the palm, links from the base to the tip, and optionally a table of relative joint angles (k, links).

    A wall (m from the palm at the start) keeps its place; the hand gives way to it, and else goes ahead by
    ``speed`` (m) for each unit of the clock.
    """

    half_palm: float
    links: tuple[float, ...]
    half_thickness: float = 0.0
    crossing: bool = True
    open_angle: float = 0.0
    clock: np.ndarray | None = None
    joints: np.ndarray | None = None
    wall: float = math.inf
    speed: float = 0.0

    def table(self) -> tuple[np.ndarray, np.ndarray]:
        """Clock values (k) and absolute link directions (k, links) of the right finger; straight unless given."""
        if self.clock is None or self.joints is None:
            clock = np.array([0.0, math.pi - self.open_angle])
            return clock, np.repeat(self.open_angle + clock[:, None], len(self.links), axis=1)
        return np.asarray(self.clock, float), np.cumsum(np.asarray(self.joints, float), axis=1)


@dataclass(frozen=True)
class Object:
    """A disk (radius) or a convex polygon (vertices, anticlockwise); support points in its own frame, else uniform."""

    radius: float = 0.0
    vertices: np.ndarray = field(default_factory=lambda: np.zeros((0, 2)))
    points: np.ndarray | None = None
    weights: np.ndarray | None = None


@dataclass(frozen=True)
class Numerics:
    """Steps in radians of finger clock; eps and gaps in finger lengths, forces in units of the table friction."""

    step: float = 1e-3
    eps: float = 1e-4
    stiffness: float = 4e7
    stall: float = 1e3
    rings: int = 8
    weight: float = 0.5
    farthest: float = 5e-4  # displacement of the object in one step
    rounding: float = 1e-4  # of the corners of a polygon
    viscous: float = 1e-4
    stall_step: float = 1e-6
    smallest_step: float = 1e-11
    most_steps: int = 1_000_000


@dataclass(frozen=True)
class Run:
    """Where everything is at the end; events are (time, what, who): a body for touches, else the finger (0 right)."""

    pose: np.ndarray
    clocks: np.ndarray
    states: np.ndarray
    loads: np.ndarray  # normal forces on the palm, the right and the left links, the wall if there is one
    links: np.ndarray  # final segments, same order
    events: list[tuple[float, str, int]]
    path: np.ndarray  # (steps kept, 6): time, x, y, theta, clock of the right and of the left finger
    steps: int
    unsolved: int  # steps accepted without convergence
    rounding: float


def disk_support(radius: float, rings: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights of the uniform pressure on a disk: Gauss in r^2, 4 x rings staggered spokes."""
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    spokes = 4 * rings
    distance = radius * np.sqrt((nodes + 1.0) / 2.0)
    angle = (np.arange(spokes) + np.arange(rings)[:, None] * 0.5) * (2.0 * math.pi / spokes)
    points = np.stack([distance[:, None] * np.cos(angle), distance[:, None] * np.sin(angle)], axis=-1)
    return points.reshape(-1, 2), np.repeat(weights / 2.0 / spokes, spokes)


def polygon_support(vertices: np.ndarray, order: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights of the uniform pressure on a convex polygon: order^2 Gauss points a triangle of a fan."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1.0) / 2.0, weights / 2.0
    hub, after = vertices.mean(axis=0), np.roll(vertices, -1, axis=0)
    first, second = vertices - hub, after - hub
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    rim = (1.0 - nodes)[:, None] * first[:, None, :] + nodes[:, None] * second[:, None, :]
    points = hub + nodes[None, :, None, None] * rim[:, None, :, :]
    shares = area[:, None, None] * (nodes * weights)[None, :, None] * weights[None, None, :]
    return points.reshape(-1, 2), shares.ravel() / shares.sum()


def end_of_travel(lengths: np.ndarray, clock: np.ndarray, directions: np.ndarray, half: float) -> float:
    """First clock at which a link that points inwards brings its end down to the palm line (to half its thickness)."""

    def landed(at: np.ndarray) -> np.ndarray:
        angles = np.stack([np.interp(at, clock, column) for column in directions.T], axis=1)
        return ((np.cumsum(lengths * np.sin(angles), axis=1) <= half) & (angles > math.pi / 2.0)).any(axis=1)

    low, high = float(clock[0]), float(clock[-1])
    for _ in range(3):  # each round narrows the first landing by the number of samples
        at = np.linspace(low, high, 20001)
        down = landed(at)
        if not down.any():
            return float(clock[-1])
        first = int(np.argmax(down))
        low, high = at[max(first - 1, 0)], at[first]
    return float(high)


def core(vertices: np.ndarray, rounding: float) -> np.ndarray:
    """A convex polygon's vertices (anticlockwise) after its edges have moved inwards by the rounding."""
    along = np.roll(vertices, -1, axis=0) - vertices
    along /= np.hypot(*along.T)[:, None]
    out = np.stack([along[:, 1], -along[:, 0]], axis=1)
    before = np.roll(out, 1, axis=0)
    return vertices - rounding * (before + out) / (1.0 + np.sum(before * out, axis=1))[:, None]


def fastest_end(lengths: np.ndarray, clock: np.ndarray, directions: np.ndarray) -> float:
    """A bound on the speed of the links' ends at clock rate 1."""
    rates = np.abs(np.diff(directions, axis=0) / np.diff(clock)[:, None])
    return float((rates @ lengths).max())
