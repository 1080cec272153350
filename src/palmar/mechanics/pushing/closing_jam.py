"""Jams: where a pushed object has no admissible motion, and which finger stalls on it.

A finger without which there is a motion stalls alone. If there is none without the right and none without the left, or
one without either, both stall. Before a wall the wrist gives way first: an arm that presses the
object against it is halted. (By duality a jam is a set of loads inside the friction cones that balance and on which
the hand does work; stopping one finger only helps if its share of that work was all of it.)

Two contacts without friction that pinch an object turn it ever faster to where they oppose each other: the time left
is t* - t, the rest of the turn goes as sqrt(t* - t), the loads grow without bound. The end of that way, which no stride
can reach, is extrapolated from where the loads are ``PINCHING``.
"""

from __future__ import annotations

from math import inf

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_events import HALTS, STALLS, note, note_touches
from palmar.mechanics.pushing.closing_motion import (
    ARM,
    LEFT,
    OMEGA,
    PINCHED,
    RIGHT,
    SEVERAL,
    THETA,
    TIME,
    VX,
    VY,
    Bench,
    X,
    Y,
    full_twist,
    mode_twist,
    to_object,
    write_contacts,
)  # fmt: skip
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, finger_of
from palmar.mechanics.pushing.polygon_contacts import Body, link_of

PINCHING = 30.0
"""Load, in units of the friction with the table, from which two contacts without friction may be about to pinch."""
UNBEARABLE = 1e6
"""Load, in units of the friction with the table, at which a motion counts as none: cones that just see each other,
as two right-angled corners do at friction 1, let an object creep under loads that no finger bears."""
NEAR_PINCH = 5e-5
"""Time (rad) within which the end of a pinch is extrapolated: right to 1e-5 rad there."""
PROBE = 1e-7


@compiled
def _moves_without(hand: HandMotion, body: Body, at: Bench, count: int, finger: int, bearable: float) -> bool:
    """Whether there is a motion, with bearable loads, at the contacts written if one finger (2: both) stops."""
    speed = 0.0
    for k in range(count):
        row, owner = at.contacts[k], finger_of(hand, link_of(at.active[k]))
        if owner == finger or (owner >= 0 and finger == 2):
            row[4], row[5] = to_object(at, at.links[0, 5], at.links[0, 6])
        speed = max(speed, abs(row[4]) + abs(row[5]))
    guess = at.state[VX], at.state[VY], at.state[OMEGA]
    return full_twist(body, at, count, speed, guess) > 0 and most_load(at, count) <= bearable


@compiled
def most_load(at: Bench, count: int) -> float:
    """The largest normal load of the contacts, in units of the friction with the table."""
    most = 0.0
    for k in range(count):
        most = max(most, at.loads[k, 0])
    return most


@compiled
def stall(hand: HandMotion, body: Body, at: Bench, count: int, skin: float) -> None:
    """Stop what there is no motion because of at the state: before a wall an arm that moves, else the fingers."""
    s, bearable = at.state, PINCHING if at.state[PINCHED] > 0.0 else UNBEARABLE
    if hand.wall < inf and (hand.vx != 0.0 or hand.vy != 0.0) and hand.halt == inf:
        s[ARM], s[SEVERAL] = s[TIME], 0.0
        note(at, HALTS, 0)
        return
    stop_right, stop_left = s[RIGHT] == MOVING, s[LEFT] == MOVING
    if stop_right and stop_left:
        write_contacts(hand, body, at, count, skin, s[TIME], s[RIGHT], s[LEFT], s[X], s[Y], s[THETA])
        without_right = _moves_without(hand, body, at, count, 0, bearable)
        write_contacts(hand, body, at, count, skin, s[TIME], s[RIGHT], s[LEFT], s[X], s[Y], s[THETA])
        without_left = _moves_without(hand, body, at, count, 1, bearable)
        if without_right != without_left:
            stop_right, stop_left = without_right, without_left
    note_touches(at, count)
    if stop_right:
        s[RIGHT] = s[TIME]
        note(at, STALLS, 0)
    if stop_left:
        s[LEFT] = s[TIME]
        note(at, STALLS, 1)
    s[VX], s[VY], s[OMEGA], s[SEVERAL] = 0.0, 0.0, 0.0, 0.0


@compiled
def pinch(hand: HandMotion, body: Body, at: Bench, count: int, skin: float) -> bool:
    """Go on to the end of a pinch without friction if the state, whose twist is known, is near one."""
    s = at.state
    if body.friction > 0.0 or count < 2 or most_load(at, count) < PINCHING:
        return False
    x, y, theta = s[X] + PROBE * s[VX], s[Y] + PROBE * s[VY], s[THETA] + PROBE * s[OMEGA]
    speed = write_contacts(hand, body, at, count, skin, s[TIME] + PROBE, s[RIGHT], s[LEFT], x, y, theta)
    moves, _ = mode_twist(body, at, count, speed, (s[VX], s[VY], s[OMEGA]))
    motion, reach = at.space.motions[0], body.reach
    before = s[VX] ** 2 + s[VY] ** 2 + (reach * s[OMEGA]) ** 2
    growth = (motion[0] ** 2 + motion[1] ** 2 + (reach * motion[2]) ** 2) / before
    left = PROBE * growth / (growth - 1.0)
    if not (moves and growth > 1.0 and left < NEAR_PINCH):
        return False
    s[X], s[Y], s[THETA] = s[X] + 2.0 * left * s[VX], s[Y] + 2.0 * left * s[VY], s[THETA] + 2.0 * left * s[OMEGA]
    s[TIME] += left * (1.0 + 1e-4)
    s[PINCHED] = 1.0
    return True
