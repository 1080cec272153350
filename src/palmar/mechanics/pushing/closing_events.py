"""Events on an object's way through a closing motion: rows (base angle, kind, link's row in hand_pose or finger).

Touches, leaves and stalls are located as exactly as the motion; sticking and sliding are noted at the stride's end.
"""

from __future__ import annotations

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_motion import LOGGED, TIME, Bench
from palmar.mechanics.pushing.hand_pose import HandMotion, finger_of
from palmar.mechanics.pushing.polygon_contacts import link_of

TOUCHES, LEAVES, STICKS, SLIDES, STALLS, ENDS, HALTS = range(7)


@compiled
def note(at: Bench, kind: int, who: int) -> None:
    """Append an event at the state's time while there is room."""
    row = int(at.state[LOGGED])
    if row < len(at.log):
        at.log[row, 0], at.log[row, 1], at.log[row, 2] = at.state[TIME], kind, who
        at.state[LOGGED] += 1.0


@compiled
def note_modes(at: Bench, count: int) -> None:
    """Log the changes of the links' contacts at the motion just found."""
    for link in range(len(at.modes)):
        mode = 0
        for k in range(count):
            if link_of(at.active[k]) == link:
                normal, bound = at.loads[k, 0], at.contacts[k, 6] * at.loads[k, 0]
                sticks = normal > 0.0 and abs(at.loads[k, 1]) < bound * (1.0 - 1e-9)
                mode = max(mode, 3 if sticks else (2 if normal > 0.0 and bound > 0.0 else 1))
        before, at.modes[link] = at.modes[link], mode
        if before == 0 and mode > 0:
            note(at, TOUCHES, link)
        if before > 0 and mode == 0:
            note(at, LEAVES, link)
        if mode >= 2 and mode != before:
            note(at, STICKS if mode == 3 else SLIDES, link)


@compiled
def note_touches(at: Bench, count: int) -> None:
    """Log the links that have just come to touch where no motion follows."""
    for k in range(count):
        link = link_of(at.active[k])
        if at.modes[link] == 0:
            at.modes[link] = 1
            note(at, TOUCHES, link)


@compiled
def mirror_log(hand: HandMotion, at: Bench) -> None:
    """Exchange right and left in the events."""
    pairs = len(hand.links)
    for k in range(int(at.state[LOGGED])):
        row = at.log[k]
        if row[1] == STALLS:
            row[2] = 1.0 - row[2]
        elif row[1] != ENDS and row[1] != HALTS and finger_of(hand, int(row[2])) >= 0:
            row[2] += -pairs if row[2] > pairs else pairs
