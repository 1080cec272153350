"""Orientations at which a symmetric grasp of a convex polygon exists (section 2.3, and beyond it).

The polygon keeps its orientation theta and is free to slide; both fingers stand at the same angle psi and close from
fully open until they squeeze it, either resting on the palm or held at any height above it. A grasp exists if the contact
forces can then balance. That is closure against translation only: whether the polygon could turn is another question.

- structural: on the palm, and the three contact normals positively span the plane: e_R + e_L > 0 (two tips on
  parallel edges only balance, the polygon slides out between them);
- frictional at friction angle alpha: on the palm, or pinched at some height above it, with forces in the friction cones.

Limits of friction count as held. A finger that touches with its tip at a corner may push along every normal there.
What is exact is set out in docs/derivations/polygons.md. Line fingers: everything but holds that only a second crest
offers (see polygon_pinch), which may be missed. Thick fingers: as well, holds above the palm that a finger's base,
instead of the finger, has a part in are not looked for. Both err on the side of no grasp.
"""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import ArrayLike

from palmar.mechanics.closure.orientation_set import IntervalArray, orientation_set
from palmar.mechanics.closure.polygon_friction import friction_needed, presses_down
from palmar.mechanics.closure.polygon_outline import FULL_TURN, RIGHT_ANGLE, Bools, Floats
from palmar.mechanics.closure.polygon_pinch import ANGLE_TOLERANCE, holds_off_palm
from palmar.mechanics.closure.polygon_squeeze import Bout, bout, touch

SAMPLES = 7560
"""Orientations looked at all round, 0.048 deg apart; an interval or gap narrower than that may be missed."""
MOST_FOR_PAIRS = 40
"""Up to this number of corners the orientations that level or plumb any two of them are looked at too."""


def structural_orientations(
    vertices: ArrayLike, half_palm: float, finger_length: float, half_thickness: float = 0.0
) -> IntervalArray:
    """Orientations theta (rad) at which the hand holds a polygon on its palm without friction.

    The polygon, (N, 2) counter-clockwise and convex, is turned by theta about any point. Lengths in m; half_thickness
    is that of the finger capsules. Returns sorted closed intervals (K, 2), see `orientation_set`: ends to 1e-10 rad,
    single orientations as intervals of no length, intervals narrower than 0.048 deg may be missed unless they contain
    an orientation at which an edge (or, up to 40 corners, the line through any two corners) is level or plumb.
    """
    outline = np.asarray(vertices, dtype=np.float64)

    def holds(theta: Floats) -> Bools:
        return _structural(bout(outline, theta, half_palm, finger_length, half_thickness))

    return orientation_set(holds, sampled_orientations(outline))


def frictional_orientations(
    vertices: ArrayLike, half_palm: float, finger_length: float, friction_angle: float, half_thickness: float = 0.0
) -> IntervalArray:
    """Orientations theta (rad) at which friction angle alpha in [0, pi/2) (rad) holds a polygon on or off the palm.

    The rest as in `structural_orientations`, whose answer this is at alpha = 0.
    """
    outline = np.asarray(vertices, dtype=np.float64)

    def holds(theta: Floats) -> Bools:
        at = bout(outline, theta, half_palm, finger_length, half_thickness)
        return _frictional(at, np.full(at.size, friction_angle))

    return orientation_set(holds, sampled_orientations(outline))


def required_friction_angle(
    vertices: ArrayLike,
    orientations: ArrayLike,
    half_palm: float,
    finger_length: float,
    half_thickness: float = 0.0,
) -> Floats:
    """Least friction angle (rad) that holds the polygon at each orientation (rad), to within 1e-10.

    0 where it is held structurally, inf where no friction holds it. Arguments as in `structural_orientations`; the
    result has the shape of ``orientations``.
    """
    theta = np.asarray(orientations, dtype=np.float64)
    at = bout(vertices, theta.ravel(), half_palm, finger_length, half_thickness)
    needed = np.where(_structural(at), 0.0, np.inf)
    most = RIGHT_ANGLE - 1e-9
    rest = np.flatnonzero(np.isinf(needed))
    rest = rest[_frictional(at.at(rest), np.full(len(rest), most))]
    low, high = np.zeros(len(rest)), np.full(len(rest), most)
    while len(rest) and (high - low).max() > 0.5 * ANGLE_TOLERANCE:
        middle = 0.5 * (low + high)
        held = _frictional(at.at(rest), middle)
        low, high = np.where(held, low, middle), np.where(held, middle, high)
    needed[rest] = high
    return needed.reshape(theta.shape)


def sampled_orientations(outline: Floats) -> Floats:
    """Orientations in [0, 2 pi) (rad): uniform ones, and those at which edges, or pairs of corners, are level or plumb."""
    first, second = np.triu_indices(len(outline), 1)
    if len(outline) > MOST_FOR_PAIRS:
        first = np.arange(len(outline))
        second = (first + 1) % len(outline)
    along = outline[second] - outline[first]
    quarter = -np.arctan2(along[:, 1], along[:, 0])[:, None] + RIGHT_ANGLE * np.arange(4)
    critical = np.mod(quarter.ravel(), FULL_TURN)
    uniform = 2.0 * pi * np.arange(SAMPLES) / SAMPLES
    return np.concatenate([uniform, critical[critical < FULL_TURN]])


def _structural(at: Bout) -> Bools:
    held: Bools = touch(at, np.full(at.size, RIGHT_ANGLE), np.zeros(at.size)).play >= -at.room
    here = at.at(held)
    held[held] = presses_down(here)
    return held


def _frictional(at: Bout, alpha: Floats) -> Bools:
    held = friction_needed(at, np.zeros(at.size)) <= alpha + ANGLE_TOLERANCE
    rest = np.flatnonzero(~held & (alpha > 0.0))
    held[rest] = holds_off_palm(at.at(rest), alpha[rest])
    return held
