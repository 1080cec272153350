"""Jams: where a pushed object has no admissible motion, and which finger stalls on it.

A finger without which there is a motion stalls alone. If there is none without the right and none without the left, or
one without either, both stall. (By duality a jam is a set of loads inside the friction cones that balance and on which
the hand does work; stopping one finger only helps if its share of that work was all of it.)
"""

from __future__ import annotations

from math import inf

from palmar.mechanics.pushing.closing_events import STALLS, note, note_touches
from palmar.mechanics.pushing.closing_motion import (
    FENCE,
    LEFT,
    OMEGA,
    RIGHT,
    SEVERAL,
    THETA,
    TIME,
    VX,
    VY,
    Bench,
    X,
    Y,
    continued_twist,
    full_twist,
    to_object,
    write_contacts,
)  # fmt: skip
from palmar.mechanics.pushing.compiled import compiled
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, finger_of
from palmar.mechanics.pushing.polygon_contacts import Body, link_of

JAM = 1e-8
"""A jam is located to this angle (rad)."""


@compiled
def _moves_without(hand: HandMotion, body: Body, at: Bench, count: int, finger: int) -> bool:
    """Whether there is a motion at the contacts written if one finger (2: both) stops."""
    speed = 0.0
    for k in range(count):
        row, owner = at.contacts[k], finger_of(hand, link_of(at.active[k]))
        if owner == finger or (owner >= 0 and finger == 2):
            row[4], row[5] = to_object(at, hand.vx, hand.vy)
        speed = max(speed, abs(row[4]) + abs(row[5]))
    guess = at.state[VX], at.state[VY], at.state[OMEGA]
    return full_twist(body, at, count, speed, guess) > 0


@compiled
def stall(hand: HandMotion, body: Body, at: Bench, count: int, skin: float) -> None:
    """Stop the fingers because of which there is no motion at the pose and time in ``at.trial``."""
    s, t = at.state, at.trial
    stop_right, stop_left = s[RIGHT] == MOVING, s[LEFT] == MOVING
    if stop_right and stop_left:
        write_contacts(hand, body, at, count, skin, t[3], s[RIGHT], s[LEFT], t[0], t[1], t[2])
        without_right = _moves_without(hand, body, at, count, 0)
        write_contacts(hand, body, at, count, skin, t[3], s[RIGHT], s[LEFT], t[0], t[1], t[2])
        without_left = _moves_without(hand, body, at, count, 1)
        if without_right != without_left:
            stop_right, stop_left = without_right, without_left
    note_touches(at, count)
    if stop_right:
        s[RIGHT] = s[TIME]
        note(at, STALLS, 0)
    if stop_left:
        s[LEFT] = s[TIME]
        note(at, STALLS, 1)
    s[VX], s[VY], s[OMEGA], s[SEVERAL], s[FENCE] = 0.0, 0.0, 0.0, 0.0, inf


@compiled
def _probe(hand: HandMotion, body: Body, at: Bench, count: int, skin: float, h: float) -> bool:
    """Whether there is a motion after going on by h with the state's twist."""
    s, t = at.state, at.trial
    x, y, theta, time = s[X] + h * s[VX], s[Y] + h * s[VY], s[THETA] + h * s[OMEGA], s[TIME] + h
    speed = write_contacts(hand, body, at, count, skin, time, s[RIGHT], s[LEFT], x, y, theta)
    if continued_twist(body, at, count, speed, (s[VX], s[VY], s[OMEGA])) > 0:
        return True
    t[0], t[1], t[2], t[3] = x, y, theta, time
    return False


@compiled
def to_the_jam(hand: HandMotion, body: Body, at: Bench, count: int, skin: float) -> bool:
    """Go on to just before the jam that is near and stall there; False if there is none after all."""
    s = at.state
    low, high = 0.0, s[FENCE] - s[TIME]
    if _probe(hand, body, at, count, skin, high):
        s[FENCE] = inf
        return False
    while high - low > JAM:
        middle = 0.5 * (low + high)
        if _probe(hand, body, at, count, skin, middle):
            low = middle
        else:
            high = middle
    s[X], s[Y], s[THETA], s[TIME] = s[X] + low * s[VX], s[Y] + low * s[VY], s[THETA] + low * s[OMEGA], s[TIME] + low
    stall(hand, body, at, count, skin)
    return True
