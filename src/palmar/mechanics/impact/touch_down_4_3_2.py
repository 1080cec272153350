"""Touch-down of a finger with full torque, then full counter-torque: section 4.3.2, after Parker.

A finger of inertia I about its joint and torque limit T is to turn by the angle A to the object and arrive at the rate
w1 in the least time. It accelerates at a = T / I up to a switch and decelerates at a from there:

    peak^2 = a A + (w0^2 + w1^2) / 2,    switch after (peak^2 - w0^2) / (2 a),

from the initial rate w0 >= 0. The object is taken to stand still. Functions of arrays broadcast; rad, rad/s, s, N m, kg m^2.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Row = tuple[float, tuple[float, float]]
"""Duration (s) and rates (rad/s) of the right and the left finger."""


class TouchDown(NamedTuple):
    """Where (rad) and when (s) the torque is reversed, when the object is reached, the peak and the arrival rate (rad/s)."""

    switch_angle: Floats
    switch_time: Floats
    time: Floats
    peak: Floats
    arrival: Floats


def touch_down(
    angle: ArrayLike, arrival: ArrayLike, torque: ArrayLike, inertia: ArrayLike, rate: ArrayLike = 0.0
) -> TouchDown:
    """The quickest way to arrive at ``arrival``, from ``rate``, over ``angle`` > 0.

    Where the way is too short to reach ``arrival`` the finger accelerates all along and arrives slower; where it is too
    short to slow down to it there is none, all NaN.
    """
    a, w1, t, i, w0 = _together(angle, arrival, torque, inertia, rate)
    quick = t / i
    peak = np.sqrt(quick * a + 0.5 * (w0**2 + w1**2))
    # Accelerating all along gives w0^2 + 2 a A: less than w1^2 is the most there is.
    end = np.minimum(w1, np.sqrt(w0**2 + 2.0 * quick * a))
    peak = np.where(end < w1, end, peak)
    peak = np.where(peak >= w0, peak, np.nan)
    before, after = (peak**2 - w0**2) / (2.0 * quick), (peak - w0) / quick
    return TouchDown(before, after, after + (peak - end) / quick, peak, np.where(np.isnan(peak), np.nan, end))


def rate_at(
    turned: ArrayLike,
    angle: ArrayLike,
    arrival: ArrayLike,
    torque: ArrayLike,
    inertia: ArrayLike,
    rate: ArrayLike = 0.0,
) -> Floats:
    """Rate (rad/s) when the finger has turned by ``turned``: what it hits an object with that stands nearer by the rest."""
    plan = touch_down(angle, arrival, torque, inertia, rate)
    at, t, i, w0 = _together(turned, torque, inertia, rate)
    speeding = w0**2 + 2.0 * t / i * at
    slowing = plan.peak**2 - 2.0 * t / i * (at - plan.switch_angle)
    return np.sqrt(np.where(at <= plan.switch_angle, speeding, slowing))


def _together(*values: ArrayLike) -> tuple[Floats, ...]:
    return np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in values))


def ramps(angle: float, arrival: float, acceleration: float, most: float, pieces: int) -> list[tuple[float, float]]:
    """(duration, rate) of pieces over ``angle`` from rest to ``arrival``, no faster than ``most``; then on at ``arrival``.

    A motor that turns at ``most`` at best coasts between speeding up and slowing down. Each ramp is as many pieces of
    constant rate, which meet it at their ends. On a way too short to reach ``arrival`` it speeds up all along.
    """
    last = min(arrival, most)
    if angle <= 0.0:
        return [(inf, last)]
    end = min(last, sqrt(2.0 * acceleration * angle))
    peak = min(most, max(sqrt(acceleration * angle + 0.5 * end**2), end))
    up, down = peak**2 / (2.0 * acceleration), (peak**2 - end**2) / (2.0 * acceleration)
    found = _ramp(0.0, peak, acceleration, pieces)
    if angle - up - down > 1e-12 * angle:
        found.append(((angle - up - down) / peak, peak))
    if peak > end:
        found += _ramp(peak, end, acceleration, pieces)
    return [*found, (inf, last)]


def _ramp(before: float, after: float, acceleration: float, pieces: int) -> list[tuple[float, float]]:
    each = abs(after - before) / acceleration / pieces
    return [(each, before + (after - before) * (k + 0.5) / pieces) for k in range(pieces)]


def together(right: list[tuple[float, float]], left: list[tuple[float, float]]) -> list[Row]:
    """Both fingers' pieces as one programme; each ends with an endless piece."""
    rows: list[Row] = []
    (a, one), (b, other) = right[0], left[0]
    i = j = 0
    while True:
        part = min(a, b)
        if part > 0.0:
            rows.append((part, (one, other)))
        if part == inf:
            return rows
        a, b = a - part, b - part
        if a <= 0.0:
            i += 1
            a, one = right[i]
        if b <= 0.0:
            j += 1
            b, other = left[j]
