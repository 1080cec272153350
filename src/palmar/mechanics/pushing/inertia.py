"""What quasi-static motion neglects: inertia against the friction of the table, which is mass times mu_t g.

The finger turns at omega; speeds v and accelerations a of the object's centre are given per radian and per radian squared
of finger (m), so that they become omega v and omega^2 a. The object's mass cancels. Derived in docs/assumptions.md.
"""

from __future__ import annotations

from math import inf, sqrt

GRAVITY = 9.81
"""m/s^2."""


def inertia_ratio(rate: float, acceleration: float, table_friction: float) -> float:
    """Inertial force over the table's friction, omega^2 a / (mu_t g): also the turn (rad) of the sliding direction."""
    return rate**2 * acceleration / (table_friction * GRAVITY) if table_friction > 0.0 else inf


def coasting(rate: float, speed: float, table_friction: float) -> float:
    """Distance (m) an object slides on once it is no longer pushed, (omega v)^2 / (2 mu_t g)."""
    return (rate * speed) ** 2 / (2.0 * table_friction * GRAVITY) if table_friction > 0.0 else inf


def drift(rate: float, begin: float, end: float, rho: float, table_friction: float) -> float:
    """Distance (m) by which inertia carries a disk farther out along a link than it would go slowly.

    From contact at distance ``begin`` of the joint to ``end``, gaining rho = R + h per radian:
    omega^2 (end^3 - begin^3) / (3 rho mu_t g). Frictionless fingers; friction at them takes over part of it.
    """
    if table_friction == 0.0:
        return inf
    return rate**2 * (end**3 - begin**3) / (3.0 * rho * table_friction * GRAVITY)


def rate_for(value: float, allowed: float, rate: float) -> float:
    """The finger rate at which a number that grows with its square, ``value`` at ``rate``, reaches what is allowed."""
    return rate * sqrt(allowed / value) if value > 0.0 else inf
