"""When a straight finger that turns about its fixed base joint first touches an object at rest, in closed form.

Seen from the joint (mirrored for the left finger, which so turns to the left as well), a point at the angle beta and the
distance d is the farther from a link of length L the larger delta = |beta - psi| is. So a vertex comes within e of the
link, which nears it from the right, at psi = beta - delta, where

    sin delta = e / d  if d^2 <= L^2 + e^2,   else  cos delta = (d^2 + L^2 - e^2) / (2 d L)  (the vertex is off the tip),

and the tip comes within e of an edge of the outward normal (cos mu, sin mu), at the distance b from the joint, at
psi = mu + arccos((b + e) / L), if the tip is then beside the edge. A look-out in steps that are sure to pass nothing takes
fifteen poses for the same.
"""

from __future__ import annotations

from math import acos, asin, atan2, inf, pi, sqrt

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled, inlined
from palmar.mechanics.pushing.closing_motion import LEFT, RIGHT, THETA, TIME, Bench, X, Y
from palmar.mechanics.pushing.hand_pose import MOVING, HandMotion, stands
from palmar.mechanics.pushing.polygon_contacts import Body, link_of


@inlined
def in_flight(hand: HandMotion, at: Bench, count: int) -> bool:
    """Whether the object rests in the stride whose stages are filled, on links at rest, before fingers of that kind."""
    rests = len(hand.links) == 1 and stands(hand) and at.pivot[0] == 0.0
    for finger in range(2):  # else time is not the base angle
        rests = rests and hand.offsets[finger, 0] == 0.0 and hand.ratios[finger, 0] == 0.0
    for j in range(3):
        rests = rests and at.stages[0, j] == 0.0 and at.stages[6, j] == 0.0
    for k in range(count):
        rests = rests and at.links[link_of(at.active[k]), 4] == 0.0
    return rests


@compiled
def turn_to_touch(hand: HandMotion, body: Body, at: Bench, within: float) -> float:
    """Turn (rad) of the fingers until one comes within ``within`` (m) of the object at the state; inf if none does."""
    s, least = at.state, inf
    if s[RIGHT] == MOVING:
        least = _turn_of_finger(hand, body, at, within, 1.0)
    if s[LEFT] == MOVING:
        least = min(least, _turn_of_finger(hand, body, at, within, -1.0))
    return least


@inlined
def _turn_of_finger(hand: HandMotion, body: Body, at: Bench, within: float, side: float) -> float:
    """``turn_to_touch`` of the right finger (``side`` 1) or the left one (-1)."""
    s, length, least = at.state, hand.links[0], inf
    c, sine = cosine_sine(s[THETA])
    near = length * length + within * within
    for i in range(len(body.vertices)):
        vx, vy = body.vertices[i, 0], body.vertices[i, 1]
        px, py = side * (s[X] + c * vx - sine * vy) - hand.half_palm, s[Y] + sine * vx + c * vy
        square = px * px + py * py
        if within * within < square < (length + within) * (length + within):
            d = sqrt(square)
            apart = (
                asin(within / d)
                if square <= near
                else acos((square + length * length - within * within) / (2.0 * d * length))
            )
            least = min(least, _turn_to(atan2(py, px) - apart, s[TIME]))
        if len(body.vertices) > 1:
            ex, ey = body.edges[i, 0], body.edges[i, 1]
            ex, ey = side * (c * ex - sine * ey), sine * ex + c * ey
            nx, ny = side * ey, -side * ex
            off = (nx * px + ny * py + within) / length
            if -1.0 < off < 1.0:
                rest = sqrt(1.0 - off * off)
                tx, ty = off * nx - rest * ny, off * ny + rest * nx
                along = (length * tx - px) * ex + (length * ty - py) * ey
                if 0.0 < along < body.edges[i, 2]:
                    least = min(least, _turn_to(atan2(ty, tx), s[TIME]))
    return least


@inlined
def _turn_to(angle: float, now: float) -> float:
    """Turn to the left from the angle ``now`` to another."""
    turn = angle - now
    return turn if turn >= 0.0 else turn + 2.0 * pi
