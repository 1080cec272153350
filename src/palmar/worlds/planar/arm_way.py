"""How far a hand with resting fingers may slide before an object that does not give way stops it."""

from __future__ import annotations

from collections.abc import Callable

from palmar.mechanics.pushing.closing_contacts import look
from palmar.mechanics.pushing.closing_motion import LEFT, RIGHT, THETA, TIME, Bench, X, Y, write_contacts
from palmar.mechanics.pushing.hand_pose import HandMotion
from palmar.mechanics.pushing.polygon_contacts import Body, Scale

SHORTEST = 1e-5
"""Least step in finger lengths, so that a hand may slide along the object or leave it."""
HALVINGS = 40
APPROACH = 1e-9
"""Share of the speed with which a contact must close to stop the hand."""


def free_way(hand: HandMotion, body: Body, at: Bench, scale: Scale, way: float) -> float:
    """The part (m) of a straight ``way`` (m) that a hand may go; its velocity is the unit vector of the direction.

    No gap closes faster than the hand goes, so steps as long as the least gap never pass a touch; a longer one, where the
    gap is tiny, is taken back if it does. The bench's state is that at the begin; its pose moves with the hand.
    """
    s, shortest = at.state, SHORTEST * float(hand.links.sum())
    x, y, done = float(s[X]), float(s[Y]), 0.0

    def gap_at(gone: float) -> tuple[float, int]:
        s[X], s[Y] = x - gone * hand.vx, y - gone * hand.vy
        return look(hand, body, at, scale, scale.touch)

    while done < way:
        gap, count = gap_at(done)
        if gap <= scale.touch and _is_stopped(hand, body, at, scale, count):
            break
        after = min(way, done + max(gap, shortest))
        least = min(gap, 0.0) - scale.touch
        if gap < shortest and gap_at(after)[0] < least:
            return _last_clear(gap_at, done, after, least)
        done = after
    return done


def _last_clear(gap_at: Callable[[float], tuple[float, int]], low: float, high: float, least: float) -> float:
    """The end of the way between ``low`` and ``high`` (m) on which the gap is at least ``least`` (m)."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if gap_at(middle)[0] < least:
            high = middle
        else:
            low = middle
    return low


def _is_stopped(hand: HandMotion, body: Body, at: Bench, scale: Scale, count: int) -> bool:
    """Whether a contact would close if the hand went on."""
    s = at.state
    write_contacts(hand, body, at, count, scale.skin, s[TIME], s[RIGHT], s[LEFT], s[X], s[Y], s[THETA])
    return any(row[2] * row[4] + row[3] * row[5] > APPROACH for row in at.contacts[:count])
