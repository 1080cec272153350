"""The twist of an object at a stride's begin: in the mode of the last motion, if no other is possible, else in any mode."""

from __future__ import annotations

from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.closing_jam import UNBEARABLE, most_load
from palmar.mechanics.pushing.closing_motion import (
    FLAGS,
    KEPT,
    OMEGA,
    REST,
    UNKNOWN,
    VX,
    VY,
    Bench,
    full_twist,
    mode_twist,
)  # fmt: skip
from palmar.mechanics.pushing.metric import Triple
from palmar.mechanics.pushing.polygon_contacts import Body

UNSOLVED = 4
"""Flag: the search for a motion did not converge."""


@inlined
def next_twist(body: Body, at: Bench, count: int, speed: float) -> int:
    """Number of admissible motions at the contacts written, the nearest to the last one first; 0 if that is unbearable."""
    s = at.state
    guess = s[VX], s[VY], s[OMEGA]
    at.frame[3] = REST * REST
    if s[KEPT] > 0.0 and kept_twist(body, at, count, speed, guess):
        number = 1
    else:
        at.frame[2] = UNKNOWN
        number = full_twist(body, at, count, speed, guess)
    if number < 0:
        s[FLAGS] = int(s[FLAGS]) | UNSOLVED
    return 0 if count > 1 and most_load(at, count) > UNBEARABLE else max(number, 0)


@compiled
def kept_twist(body: Body, at: Bench, count: int, speed: float, guess: Triple) -> bool:
    """Whether the last motion's mode has an admissible motion at the contacts written, and no other has; see mode_twist.

    Without friction there is never another one. With a single contact there is none on an ellipsoid if a load along its
    normal a, with either limit of friction, opens it: a_n > mu |a_t|.
    """
    if at.edges[0] < 0 or (count > 1 and body.friction > 0.0):
        return False
    moves, margin = mode_twist(body, at, count, speed, guess)
    normal, tangent = at.space.rows[0], at.space.rows[1]
    opens = normal[0] * normal[3] + normal[1] * normal[4] + normal[2] * normal[5]
    drags = normal[0] * tangent[3] + normal[1] * tangent[4] + normal[2] * tangent[5]
    return moves and margin >= 0.0 and opens > body.friction * abs(drags)
