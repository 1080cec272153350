"""The numbers of docs/derivations/limit_surface.md: the uniform disk, passes to convergence, numbers of motions.

python3 dev.py validate limit_surface
"""

from __future__ import annotations

from collections import Counter
from math import hypot, pi

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.pushing.contact_solve import solve_contacts, workspace
from palmar.mechanics.pushing.limit_surface import (
    LimitSurface,
    disk_surface,
    polygon_surface,
    sampled_surface,
    secant_metric,
    tangent_metric,
)
from palmar.mechanics.pushing.metric import squared
from palmar.mechanics.pushing.motion_solve import solve_motion, start_metric
from palmar.mechanics.pushing.pressure_cells import disk_cells, polygon_cells
from palmar.mechanics.pushing.uniform_disk import rates, secant_ratio

Floats = NDArray[np.float64]
R = 0.05
BLOCK = np.array([[0.07, 0.045], [-0.07, 0.045], [-0.07, -0.045], [0.07, -0.045]])
SPACE = workspace()


def disk_table() -> None:
    """Force, moment and secant ratio of the uniform disk; where iterating the ratio is repelled."""
    for h in (0.0, 0.25, 0.5, 1.0, 2.0, 4.0):
        force, moment, _ = rates(h, 1.0)
        brute = sum_over_disk(h)
        print(
            f"h {h:4}: F {force * h:.6f}  T/R {moment:.6f}  gamma {secant_ratio(h):.6f}  polar sum off by {brute:.1e}"
        )
    h = np.logspace(-1, 1, 20001)
    slope = np.gradient(np.log([secant_ratio(each) for each in h]), np.log(h))
    print(f"steepest d ln gamma / d ln h: {slope.min():.3f} at h = {h[slope.argmin()]:.3f}")


def sum_over_disk(h: float, n: int = 1500) -> float:
    """Largest difference of force and moment from a sum over n^2 cells."""
    s, t = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) * 2.0 * pi / n)
    x, y, weight = s * np.cos(t), s * np.sin(t), 2.0 * s / n**2
    speed = np.hypot(h - y, x) + 1e-300
    force, moment, _ = rates(h, 1.0)
    pull, turn = float(np.sum(weight * (h - y) / speed)), float(np.sum(weight * (x * x - y * (h - y)) / speed))
    return max(abs(pull - force * h), abs(turn - moment))


def random_contacts(rng: np.random.Generator, count: int) -> Floats:
    """Contacts on a circle, normals within about 30 degrees of it, hands that mostly push."""
    bearing = rng.uniform(0.0, 2.0 * pi, count)
    normal = bearing + pi + 0.5 * rng.normal(size=count)
    u = rng.normal(size=(count, 2)) + np.stack((np.cos(normal), np.sin(normal)), axis=1)
    friction = rng.choice([0.0, 0.2, 0.5, 1.0], count)
    columns = (R * np.cos(bearing), R * np.sin(bearing), np.cos(normal), np.sin(normal), u[:, 0], u[:, 1], friction)
    return np.stack(columns, axis=1)


def passes(surface: LimitSurface, contacts: Floats, tangent: bool) -> int:
    """Ellipsoid problems solved until the motion changes by less than 1e-8; 0 if it jams."""
    x = y = w = 0.0
    for k in range(1, 400):
        metric = start_metric(surface)
        if (x, y, w) != (0.0, 0.0, 0.0):
            metric = (tangent_metric if tangent else secant_metric)(surface, x, y, w)
        found = solve_contacts(metric, contacts, len(contacts), SPACE.trial, SPACE.rows)
        if found == 0:
            return 0
        apart = [squared(metric, row[0] - x, row[1] - y, row[2] - w) for row in SPACE.trial[:found]]
        best = int(np.argmin(apart))
        x, y, w = (float(value) for value in SPACE.trial[best, :3])
        if apart[best] <= 1e-16 * squared(metric, x, y, w):
            return k
    return 400


def main() -> None:
    """Print everything."""
    disk_table()
    surfaces = {
        "uniform disk": disk_surface(R),
        "uniform rectangle": polygon_surface(BLOCK),
        "288 cells": sampled_surface(polygon_cells(BLOCK, 0.0, 8, 36)),
        "ring": sampled_surface(disk_cells(R, np.inf)),
    }
    rng = np.random.default_rng(1)
    for name, surface in surfaces.items():
        for tangent in (True, False):
            taken = [passes(surface, random_contacts(rng, int(rng.integers(1, 3))), tangent) for _ in range(2000)]
            kept = np.array([each for each in taken if each])
            kind = "tangent" if tangent else "secant"
            print(f"{name}, {kind}: mean {kept.mean():.1f}, 99 % {np.quantile(kept, 0.99):.0f}, most {kept.max()}")
    for count in (1, 2, 3, 4):
        numbers = Counter(
            solve_motion(surfaces["uniform disk"], random_contacts(rng, count), count, (0.0, 0.0, 0.0), SPACE)
            for _ in range(3000)
        )
        print(f"{count} contacts, motions found in 3000 problems: {dict(sorted(numbers.items()))}")
    contact = np.array([[1.5 * R, 1.5 * R, 1.0, 0.0, -0.1, 1.0, 3.0]])
    for k in range(solve_motion(surfaces["uniform disk"], contact, 1, (0.0, 0.0, 0.0), SPACE)):
        vx, vy, omega, normal, side = SPACE.motions[k, :5]
        slip = hypot(vx - omega * 1.5 * R + 0.1, vy + omega * 1.5 * R - 1.0)
        print(f"motion ({vx:.3f}, {vy:.3f}, {omega * R:.3f}/R), slip {slip:.3f}, load {normal:.3f}, {side:.3f}")


if __name__ == "__main__":
    main()
