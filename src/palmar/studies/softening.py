"""Of section 4.3.2, what a hand can do about an impact by moving: feed the force back, let go, or play the paddle."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, log

import numpy as np

from palmar.mechanics.impact.force_feedback_4_3_2 import (
    characteristic_polynomial,
    gain_limit,
    hammering,
    worst_lag,
)
from palmar.mechanics.impact.impact_force_4_3_2 import triggered_peak
from palmar.mechanics.impact.matched_return_4_3_2 import (
    mirror_gain_for_return,
    mirror_impact,
    quadratic_catch,
    run_up,
    sinusoidal_catch,
)


@dataclass(frozen=True)
class Feedback:
    """Force gain below which the loop is stable (None: any is), the lag (s) that allows the least (None: there is none),
    frequency (rad/s) at the limit; for a ``gain`` asked about the ``growth`` (1/s; above 0 it is unstable) of an
    oscillation and the time (s) in which it doubles.
    """

    gain_limit: float | None
    worst_lag: float | None
    hammering: float | None
    gain: float | None = None
    growth: float | None = None
    doubling: float | None = None


@dataclass(frozen=True)
class LetGo:
    """The drive lets the finger go ``delay`` (s) after the force passed ``threshold`` (N): peak with that and without."""

    threshold: float
    delay: float
    peak: float
    without: float


@dataclass(frozen=True)
class Stop:
    """Bringing a matched disk to rest: time (s), greatest deceleration (m/s^2), greatest force (N)."""

    time: float
    deceleration: float
    force: float


@dataclass(frozen=True)
class Paddle:
    """Mirror gain, the paddle's speed against the disk and the impact's (m/s), the speed at which the disk returns; ways to
    stop a matched one over the stroke, and the run-up (m) to match it.
    """

    mirror_gain: float
    paddle_speed: float
    impact: float
    returned: float
    quadratic: Stop | None = None
    sinusoidal: Stop | None = None
    run_up: float | None = None


def feedback(finger: float, damper: float, stiffness: float, lag: float, gain: float | None) -> Feedback:
    """Of a finger's mass (kg) at the contact, with the contact's damper (N s/m) and stiffness (N/m), the drive's lag (s)."""
    growth, doubling = None, None
    if gain is not None:
        roots = np.roots(characteristic_polynomial(gain, finger, damper, stiffness, lag))
        growth = float(roots.real.max())
        doubling = log(2.0) / growth if growth > 0.0 else None
    limits = (
        gain_limit(finger, damper, stiffness, lag), worst_lag(finger, damper, stiffness),
        hammering(finger, damper, stiffness, lag),
    )  # fmt: skip
    least, worst, beats = (float(each) if np.isfinite(each) else None for each in limits)
    return Feedback(least, worst, beats, gain, growth, doubling)


def letting_go(mass: float, freed: float, speed: float, stiffness: float, threshold: float, delay: float) -> LetGo:
    """Of a disk (``mass``, kg) at ``speed`` (m/s); ``freed``: reduced mass with a finger that nothing drives; no damping."""
    peak, without = (
        float(triggered_peak(mass, freed, speed, stiffness, threshold, each)) for each in (delay, inf)
    )  # fmt: skip
    return LetGo(threshold, delay, peak, without)


def paddle(
    mass: float, speed: float, restitution: float, share: float, stroke: float | None, acceleration: float | None
) -> Paddle:
    """The disk (kg, m/s) is to return at ``share`` of its speed; ``stroke`` (m) and ``acceleration`` (m/s^2) of the arm."""
    gain = float(mirror_gain_for_return(share, restitution))
    struck = mirror_impact(gain, speed, restitution)
    stops: list[Stop | None] = [None, None]
    if stroke is not None:
        ways = (quadratic_catch(speed, stroke), sinusoidal_catch(speed, stroke))
        stops = [Stop(float(time), float(slowing), mass * float(slowing)) for time, slowing in ways]
    return Paddle(
        gain, float(struck.paddle), float(struck.impact), float(struck.returned), stops[0], stops[1],
        None if acceleration is None else float(run_up(speed, acceleration)),
    )  # fmt: skip
