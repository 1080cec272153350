"""Strategy 1 of section 5.3.1: a curl at which a disk in free space does not slide on the turning distal link.

In the frame that turns with the finger, base joint at the origin, proximal link of length L along x, the disk touches the
distal link at X from its joint. The centrifugal force points from the base to the disk's centre; it has no part along the
link if that ray is square to it:

    L cos(delta) + X = 0,    so X <= L and delta > 90 degrees.

The centre is then L sin(delta) - (R + h) beyond the link's line on the base's side, so the force presses the disk on the
link. The proximal link is clear of it as long as the centre is R + h from its line too,

    (R + h) (1 - cos(delta)) <= X sin(delta),    R + h <= X sqrt((L - X) / (L + X)),

which no X satisfies for R + h > 0.3003 L. The balance is unstable: a frictionless disk that is e away along the link goes
as e cosh(psi) with the angle psi that the finger has turned.
"""

from __future__ import annotations

from math import acos, sqrt

from scipy.optimize import brentq

BEST = 0.5 * (sqrt(5.0) - 1.0)
"""X / L at which the clearance X sqrt((L - X) / (L + X)) is largest: the root of X^2 + L X = L^2."""


def centrifugal_angle(proximal: float, along: float) -> float:
    """delta (rad) for a contact at ``along`` = X (m) on the distal link; X <= L."""
    return acos(-along / proximal)


def clearance(proximal: float, along: float) -> float:
    """The largest R + h (m) that is clear of the proximal link."""
    return along * sqrt((proximal - along) / (proximal + along))


def centrifugal_angles(
    proximal: float, distal: float, radius: float, half_thickness: float
) -> tuple[float, float] | None:
    """The least and the largest delta (rad) with a clear disk and a contact on the distal link; None if there is none."""
    size, peak = radius + half_thickness, BEST * proximal
    if size > clearance(proximal, peak):
        return None

    def spare(along: float) -> float:
        return clearance(proximal, along) - size

    low, high = brentq(spare, 0.0, peak), brentq(spare, peak, proximal)
    if low > distal:
        return None
    return centrifugal_angle(proximal, low), centrifugal_angle(proximal, min(high, distal))
