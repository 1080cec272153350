"""Disks a 2-jointed hand can hold: chapter 2 (equations 2.1 to 2.4), with thick, colliding and limited fingers.

Notation: D half palm width, L finger length, h half finger thickness (capsule about the joint line), R disk radius,
rho = R + h (so a thick finger against R is a line against rho), psi finger angle (0 = open), alpha friction angle,
e = elevation of the contact point above the disk's equator, the palm being below.

As the fingers close, the disk that they touch on the palm shrinks: R falls while psi grows, until the finger points
at the disk's centre. A hold is therefore an interval of psi, and its radii are found from the ends of that interval:

- structural: e >= 0, so the fingertip must reach the equator, (D - rho)^2 + R^2 <= L^2, and R <= D - h;
- frictional: e >= -alpha on the palm, |e| <= alpha off it.

The fingers close as far as ``last_angle``: onto the palm, onto each other, or to the joint's limit. They are taken to
open at least to the upright, psi_limits[0] <= pi/2; the sets of held radii are single intervals only then.
Derived in docs/derivations/closure_disk.md; for h = 0 and crossing fingers these are the equations of the source.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.geometry.straight_finger import last_angle

Floats = NDArray[np.float64]
ROUNDING = 1e-14
"""A smallest radius below this share of the finger's length is 0: tips that meet leave no gap."""


@dataclass(frozen=True)
class Radii:
    """Held radii: the closed interval [min, max] (m) per hand, both NaN where the hand holds none.

    The limits are suprema: they count as held. ``min`` is 0 where every smaller disk can be held too.
    """

    min: Floats
    max: Floats

    def holds(self, radius: ArrayLike) -> NDArray[np.bool_]:
        """Whether each radius (m) lies in its interval."""
        values = np.asarray(radius, dtype=float)
        inside: NDArray[np.bool_] = (self.min <= values) & (values <= self.max)
        return inside


def structural_radii(
    half_palm: ArrayLike,
    finger_length: ArrayLike,
    half_thickness: ArrayLike = 0.0,
    *,
    crossing: bool = True,
    psi_limits: tuple[float, float] = (0.0, pi),
) -> Radii:
    """Radii held without friction (m); arguments in m and rad, broadcast against each other (section 2.2.1)."""
    d, length, h = _together(half_palm, finger_length, half_thickness)
    with np.errstate(invalid="ignore", divide="ignore"):
        inner = d - h
        root = np.sqrt(2.0 * length**2 - inner**2)  # equation 2.2
        largest = np.where(inner <= length, inner, 0.5 * (inner + root))
        smallest = np.where(inner <= length, 0.0, 0.5 * (inner - root))
        last = last_angle(d, length, h, crossing, psi_limits[1])
        empty = ~(smallest <= largest) | (largest <= 0.0)
        if np.any(last < pi):
            at_smallest = np.where(inner <= length, pi, np.arctan2(smallest, smallest - inner))
            at_largest = np.where(inner <= length, 0.5 * pi, np.arctan2(largest, largest - inner))
            smallest = np.where(last < at_smallest, np.fmax(smallest, touched_radius(d, length, h, last)), smallest)
            empty |= ~(smallest <= largest) | (last < at_largest) | (last < psi_limits[0])
    return Radii(np.where(empty, np.nan, smallest), np.where(empty, np.nan, largest))


def frictional_radii(
    half_palm: ArrayLike,
    finger_length: ArrayLike,
    friction_angle: ArrayLike,
    half_thickness: ArrayLike = 0.0,
    *,
    crossing: bool = True,
    psi_limits: tuple[float, float] = (0.0, pi),
) -> Radii:
    """Radii held with friction angle alpha in [0, pi/2) (section 2.2.1); at alpha = 0 those held structurally."""
    d, length, alpha, h = _together(half_palm, finger_length, friction_angle, half_thickness)
    first, last = psi_limits[0], last_angle(d, length, h, crossing, psi_limits[1])
    with np.errstate(invalid="ignore", divide="ignore"):
        lower, upper = _on_palm_at_cone_edge(d, length, alpha, h)
        largest = _largest_with_friction(d, length, alpha, h, first, upper)
        smallest = _smallest_with_friction(d, length, alpha, h, last, lower)
        empty = ~(smallest <= largest) | (largest <= 0.0) | (last < np.maximum(0.5 * pi - alpha, first))
    radii = Radii(np.where(empty, np.nan, smallest), np.where(empty, np.nan, largest))
    no_friction = alpha == 0.0
    if not no_friction.any():
        return radii
    structural = structural_radii(d, length, h, crossing=crossing, psi_limits=psi_limits)
    return Radii(np.where(no_friction, structural.min, radii.min), np.where(no_friction, structural.max, radii.max))


def touched_radius(half_palm: ArrayLike, finger_length: ArrayLike, half_thickness: ArrayLike, psi: ArrayLike) -> Floats:
    """Radius (m) of the disk that rests on the palm and touches both fingers at angle psi in (0, pi], never below 0.

    With the finger's interior R = (D sin psi - h) / (1 - cos psi);
    with its tip (x, y) R = (x^2 + y^2 - h^2) / (2 (y + h)).
    """
    d, length, h = _together(half_palm, finger_length, half_thickness)
    cosine, sine = np.cos(psi), np.sin(psi)
    interior = (d * sine - h) / (1.0 - cosine)
    foot = interior * sine - d * cosine
    x, y = d + length * cosine, length * sine
    tip = (x**2 + y**2 - h**2) / (2.0 * (y + h))
    radius = np.where(foot <= length, interior, tip)
    return np.where(radius > ROUNDING * length, radius, 0.0)


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))


def _on_palm_at_cone_edge(d: Floats, length: Floats, alpha: Floats, h: Floats) -> tuple[Floats, Floats]:
    """Radii of disks on the palm that the tip touches at e = -alpha (equation 2.3).

    They solve (D - rho c)^2 + (R - rho s)^2 = L^2. The stable form of the roots is taken,
    since 1 - s -> 0 for large friction.
    """
    c, one_less_s = np.cos(alpha), 1.0 - np.sin(alpha)
    half_b = d * c + h * one_less_s
    constant = d**2 + h**2 - length**2
    q = half_b + np.sqrt(half_b**2 - 2.0 * one_less_s * constant)
    return constant / q - h, q / (2.0 * one_less_s) - h


def _largest_with_friction(d: Floats, length: Floats, alpha: Floats, h: Floats, first: float, upper: Floats) -> Floats:
    """Off the palm the tip touches at e = -alpha, the finger leaning out by alpha (equation 2.1); else on the palm."""
    c, s = np.cos(alpha), np.sin(alpha)
    if first <= 0.0:
        rho = (d + length * s) / c
        return np.where(length * c + rho * s >= rho - h, rho - h, upper)
    psi = np.maximum(0.5 * pi - alpha, first)
    rho = (d + length * np.cos(psi)) / c
    psi_upper = np.arctan2(upper - (upper + h) * s, (upper + h) * c - d)
    limited = (psi_upper < first) & (first >= 0.5 * pi - alpha)
    on_palm = np.where(limited, touched_radius(d, length, h, first), upper)
    return np.where(length * np.sin(psi) + rho * s >= rho - h, rho - h, on_palm)


def _smallest_with_friction(d: Floats, length: Floats, alpha: Floats, h: Floats, last: Floats, lower: Floats) -> Floats:
    """None between tips that meet, else pinched by tips that stay apart, or on the palm below the tips."""
    x, y = d + length * np.cos(last), length * np.sin(last)
    pinched = np.where(x - h > ROUNDING * length, x - h, 0.0)
    reach = length + h
    pointing = (d**2 - reach**2) / (2.0 * reach)  # finger towards the disk's centre (equation 2.4)
    below_cone = alpha < np.arctan2(pointing, d)
    limit = np.where(below_cone, lower, pointing)
    on_palm = np.maximum(limit, 0.0)
    if np.any(last < pi):
        x_limit = np.where(below_cone, (limit + h) * np.cos(alpha) - d, -d)
        y_limit = np.where(below_cone, limit - (limit + h) * np.sin(alpha), limit)
        psi_limit = np.where(limit > 0.0, np.arctan2(y_limit, x_limit), pi)
        on_palm = np.where(last < psi_limit, touched_radius(d, length, h, last), on_palm)
    return np.where((last >= 0.5 * pi) & (pinched <= y), pinched, on_palm)
