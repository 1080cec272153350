"""The contacts that touch at the state of a closing motion: looked for anew, and freed from the drift of a stride."""

from __future__ import annotations

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_motion import KEPT, LEFT, RIGHT, SEVERAL, THETA, TIME, TOUCHED, Bench, X, Y
from palmar.mechanics.pushing.contact_scan import touching_candidates
from palmar.mechanics.pushing.contact_solve import CONTACT_WIDTH
from palmar.mechanics.pushing.hand_pose import HandMotion, finger_of, place_links, row_count
from palmar.mechanics.pushing.polygon_contacts import Body, Scale, link_of, side_of, write_contact

SWEEPS, MOST_SHIFT = 40, 500.0


@compiled
def look(hand: HandMotion, body: Body, at: Bench, scale: Scale, touch: float) -> tuple[float, int]:
    """Make the contacts that touch at the state the active ones; returns (least gap, their number)."""
    s = at.state
    place_links(hand, s[TIME], s[RIGHT], s[LEFT], at.links)
    least, count = touching_candidates(
        body, at.links, row_count(hand), scale, s[X], s[Y], s[THETA], touch, at.found, at.apart
    )
    changed = False
    for k in range(count):
        changed = changed or at.active[k] != at.found[k]
        at.active[k] = at.found[k]
        at.sides[k] = side_of(body, at.links, at.active[k], s[X], s[Y], s[THETA])
        if finger_of(hand, link_of(at.active[k])) >= 0:
            s[TOUCHED] = 1.0
    if changed:
        s[SEVERAL], s[KEPT] = 0.0, 0.0
    return least, count


@compiled
def without_wall(hand: HandMotion, at: Bench, count: int) -> int:
    """Move the hand's own contacts, which are written, to the front; returns their number."""
    kept = 0
    for k in range(count):
        if link_of(at.active[k]) <= 2 * len(hand.links):
            for j in range(CONTACT_WIDTH):
                at.contacts[kept, j] = at.contacts[k, j]
            kept += 1
    return kept


@compiled
def settle_and_look(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, begins: bool
) -> tuple[float, int]:  # fmt: skip
    """``settle``, unless that drives the object deeper into a link, then ``look``; returns as that.

    ``begins``: a contact has just been located at the stride's end. Where the shift opens its gap again a little, that is
    closed, too.
    """
    s = at.state
    x, y, theta = s[X], s[Y], s[THETA]
    most = settle(hand, body, at, count, scale)
    least, found = look(hand, body, at, scale, scale.touch)
    if least < -4.0 * scale.error - scale.touch:
        shifted = s[X], s[Y], s[THETA]
        s[X], s[Y], s[THETA] = x, y, theta
        before, found = look(hand, body, at, scale, scale.touch)
        if before >= least:
            return before, found
        s[X], s[Y], s[THETA] = shifted
        least, found = look(hand, body, at, scale, scale.touch)
    if begins and most > 0.05 * scale.touch:
        return _close_opened(hand, body, at, scale, scale.touch + 2.0 * most, least, found)
    return least, found


@compiled
def look_again(
    hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale, drifts: bool, begins: bool
) -> tuple[float, int]:  # fmt: skip
    """At a stride's end: ``settle_and_look``, or only ``look`` where contacts did not drift (rest, or an arc)."""
    if drifts:
        return settle_and_look(hand, body, at, count, scale, begins)
    return look(hand, body, at, scale, scale.touch)


@compiled
def _close_opened(
    hand: HandMotion, body: Body, at: Bench, scale: Scale, touch: float, least: float, found: int
) -> tuple[float, int]:
    """Shift the object to all contacts with a gap of up to ``touch``, if that makes more of them touch; as ``look``."""
    s = at.state
    x, y, theta = s[X], s[Y], s[THETA]
    _, more = look(hand, body, at, scale, touch)
    if more == found:
        return least, found
    for k in range(more):
        at.loads[k, 0] = 1.0
    settle(hand, body, at, more, scale)
    after, number = look(hand, body, at, scale, scale.touch)
    if number < more or after < least - scale.touch:
        s[X], s[Y], s[THETA] = x, y, theta
        after, number = look(hand, body, at, scale, scale.touch)
    return after, number


@compiled
def settle(hand: HandMotion, body: Body, at: Bench, count: int, scale: Scale) -> float:
    """Shift the object so that contacts of the last mode have gap zero and the others at least that; largest gap closed."""
    s, square, largest = at.state, body.reach * body.reach, 0.0
    place_links(hand, s[TIME], s[RIGHT], s[LEFT], at.links)
    for _ in range(SWEEPS):
        most = 0.0
        for k in range(count):
            row = at.contacts[k]
            c, sine = cosine_sine(s[THETA])
            gap = write_contact(body, at.links, scale.skin, at.active[k], at.sides[k], s[X], s[Y], c, sine, row)
            if abs(gap) > max(100.0 * scale.error, MOST_SHIFT * scale.touch) or (gap > 0.0 and at.loads[k, 0] == 0.0):
                continue
            lever = row[0] * row[3] - row[1] * row[2]
            shift = -gap / (1.0 + lever * lever / square)
            s[X], s[Y] = s[X] + shift * row[2], s[Y] + shift * row[3]
            s[THETA] += shift * lever / square
            most = max(most, abs(gap))
        largest = max(largest, most)
        if most <= 0.05 * scale.touch:
            break
    return largest
