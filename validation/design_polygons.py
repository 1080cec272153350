"""Polygons that are only to be held: answers against forces found by linear programming in postures found by bisection.

    python3 dev.py validate design_polygons [BRIEFS [ORIENTATIONS [SEED]]]

Random convex polygons and frictions. Each designed hand is tried at ORIENTATIONS random orientations and frictions of the
brief; a hand a tenth smaller, which fails at some, shows whether both also agree about that. The rival shares nothing with
the closed form: the polygon is set on the palm, or at one of HEIGHTS above it, both fingers are turned until they squeeze
it, and contact forces in the friction cones are sought that balance.
"""

from __future__ import annotations

import sys
from math import atan, pi, tau

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, linprog
from scipy.spatial import ConvexHull

from palmar.mechanics.closure.orientation_set import contains
from palmar.models.design_brief import DesignBrief, Limits, Targets
from palmar.models.hand import Hand
from palmar.studies.design.design import design
from palmar.studies.design.verify import orientations_held

Floats = NDArray[np.float64]
HEIGHTS, ANGLES = 200, 91
NEARLY = 1e-7
"""Two features that touch to so much of the finger both do."""
ROUNDING = 1e-6
"""Added to the friction angle (rad)."""


def random_brief(rng: np.random.Generator) -> DesignBrief:
    """A convex polygon of 3 to 6 corners about 30 mm wide, and a range of friction."""
    points = rng.uniform(-0.03, 0.03, (6, 2))
    corners = points[ConvexHull(points).vertices]
    low = float(rng.uniform(0.1, 0.8))
    targets = Targets(vertices=tuple((float(x), float(y)) for x, y in corners), friction=(low, low + 0.3))
    return DesignBrief(targets=targets, limits=Limits(links=(1,)))


def touching(corners: Floats, base: float, length: float, psi: float) -> tuple[float, list[Floats]]:
    """How far right (m) a polygon may be shifted before the right finger stops it, and the inward normals there then."""
    along = np.array([np.cos(psi), np.sin(psi)])
    inward = np.array([-along[1], along[0]])
    bottom, top = np.array([base, 0.0]), np.array([base, 0.0]) + length * along
    found: list[tuple[float, Floats]] = []
    for x, y in corners:
        if along[1] > 1e-12 and -1e-12 <= y <= top[1] + 1e-12:
            found.append((bottom[0] + y / along[1] * along[0] - x, inward))
    for k in range(len(corners)):
        a, b = corners[k], corners[(k + 1) % len(corners)]
        if b[1] > a[1]:  # counter-clockwise: the right side rises
            normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
            for end in (bottom, top):
                if a[1] <= end[1] <= b[1]:
                    found.append((end[0] - (a[0] + (end[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])), normal))
    if not found:
        return np.inf, []
    least = min(shift for shift, _ in found)
    return least, [normal for shift, normal in found if shift <= least + NEARLY * length]


def balanced(cones: list[Floats], alpha: float) -> bool:
    """Whether forces within alpha of the normals add up to nothing without all being nothing."""
    angles = np.array([np.arctan2(n[1], n[0]) + s * (alpha + ROUNDING) for n in cones for s in (-1.0, 1.0)])
    generators = np.stack([np.cos(angles), np.sin(angles)])
    total = np.vstack([generators, np.ones(len(angles))])
    return bool(linprog(np.zeros(len(angles)), A_eq=total, b_eq=[0.0, 0.0, 1.0]).status == 0)


def rival(vertices: Floats, hand: Hand, theta: float, alpha: float) -> bool:
    """Whether a squeeze at some height balances."""
    c, s = np.cos(theta), np.sin(theta)
    turned = vertices @ np.array([[c, s], [-s, c]])
    turned = turned - [0.0, turned[:, 1].min()]
    mirrored = (turned * [-1.0, 1.0])[::-1]
    d, length = hand.half_palm, hand.finger_length

    for height in np.linspace(0.0, length, HEIGHTS, endpoint=False):
        here, there = turned + np.array([0.0, height]), mirrored + np.array([0.0, height])

        def room(psi: float, here: Floats = here, there: Floats = there) -> float:
            total = touching(here, d, length, psi)[0] + touching(there, d, length, psi)[0]
            return min(total, 10.0)

        rooms = np.array([room(psi) for psi in np.linspace(1e-6, pi - 1e-6, ANGLES)])
        shut = np.flatnonzero((rooms[:-1] > 0.0) & (rooms[1:] <= 0.0))
        if len(shut) == 0:
            continue
        step = (pi - 2e-6) / (ANGLES - 1)
        psi = brentq(room, 1e-6 + step * shut[0], 1e-6 + step * (shut[0] + 1), xtol=1e-13)
        right = touching(here, d, length, psi)[1]
        left = [n * [-1.0, 1.0] for n in touching(there, d, length, psi)[1]]
        if balanced([*right, *left, *([np.array([0.0, 1.0])] if height == 0.0 else [])], alpha):
            return True
    return False


def main(words: list[str]) -> None:
    """A line a brief, and the sums."""
    briefs, orientations, seed = (*map(int, words), *(20, 100, 20261127)[len(words) :])
    rng = np.random.default_rng(seed)
    sums = np.zeros(5, int)
    for k in range(briefs):
        brief = random_brief(rng)
        found = design(brief, 1000, k)
        if found.chosen is None or found.chosen.hand is None:
            print(f"{k}: {found.because}", flush=True)
            continue
        vertices, hand = np.array(brief.targets.vertices), found.chosen.hand
        less = brief.limits.hand(0.9 * hand.half_palm, (0.9 * hand.finger_length,))
        alpha = atan(brief.targets.friction[0])
        row = np.zeros(5, int)
        small = orientations_held(vertices, less, alpha)
        for theta in rng.uniform(0.0, tau, orientations):
            drawn = atan(float(rng.uniform(*brief.targets.friction)))
            row[0] += 1
            row[1] += not rival(vertices, hand, float(theta), drawn)
            held = bool(contains(small, np.array([theta]))[0])
            row[2] += not held
            also = rival(vertices, less, float(theta), alpha)
            row[3:] += (held and not also, also and not held)
        sums += row
        print(f"{k}: {len(vertices)} corners, friction {brief.targets.friction[0]:.2f}: {told(row)}", flush=True)
    print(f"all: {told(sums)}")


def told(counts: NDArray[np.int64]) -> str:
    """The counts in words."""
    return (
        f"{counts[0]} orientations, {counts[1]} not held by the rival; a tenth smaller: {counts[2]} not held, {counts[3]}"
        f" held against the rival, {counts[4]} the other way"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
