"""Limit surface of a disk with uniform pressure, exact.

The disk has radius R; the total friction force is 1 (mu m g = 1), so every point carries 1/(pi R^2) per area. It slides
with velocity v of its centre while it turns at omega. Let w = R |omega| and h = |v| / w, the distance of the centre
of rotation in radii. The power lost to friction is Phi = w D(h), where D(h) is the mean distance of a point at h from
the points of the unit disk. The friction force and moment are its derivatives,

    F = dPhi/d|v| = D'(h),        T = dPhi/d|omega| = R (D - h D').

With k the smaller of h and 1/h, kc^2 = 1 - k^2 and the complete elliptic integrals B, D of modulus k (K = B + D,
E = B + kc^2 D) these are sums of positive terms; far out, where T loses digits, a power series in 1/h is used.
Derived in docs/derivations/limit_surface.md.
"""

from __future__ import annotations

from math import copysign, hypot, pi, sqrt

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.metric import Metric, with_load

FAR = 3.0
"""From this h on the series is used: its terms fall by 1/9."""


@compiled
def integrals_b_d(kc: float) -> tuple[float, float]:
    """Complete elliptic integrals B and D for the complementary modulus kc in (0, 1], by the mean of Gauss.

    B = int cos^2 / Delta and D = int sin^2 / Delta over 0..pi/2 with Delta^2 = cos^2 + kc^2 sin^2.
    """
    a, g = 1.0, kc
    c_over_k = sqrt((1.0 - kc) / (1.0 + kc)) * 0.5  # c_1 / k, from k^2 = (1 - kc)(1 + kc)
    k = sqrt((1.0 - kc) * (1.0 + kc))
    total, weight = 0.5, 1.0
    for _ in range(12):
        a, g = 0.5 * (a + g), sqrt(a * g)
        total += weight * c_over_k * c_over_k
        weight *= 2.0
        c_over_k = k * c_over_k * c_over_k * 0.25 / (0.5 * (a + g))
        if c_over_k < 1e-17:
            break
    whole = pi / (a + g)
    return whole * (1.0 - total), whole * total


@compiled
def rates(v: float, w: float) -> tuple[float, float, float]:
    """(F/v, T/(R w), q) for speed v = |v| and rim speed w = R |omega| (m/s), both >= 0 and not both 0.

    q is the curvature of Phi on (v, w): its second derivatives are q/n^3 times w^2, -v w, v^2, with n^2 = v^2 + w^2.
    """
    if v < w:
        h = v / w
        kc2 = (1.0 - h) * (1.0 + h)
        b, d = integrals_b_d(sqrt(kc2))
        force = 4.0 / (3.0 * pi) * (2.0 * b + kc2 * d) / w
        moment = 4.0 / (9.0 * pi) * ((3.0 - h * h) * b + kc2 * (3.0 - 2.0 * h * h) * d) / w
        return force, moment, 4.0 / (3.0 * pi) * (b + 2.0 * kc2 * d) * (1.0 + h * h) ** 1.5
    k = w / v
    if v >= FAR * w:
        return _far_rates(v, k)
    kc2 = (1.0 - k) * (1.0 + k)
    b, d = integrals_b_d(sqrt(kc2)) if kc2 > 0.0 else (1.0, 1.0)  # D grows like -log kc: kc2 D is 0 at the rim
    force = 4.0 / (3.0 * pi) * (2.0 * b + kc2 * d) / v
    moment = 4.0 / (9.0 * pi) * ((3.0 * k * k - 1.0) * b + kc2 * d) / (k * k * v)
    return force, moment, 4.0 / (3.0 * pi) * (b - kc2 * d) / (k * k) * (1.0 + k * k) ** 1.5


@compiled
def _far_rates(v: float, k: float) -> tuple[float, float, float]:
    """The same for k = 1/h < 1/3, from D(h) = sum a_n h^(1-2n), a_0 = 1, a_(n+1) = a_n (n-1/2)^2 / ((n+1)(n+2))."""
    force, moment, curvature = 1.0, 0.0, 0.0
    a, power = 1.0, 1.0
    for n in range(1, 24):
        a *= (n - 1.5) ** 2 / (n * (n + 1.0))
        moment += 2.0 * n * a * power
        curvature += 2.0 * n * (2.0 * n - 1.0) * a * power
        power *= k * k
        force += (1.0 - 2.0 * n) * a * power
        if power < 1e-18:
            break
    return force / v, moment / v, curvature * (1.0 + k * k) ** 1.5


@compiled
def secant_ratio(h: float) -> float:
    """gamma(h) with wrench parallel to (v, gamma R^2 omega), h = |v| / (R |omega|); falls from 2/3 at 0 to 1/4."""
    force, moment, _ = rates(h, 1.0) if h < 1.0 else rates(1.0, 1.0 / h)
    return moment / force


@compiled
def secant_metric(radius: float, vx: float, vy: float, omega: float) -> Metric:
    """Integral of J^T J / |velocity| over the disk, about its centre; the twist (vx, vy, omega) is not zero."""
    v, w = hypot(vx, vy), radius * abs(omega)
    force, moment, q = rates(v, w)
    near, cross, far = _curvature(radius, v, w, omega, q)
    ex, ey = (vx / v, vy / v) if v > 0.0 else (1.0, 0.0)
    return force + near, 0.0, force + near, cross * ex, cross * ey, moment * radius**2 + far


@compiled
def tangent_metric(radius: float, vx: float, vy: float, omega: float) -> Metric:
    """Hessian of Phi^2 / 2, divided by Phi, about the centre; the twist (vx, vy, omega) is not zero."""
    v, w = hypot(vx, vy), radius * abs(omega)
    force, moment, q = rates(v, w)
    near, cross, far = _curvature(radius, v, w, omega, q)
    ex, ey = (vx / v, vy / v) if v > 0.0 else (1.0, 0.0)
    hessian = (
        near * ex * ex + force * ey * ey, (near - force) * ex * ey, near * ey * ey + force * ex * ex,
        cross * ex, cross * ey, far,
    )  # fmt: skip
    return with_load(hessian, force * vx, force * vy, moment * radius**2 * omega, force * v * v + moment * w * w)


@compiled
def _curvature(radius: float, v: float, w: float, omega: float, q: float) -> tuple[float, float, float]:
    """Second derivatives of Phi along v: by v twice, by v and omega, by omega twice."""
    n = hypot(v, w)
    along, across = w / n, v / n
    return q * along**2 / n, -q * along * across * copysign(radius, omega) / n, q * (across * radius) ** 2 / n
