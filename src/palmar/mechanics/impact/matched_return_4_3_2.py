"""A finger used as a paddle for a moving disk: section 4.3.2, after Buehler, Koditschek and Kindlmann, and Wang.

One dimension, along the disk's path: z is its distance from the plane where they are to meet, dz/dt = -v, v > 0 towards
the hand. **Mirror law**: the paddle's reference follows the disk's mirror image, p = -g z. They meet at z = 0 whenever
that is, without a prediction of time, the paddle then moving at g v against the disk; so the impact speed is (1 + g) v
and, from v' = (1 + e) u - e v of a heavy paddle, the disk returns at (e + g (1 + e)) v. g < 0 yields to the disk; at
g = -1 the paddle runs ahead of it at its own speed and they never meet.

**Catching**: a paddle that has matched the disk's velocity where they meet comes to rest over a stroke S, pressing the
disk on all the while: evenly (Wang's quadratic motion) or along a quarter of a sine. Functions broadcast; SI.
"""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def mirror_gain_for_impact(impact_speed: ArrayLike, speed: ArrayLike) -> Floats:
    """g = u / v - 1 for a chosen impact speed u (m/s)."""
    return np.asarray(np.asarray(impact_speed, dtype=float) / np.asarray(speed, dtype=float) - 1.0)


def mirror_gain_for_return(returned: ArrayLike, restitution: ArrayLike) -> Floats:
    """g = (q - e) / (1 + e) for a disk that is to return at q times its speed; q = 0 stops it dead."""
    q, e = np.asarray(returned, dtype=float), np.asarray(restitution, dtype=float)
    return np.asarray((q - e) / (1.0 + e))


class Reference(NamedTuple):
    """Where the paddle is told to be on the disk's path (m) and how fast (m/s), both counted towards the disk."""

    position: Floats
    speed: Floats


def mirror_reference(gain: ArrayLike, distance: ArrayLike, speed: ArrayLike) -> Reference:
    """p = -g z and dp/dt = g v for a disk at the distance z that comes at the speed v."""
    g, z, v = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (gain, distance, speed)))
    return Reference(np.asarray(-g * z), np.asarray(g * v))


class MirrorImpact(NamedTuple):
    """The paddle's speed against the disk, the impact speed, and the speed at which the disk returns (m/s)."""

    paddle: Floats
    impact: Floats
    returned: Floats


def mirror_impact(gain: ArrayLike, speed: ArrayLike, restitution: ArrayLike) -> MirrorImpact:
    """What the mirror law with ``gain`` > -1 comes to; ``returned`` below 0: the disk goes on, slower, behind the paddle."""
    g, v, e = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (gain, speed, restitution)))
    return MirrorImpact(np.asarray(g * v), np.asarray((1.0 + g) * v), np.asarray((e + g * (1.0 + e)) * v))


class Catch(NamedTuple):
    """Time (s) to rest and greatest deceleration (m/s^2); times the disk's mass that is the greatest force."""

    time: Floats
    deceleration: Floats


def quadratic_catch(speed: ArrayLike, stroke: ArrayLike) -> Catch:
    """Even deceleration v^2 / (2 S), to rest after 2 S / v: the least force over a given stroke."""
    v, s = np.asarray(speed, dtype=float), np.asarray(stroke, dtype=float)
    return Catch(2.0 * s / v, v**2 / (2.0 * s))


def sinusoidal_catch(speed: ArrayLike, stroke: ArrayLike) -> Catch:
    """p = S sin(v t / S) for a quarter period: to rest after pi S / (2 v), the deceleration rises to v^2 / S."""
    v, s = np.asarray(speed, dtype=float), np.asarray(stroke, dtype=float)
    return Catch(0.5 * pi * s / v, v**2 / s)


def run_up(speed: ArrayLike, acceleration: ArrayLike) -> Floats:
    """Way (m) that a paddle with this acceleration limit (m/s^2) needs from rest to match the disk: v^2 / (2 a)."""
    v, a = np.asarray(speed, dtype=float), np.asarray(acceleration, dtype=float)
    return np.asarray(v**2 / (2.0 * a))
