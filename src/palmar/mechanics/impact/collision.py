"""One impact of the disk on a wall of the hand (chapter 4, equations 4.5 to 4.7).

The disk's mass m cancels but against the finger's inertia. Along the normal, approach speed w against the wall:
w' = -e w, with the wall's speed that of a finger too heavy to be slowed. A finger of moment of inertia I about its base,
struck at the lever arm X, takes part: the impulse is (1 + e) w m I / (I + m X^2), and the finger loses the rate J X / I.
If its motor restores the rate at once, the disk sees the restitution (e I - m X^2) / (I + m X^2) of a heavy finger;
below 0 it would be hit again at once, and again, until it moves with the wall: 0.

Along the tangent Coulomb's law (Routh; Kane and Levinson): an impulse stops the slip, of the rim of a uniform disk that
is m slip / 3, if that is within mu times the normal impulse, else it is mu times that against the slip, which keeps its
direction. A disk's impulses act through its centre, so the normal impulse does not change the slip, and for a finger
struck on its line the tangential one has no moment about its base: Poisson's and Newton's restitution agree.
"""

from __future__ import annotations

from math import inf, nan
from typing import NamedTuple

from palmar.mechanics.compiled import compiled


class ImpactLaw(NamedTuple):
    """What impacts depend on besides the restitution; kg, kg m^2, N m.

    ``finger_inertia`` about the base joint: inf = too heavy to be slowed. ``torque`` of the motor that brings a slowed
    finger back to its rate: inf = at once. ``widest``: of a hand with such motors, a bound on the sum of both base angles
    (rad) at which the disk finds a gap between the fingers; NaN = to be found (``reopening``).
    """

    mass: float = 1.0
    finger_inertia: float = inf
    torque: float = inf
    friction: float = 0.0
    widest: float = nan


def rod_inertia(mass: float, length: float) -> float:
    """Moment of inertia m L^2 / 3 (kg m^2) of a uniform rod about its end."""
    return mass * length * length / 3.0


@compiled
def effective_restitution(law: ImpactLaw, e: float, arm: float) -> float:
    """Restitution against a finger whose rate is restored at once."""
    heavy = law.mass * arm * arm / law.finger_inertia
    return max((e - heavy) / (1.0 + heavy), 0.0)


@compiled
def after_impact(
    law: ImpactLaw, e: float, radius: float, nx: float, ny: float, wx: float, wy: float, arm: float,
    vx: float, vy: float, spin: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """(velocity (2), spin, change of the finger's rate) after an impact on a wall of velocity (wx, wy)."""
    approach = (wx - vx) * nx + (wy - vy) * ny
    restored = law.torque == inf
    if restored:
        push, change = (1.0 + effective_restitution(law, e, arm)) * approach, 0.0
    else:
        heavy = law.mass * arm * arm / law.finger_inertia
        push = (1.0 + e) * approach / (1.0 + heavy)
        change = push * law.mass * arm / law.finger_inertia
    vx, vy = vx + push * nx, vy + push * ny
    if law.friction > 0.0:
        slip = (vy - wy) * nx - (vx - wx) * ny - spin * radius
        drag = -min(max(slip / 3.0, -law.friction * push), law.friction * push)
        vx, vy, spin = vx - drag * ny, vy + drag * nx, spin - 2.0 * drag / radius
    return vx, vy, spin, change
