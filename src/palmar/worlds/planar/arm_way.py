"""How far a hand with resting fingers may slide before an object that does not give way stops it."""

from __future__ import annotations

from palmar.mechanics.pushing.closing_contacts import look
from palmar.mechanics.pushing.closing_motion import LEFT, RIGHT, THETA, TIME, Bench, X, Y, write_contacts
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body, Scale

SHORTEST = 1e-5
"""Least step in finger lengths, so that a hand may slide along the object or leave it."""
APPROACH = 1e-9
"""Share of the speed with which a contact must close to stop the hand."""


def free_way(hand: HandMotion, body: Body, at: Bench, scale: Scale, way: float) -> float:
    """The part (m) of a straight ``way`` (m) that a hand may go; its velocity is the unit vector of the direction.

    No gap closes faster than the hand goes, so steps as long as the least gap never pass a touch. The bench's state is
    that at the begin; its pose moves with the hand.
    """
    s, length = at.state, float(hand.links.sum())
    x, y, done = float(s[X]), float(s[Y]), 0.0
    while True:
        s[X], s[Y] = x - done * hand.vx, y - done * hand.vy
        gap, count = look(hand, body, at, scale, scale.touch)
        if done >= way or (gap <= scale.touch and _is_stopped(hand, body, at, scale, count)):
            return min(done, way)
        done = min(way, done + (gap if gap > scale.touch else SHORTEST * length))


def _is_stopped(hand: HandMotion, body: Body, at: Bench, scale: Scale, count: int) -> bool:
    """Whether a contact would close if the hand went on."""
    s = at.state
    write_contacts(hand, body, at, count, scale.skin, s[TIME], s[RIGHT], s[LEFT], s[X], s[Y], s[THETA])
    return any(row[2] * row[4] + row[3] * row[5] > APPROACH for row in at.contacts[:count])
