"""A finger that impacts slow down and whose motor brings it back: one straight link, a torque within a limit.

After an impact the finger turns freely but for its motor, whose constant torque takes it to the commanded rate, which it
then keeps; it ends, and is a wall, where its travel ends, and turns back no farther than its start. Between two of these
changes it accelerates uniformly, so the search for contacts needs no more than the acceleration in its bounds.

A loop that such fingers have shut about the disk may be pried open again. It is shut for good once the energy of disk and
fingers is less than the motors take for every way to open it (``reopening``).
"""

from __future__ import annotations

from math import inf, isnan, sqrt

from palmar.errors import NotCoveredError
from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.capture_state import OWN, PHASE, SPIN, VX, VY, Bench, T, X, Y
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.enclosed import enclosed_for_good, enclosed_now
from palmar.mechanics.impact.finger_motion import ANGLE, FASTER, RATE, SINCE, CaptureHand, begin_finger, turned
from palmar.mechanics.impact.reopening import widest_gap

PRESCRIBED, FREE, ENDED = 0.0, 1.0, 2.0
"""state[OWN + finger]: it moves as the hand prescribes, by itself, or has come to its end."""
AT_STOP = 1e-12
"""Angle (rad) from a stop that is at it."""


def covered(hand: CaptureHand, law: ImpactLaw) -> ImpactLaw:
    """The law with all that a hand's limited motors need.

    Raises NotCoveredError where a finite motor torque, or friction with a finite inertia, is not modelled.
    """
    if law.finger_inertia == inf:
        return law
    if law.friction > 0.0 and hand.half_thickness > 0.0:
        raise NotCoveredError("friction on thick fingers that can be slowed: the tangential impulse would turn them")
    if law.torque != inf:
        rates = hand.rates[hand.rates != 0.0]
        if len(hand.lengths) > 1 or (len(rates) and (rates.min() <= 0.0 or rates.max() > rates.min())):
            raise NotCoveredError("a limited motor torque: only for one straight link a finger and one closing rate")
        if isnan(law.widest):
            size = hand.radius + hand.half_thickness
            return law._replace(widest=widest_gap(hand.half_palm, float(hand.lengths[0]), size))
    return law


@compiled
def commanded(hand: CaptureHand, at: Bench, f: int) -> float:
    """Rate that the programme wants: 0 until the finger first moves, then its closing rate until the end of its travel."""
    rate = 0.0
    for k in range(int(at.state[PHASE]) + 1):
        rate = max(rate, hand.rates[k, f, 0])
    return rate


@compiled
def aim(hand: CaptureHand, law: ImpactLaw, at: Bench, f: int, angle: float, rate: float) -> None:
    """Let finger f go on by itself from this angle and rate, towards the commanded rate."""
    row, wanted = at.fingers[f], commanded(hand, at, f)
    row[SINCE], row[ANGLE], row[RATE] = at.state[T], angle, rate
    row[FASTER] = (1.0 if wanted > rate else (-1.0 if wanted < rate else 0.0)) * law.torque / law.finger_inertia
    at.state[OWN + f] = FREE


@compiled
def _first_root(a: float, b: float, c: float) -> float:
    """Least tau > 0 at which a tau^2 / 2 + b tau = c for c > 0, or for c < 0 with all signs turned; inf if none."""
    if c < 0.0:
        a, b, c = -a, -b, -c
    d = b * b + 2.0 * a * c
    if d < 0.0:
        return inf
    root = sqrt(d)
    if b + root > 0.0:
        return 2.0 * c / (b + root)
    return inf


@compiled
def own_until(hand: CaptureHand, at: Bench, f: int) -> float:
    """Time of finger f's next change, if it goes by itself."""
    if at.state[OWN + f] != FREE:
        return inf
    row, wanted = at.fingers[f], commanded(hand, at, f)
    tau = (wanted - row[RATE]) / row[FASTER] if row[FASTER] != 0.0 else inf
    upper, lower = hand.angles[len(hand.times) - 1, f, 0] - row[ANGLE], hand.angles[0, f, 0] - row[ANGLE]
    if upper > AT_STOP or row[RATE] > 0.0:
        tau = min(tau, _first_root(row[FASTER], row[RATE], max(upper, 0.0)))
    if lower < -AT_STOP or row[RATE] < 0.0:
        tau = min(tau, _first_root(row[FASTER], row[RATE], min(lower, -0.0)) if lower < -AT_STOP else 0.0)
    return row[SINCE] + tau


@compiled
def change_own(hand: CaptureHand, law: ImpactLaw, at: Bench, f: int) -> None:
    """The change whose time has come: finger f ends, is stopped at its start, or has the commanded rate again."""
    angle, rate = turned(at.fingers[f], 0, at.state[T])
    upper, lower = hand.angles[len(hand.times) - 1, f, 0], hand.angles[0, f, 0]
    if angle >= upper - AT_STOP and rate >= 0.0:
        aim(hand, law, at, f, upper, 0.0)
        at.fingers[f, FASTER], at.state[OWN + f] = 0.0, ENDED
    elif angle <= lower + AT_STOP and rate <= 0.0:
        aim(hand, law, at, f, lower, 0.0)
    else:
        aim(hand, law, at, f, angle, commanded(hand, at, f))


@compiled
def slow_down(hand: CaptureHand, law: ImpactLaw, at: Bench, body: int, change: float) -> None:
    """Change the rate of the finger that a body belongs to by an impact."""
    if body > 0 and change != 0.0:
        f = (body - 1) // len(hand.lengths)
        angle, rate = turned(at.fingers[f], 0, at.state[T])
        aim(hand, law, at, f, angle, rate + change)


@compiled
def is_wall(hand: CaptureHand, at: Bench, body: int) -> bool:
    """Whether the body is the palm or a link of a finger at the end of its travel."""
    if body == 0:
        return True
    own = at.state[OWN + (body - 1) // len(hand.lengths)]
    return own == ENDED or (own == PRESCRIBED and at.state[PHASE] == len(hand.times) - 1)


@compiled
def shut(hand: CaptureHand, law: ImpactLaw, at: Bench) -> bool:
    """Take up the phase that has begun; whether the disk is enclosed for good."""
    s = at.state
    for f in range(2):
        if s[OWN + f] == PRESCRIBED:
            begin_finger(hand, int(s[PHASE]), f, at.fingers)
        elif s[OWN + f] == FREE:
            angle, rate = turned(at.fingers[f], 0, s[T])
            aim(hand, law, at, f, angle, rate)
    if law.torque < inf:
        return stays_shut(hand, law, at)
    return enclosed_for_good(hand, at.fingers, s[T], s[X], s[Y], at.chain)


@compiled
def stays_shut(hand: CaptureHand, law: ImpactLaw, at: Bench) -> bool:
    """Whether the disk is in a loop that is shut now and that nothing has the energy to open again (``reopening``)."""
    s, sum_of_angles, energy = at.state, 0.0, 0.0
    for f in range(2):
        angle, rate = turned(at.fingers[f], 0, s[T])
        sum_of_angles += angle
        energy += 0.5 * law.finger_inertia * rate * rate
    if sum_of_angles <= law.widest:
        return False
    energy += 0.5 * law.mass * (s[VX] * s[VX] + s[VY] * s[VY] + 0.5 * hand.radius * hand.radius * s[SPIN] * s[SPIN])
    if energy >= law.torque * (sum_of_angles - law.widest):
        return False
    return enclosed_now(hand, at.fingers, s[T], s[X], s[Y], at.chain)
