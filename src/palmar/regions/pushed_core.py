"""Starts of a polygon that are caught for certain at every orientation, although a finger pushes it on the way.

Only the place of the pressure centre g is followed, not the orientation, so that what holds, holds for all of them.
While one line finger pushes the object, let r be the distance of g along the finger. It grows at r' = s + v_d, with
s <= H the height of g over the finger and v_d the part of its velocity along the finger. Quasi-static velocities are
proportional to the finger's rate, so r' is at most G(r), the largest value over all orientations and contacts
(``advance_bound``). Followed backwards from the angle psi_c at which the fingertips can no longer let the object pass,
the worst case gives a limit r_c(psi): an object whose disk of radius H about g a finger first meets within it stays
below that fingertip, meets no other finger, and is enclosed at psi_c. Derived, with its conditions on palm, tips and
jams, in docs/derivations/exact_region.md.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from math import acos, atan, cos, hypot, pi, radians, sin

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon

from palmar.geometry.planar_set import EMPTY, areal, with_mirror_image
from palmar.mechanics.pushing.advance_bound import Advance, advance_bound
from palmar.mechanics.pushing.slider import Slider

Floats = NDArray[np.float64]
STEP = radians(0.1)
FULL_TURN, TURNS = 2.0 * pi, 2880


@dataclass(frozen=True)
class _Sizes:
    """Half palm D and finger length L; greatest and least distance H and i of the outline from g (m)."""

    half_palm: float
    length: float
    reach: float
    inner: float


def pushed_core(
    half_palm: float, length: float, first: float, last: float, slider: Slider, friction: float
) -> MultiPolygon:
    """Positions (m) of the pressure centre from which straight line fingers catch the object at any orientation.

    The fingers close from ``first`` to ``last`` (rad). Empty where a condition fails: psi_c beyond 180 deg - 2 alpha, the
    object wider than the palm, the cage never closing.
    """
    sizes = _Sizes(half_palm, length, *_extents(slider))
    cosine = (sizes.inner - half_palm) / length
    caged = acos(cosine) if -1.0 < cosine < 1.0 else pi
    if not first < caged < last or caged > pi - 2.0 * atan(friction) or sizes.reach >= half_palm or caged < 0.5 * pi:
        return EMPTY
    psi: Floats = caged - STEP * np.arange(int((caged - first) / STEP) + 1, dtype=np.float64)
    advance = advance_bound(slider, friction, length)
    limit = _limits(sizes, psi, slider, advance)
    least = np.maximum(sizes.reach, _on_palm(sizes, psi))
    fails = np.flatnonzero(limit < least)
    sound = len(psi) if len(fails) == 0 else int(fails[0])
    return _between(sizes, psi, limit, sound, advance.lean)


def _extents(slider: Slider) -> tuple[float, float]:
    """Greatest and least distance (m) of the outline from the pressure centre."""
    corners, rounding = slider.core, slider.rounding
    far = float(np.hypot(corners[:, 0], corners[:, 1]).max()) + rounding
    if len(corners) == 1:
        return far, rounding - hypot(corners[0, 0], corners[0, 1])
    edges = np.roll(corners, -1, axis=0) - corners
    near = (corners[:, 0] * edges[:, 1] - corners[:, 1] * edges[:, 0]) / np.hypot(edges[:, 0], edges[:, 1])
    return far, float(near.min()) + rounding


def _widest(slider: Slider, psi: Floats) -> Floats:
    """The most that the heights of g over both fingers at psi can sum to while both touch, over all orientations (m)."""
    angles = np.linspace(0.0, FULL_TURN, TURNS, endpoint=False)
    normals = np.column_stack([np.cos(angles), np.sin(angles)])
    support = (slider.core @ normals.T).max(axis=0) + slider.rounding
    apart = np.rint((FULL_TURN - 2.0 * psi) / FULL_TURN * TURNS).astype(int)
    twice = np.concatenate([support, support])
    sums = np.array([float((support + twice[turn : turn + TURNS]).max()) for turn in apart % TURNS])
    reach = float(np.hypot(slider.core[:, 0], slider.core[:, 1]).max()) + slider.rounding
    missed: Floats = sums + 2.0 * reach * FULL_TURN / TURNS
    return np.minimum(missed, 2.0 * reach)


def _limits(sizes: _Sizes, psi: Floats, slider: Slider, advance: Advance) -> Floats:
    """r_c at falling ``psi``, from below the tip at the first of them; each step takes the growth of its larger end.

    Beyond 90 deg it is kept so low that the fingers are farther apart at the height of g than both can touch.
    """
    limit = np.full(len(psi), -np.inf)
    ceiling = _clear_of_both(sizes, psi[psi > 0.5 * pi], slider).tolist()
    at, growth = advance.at.tolist(), advance.growth.tolist()
    r = sizes.length - sizes.reach
    for k in range(len(psi)):
        if k < len(ceiling):
            r = min(r, ceiling[k])
        if r <= 0.0:
            break
        limit[k] = r
        r -= STEP * growth[bisect_left(at, r)]
    return limit


def _clear_of_both(sizes: _Sizes, psi: Floats, slider: Slider) -> Floats:
    """The largest r beyond 90 deg at whose height both fingers cannot touch (m)."""
    lean, sine = -np.cos(psi), np.sin(psi)
    found: Floats = ((sizes.half_palm * sine - 0.5 * _widest(slider, psi)) / lean + sizes.inner * lean) / sine
    return found


def _on_palm(sizes: _Sizes, psi: Floats) -> Floats:
    """The largest r of an object that touches palm and finger: y <= H and s between i and H, r = (y - s cos psi)/sin psi."""
    height = np.where(psi <= 0.5 * pi, sizes.inner, sizes.reach)
    found: Floats = (sizes.reach - height * np.cos(psi)) / np.maximum(np.sin(psi), 1e-9)
    return found


def _between(sizes: _Sizes, psi: Floats, limit: Floats, sound: int, lean: float) -> MultiPolygon:
    """What lies within the limits of both fingers.

    Beyond ``sound``, where an object that touches the palm could be farther out than the limit, only starts above the
    palm's reach count, and only while the finger lifts what it pushes.
    """
    d, length, h = sizes.half_palm, sizes.length, sizes.reach
    lifts = psi < 0.5 * pi - lean
    whole = len(psi) if sound == len(psi) or bool(lifts[sound - 1]) else sound
    usable = np.flatnonzero(limit[:whole] > 0.0)
    if len(usable) < 2:
        return EMPTY
    end = int(usable[-1]) + 1
    angles, reach = psi[:end], limit[:end]
    way = np.column_stack(
        [d + reach * np.cos(angles) - h * np.sin(angles), reach * np.sin(angles) + h * np.cos(angles)]
    )
    back = np.array([[d, 0.0], [-d - length, 0.0], [-d - length, way[0, 1]]])
    low = np.array([[d - h * sin(angles[-1]), h * cos(angles[-1])]])
    right = shapely.make_valid(Polygon(np.concatenate([way, low, back])))
    mirrored = shapely.affinity.scale(right, xfact=-1.0, origin=(0.0, 0.0))
    floor = shapely.box(-d - length, h, d + length, 2.0 * length)
    both = areal(shapely.intersection_all([right, mirrored, floor]))
    return with_mirror_image(both)
