"""Orientations at which a symmetric grasp of a convex polygon exists (section 2.3, and beyond it).

The polygon keeps its orientation theta and is free to slide; both fingers stand at the same angle psi and close from
fully open until they squeeze it, either resting on the palm or held at any height above it. A grasp exists if the contact
forces can then balance. That is closure against translation only: whether the polygon could turn is another question.

- structural: on the palm, and the three contact normals positively span the plane: e_R + e_L > 0 (two tips on
  parallel edges only balance, the polygon slides out between them);
- frictional at friction angle alpha: on the palm, or pinched at some height above it, with forces in the friction cones.

Limits of friction count as held. A finger that touches with its tip at a corner may push along every normal there.
What is exact is set out in docs/derivations/polygons.md. Line fingers: every answer, to rounding, but for holds beyond
90 deg that only a second crest offers (see polygon_pinch): these may be missed, and where they alone decide, an angle is
good to about 1e-6 rad. Thick fingers: as well, holds above the palm in which a finger's base instead of the finger has a
part are not looked for. All err on the side of no grasp.
"""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import ArrayLike

from palmar.mechanics.closure.orientation_set import IntervalArray, orientation_set
from palmar.mechanics.closure.polygon_friction import friction_needed, presses_down
from palmar.mechanics.closure.polygon_outline import FULL_TURN, RIGHT_ANGLE, Bools, Floats
from palmar.mechanics.closure.polygon_pinch import ANGLE_TOLERANCE, holds_off_palm
from palmar.mechanics.closure.polygon_squeeze import bout, squeeze, squeeze_beyond, touch

SAMPLES = 7560
"""Orientations looked at all round, 0.048 deg apart; an interval or gap narrower than that may be missed."""
MOST_FOR_PAIRS = 40
"""Up to this number of corners the orientations that level or plumb any two of them are looked at too."""
SECTIONS = 8


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
        return held_structurally(outline, theta, half_palm, finger_length, half_thickness)

    return orientation_set(holds, sampled_orientations(outline))


def frictional_orientations(
    vertices: ArrayLike, half_palm: float, finger_length: float, friction_angle: float, half_thickness: float = 0.0
) -> IntervalArray:
    """Orientations theta (rad) at which friction angle alpha in [0, pi/2) (rad) holds a polygon on or off the palm.

    The rest as in `structural_orientations`, whose answer this is at alpha = 0.
    """
    outline = np.asarray(vertices, dtype=np.float64)

    def holds(theta: Floats) -> Bools:
        return held_with_friction(outline, theta, half_palm, finger_length, friction_angle, half_thickness)

    return orientation_set(holds, sampled_orientations(outline))


def held_structurally(
    vertices: ArrayLike, orientations: Floats, half_palm: float, finger_length: float, half_thickness: float = 0.0
) -> Bools:
    """Whether the hand holds the polygon without friction, at each orientation (M,) in rad."""
    at = bout(vertices, orientations, half_palm, finger_length, half_thickness)
    ground = np.zeros(at.size)
    held: Bools = touch(at, np.full(at.size, RIGHT_ANGLE), ground).play >= -at.room
    here = at.at(held)
    held[held] = presses_down(here, squeeze_beyond(here, ground[held]))
    return held


def held_with_friction(
    vertices: ArrayLike,
    orientations: Floats,
    half_palm: float,
    finger_length: float,
    friction_angle: float,
    half_thickness: float = 0.0,
) -> Bools:
    """Whether the hand holds the polygon with friction angle alpha in [0, pi/2) (rad), at each orientation (M,) in rad."""
    if friction_angle == 0.0:
        return held_structurally(vertices, orientations, half_palm, finger_length, half_thickness)
    at = bout(vertices, orientations, half_palm, finger_length, half_thickness)
    ground, alpha = np.zeros(at.size), np.full(at.size, friction_angle)
    palm_psi = squeeze(at, ground)
    held: Bools = friction_needed(at, ground, palm_psi) <= alpha + ANGLE_TOLERANCE
    rest = np.flatnonzero(~held)
    held[rest] = holds_off_palm(at.at(rest), alpha[rest], palm_psi[rest])
    return held


def required_friction_angle(
    vertices: ArrayLike,
    orientations: ArrayLike,
    half_palm: float,
    finger_length: float,
    half_thickness: float = 0.0,
) -> Floats:
    """Least friction angle (rad) that holds the polygon at each orientation (rad), to within 1e-10.

    0 where it is held structurally, or balanced so that any friction holds it; inf where none does. Arguments as in
    `structural_orientations`; the result has the shape of ``orientations``.
    """
    theta = np.asarray(orientations, dtype=np.float64)
    at = bout(vertices, theta.ravel(), half_palm, finger_length, half_thickness)
    palm_psi = squeeze(at, np.zeros(at.size))
    needed = friction_needed(at, np.zeros(at.size), palm_psi)
    needed[needed <= ANGLE_TOLERANCE] = 0.0
    most = np.minimum(needed, RIGHT_ANGLE - 1e-9)
    rest = np.flatnonzero(needed > 0.0)
    rest = rest[holds_off_palm(at.at(rest), most[rest], palm_psi[rest])]
    low, high = np.zeros(len(rest)), most[rest]
    repeated = np.repeat(rest, SECTIONS - 1)
    many = at.at(repeated)
    while len(rest) and (high - low).max() > 0.5 * ANGLE_TOLERANCE:
        step = (high - low) / SECTIONS
        tried = low[:, None] + step[:, None] * np.arange(1, SECTIONS)
        held = holds_off_palm(many, tried.ravel(), palm_psi[repeated]).reshape(tried.shape)
        enough = held.any(axis=1)
        fails = np.where(enough, np.argmax(held, axis=1), SECTIONS - 1)
        low, high = low + step * fails, np.where(enough, low + step * (fails + 1), high)
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
