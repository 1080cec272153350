"""Sustained contact: which contacts hold the disk, how long, and where it goes meanwhile.

One contact holds while its demand is positive; two links hold the centre where their lines, shifted by the clearance,
cross, while both loads N_i / m, from N_1 n_1 + N_2 n_2 = p'', are positive (a line finger against the palm: x = D - R
tan(psi / 2)). Held motion is advanced in steps during which no other gap can close, as in flight, the disk's own
acceleration added to the bound; where a load turns negative or a foot leaves its link is found by bisection.
"""

from __future__ import annotations

from math import hypot, inf, sqrt

from palmar.mechanics.compiled import compiled
from palmar.mechanics.impact.capture_state import (
    MODE,
    ONE,
    SPIN,
    TWO,
    VX,
    VY,
    Bench,
    T,
    X,
    Y,
    held,
)
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.contact_view import BASE, END, PALM, SIDE, demand, gap_at, wall_at
from palmar.mechanics.impact.finger_motion import FASTER, RATE, CaptureHand, Floats, joint_bounds, side_of
from palmar.mechanics.impact.next_contact import (
    GRAZE,
    NOTHING,
    SKIN,
    TOUCH,
    end_view,
    parabola_root,
    side_bound,
    side_view,
)
from palmar.mechanics.impact.sliding import from_link, pivot_by_steps, slide_by_steps, slide_freely, to_link

STRIDE = 0.03
"""Longest step in sustained contact (rad of the fastest link)."""
HALVINGS = 60
LEAST = 1e-15
"""Least step, in times so far or times that a radian takes."""
NEWTON_STEPS = 6


@compiled
def fastest_rate(hand: CaptureHand, fingers: Floats) -> float:
    """Scale of the rates at which links turn now."""
    fastest = 0.0
    for f in range(2):
        fastest = max(fastest, sqrt(abs(fingers[f, FASTER])))
        for j in range(len(hand.lengths)):
            fastest = max(fastest, abs(fingers[f, RATE + j]))
    return fastest


@compiled
def place_between(hand: CaptureHand, at: Bench) -> None:
    """Put the disk where it touches both held contacts, with the velocity that keeps it there."""
    s = at.state
    b1, f1, s1 = held(at, 0)
    b2, f2, s2 = held(at, 1)
    points = f1 != SIDE or f2 != SIDE
    for _ in range(NEWTON_STEPS if points else 2):
        gap1, _ = gap_at(hand, at.fingers, b1, f1, s1, s[T], s[X], s[Y])
        gap2, _ = gap_at(hand, at.fingers, b2, f2, s2, s[T], s[X], s[Y])
        nx, ny, _, _, _ = wall_at(hand, at.fingers, b1, f1, s1, s[T], s[X], s[Y])
        mx, my, _, _, _ = wall_at(hand, at.fingers, b2, f2, s2, s[T], s[X], s[Y])
        det = nx * my - ny * mx
        s[X], s[Y] = s[X] - (gap1 * my - gap2 * ny) / det, s[Y] - (gap2 * nx - gap1 * mx) / det
    move_between(hand, at)


@compiled
def move_between(hand: CaptureHand, at: Bench) -> None:
    """Give the disk the velocity with which both held contacts' gaps stay as they are."""
    s = at.state
    b1, f1, s1 = held(at, 0)
    b2, f2, s2 = held(at, 1)
    nx, ny, wx, wy, _ = wall_at(hand, at.fingers, b1, f1, s1, s[T], s[X], s[Y])
    mx, my, zx, zy, _ = wall_at(hand, at.fingers, b2, f2, s2, s[T], s[X], s[Y])
    w, z, det = nx * wx + ny * wy, mx * zx + my * zy, nx * my - ny * mx
    s[VX], s[VY] = (w * my - z * ny) / det, (z * nx - w * mx) / det


@compiled
def advance_held(hand: CaptureHand, law: ImpactLaw, at: Bench, tau: float, reach: float) -> None:
    """Carry the state through ``tau`` of sustained contact."""
    s, t, n = at.state, at.state[T], len(hand.lengths)
    s[T] = t + tau
    if s[MODE] == TWO:
        place_between(hand, at)
        return
    body, feature, side = held(at, 0)
    f, j = (body - 1) // n, (body - 1) % n
    finger, fastest = at.fingers[f], fastest_rate(hand, at.fingers)
    if feature == END:
        s[X], s[Y], s[VX], s[VY] = pivot_by_steps(hand, finger, f, j, t, tau, fastest, s[X], s[Y], s[VX], s[VY])
        return
    foot, foot1 = to_link(hand, finger, f, j, side, t, s[X], s[Y], s[VX], s[VY])
    if law.friction == 0.0 and finger[FASTER] == 0.0:
        foot, foot1 = slide_freely(hand, finger, j, t, tau, foot, foot1)
    else:
        foot, foot1, spin = slide_by_steps(
            hand, finger, j, side, law.friction, t, tau, foot, foot1, side_of(f) * s[SPIN], fastest, reach
        )
        s[SPIN] = side_of(f) * spin
    s[X], s[Y], s[VX], s[VY] = from_link(hand, finger, f, j, side, t + tau, foot, foot1)


@compiled
def loads(hand: CaptureHand, at: Bench) -> tuple[float, float]:
    """(N / m of the first held contact, of the second; inf without)."""
    s = at.state
    b1, f1, s1 = held(at, 0)
    first = demand(hand, at.fingers, b1, f1, s1, s[T], s[X], s[Y], s[VX], s[VY])
    if s[MODE] == ONE:
        return first, inf
    b2, f2, s2 = held(at, 1)
    second = demand(hand, at.fingers, b2, f2, s2, s[T], s[X], s[Y], s[VX], s[VY])
    nx, ny, _, _, _ = wall_at(hand, at.fingers, b1, f1, s1, s[T], s[X], s[Y])
    mx, my, _, _, _ = wall_at(hand, at.fingers, b2, f2, s2, s[T], s[X], s[Y])
    cosine = nx * mx + ny * my
    square = 1.0 - cosine * cosine
    return (first - cosine * second) / square, (second - cosine * first) / square


@compiled
def foot_within(hand: CaptureHand, body: int, feature: int, foot: float) -> bool:
    """Whether a contact's foot is on its link."""
    if feature != SIDE:
        return True
    if body == PALM:
        return abs(foot) <= hand.half_palm
    return 0.0 <= foot <= hand.lengths[(body - 1) % len(hand.lengths)]


@compiled
def holds(hand: CaptureHand, at: Bench) -> bool:
    """Whether the held contacts still carry load, their feet on their links."""
    s = at.state
    first, second = loads(hand, at)
    if not (first > 0.0 and second > 0.0):
        return False
    for k in range(int(s[MODE])):
        body, feature, side = held(at, k)
        _, foot = gap_at(hand, at.fingers, body, feature, side, s[T], s[X], s[Y])
        if not foot_within(hand, body, feature, foot):
            return False
    return True


@compiled
def _is_held(hand: CaptureHand, at: Bench, body: int, feature: int) -> bool:
    """Whether the contact, or the end that it shares with its neighbour, is one of a held body."""
    n = len(hand.lengths)
    for k in range(int(at.state[MODE])):
        b, what, _ = held(at, k)
        if body == b or (b == PALM and feature == BASE):
            return True
        if b != PALM and body != PALM and (b - 1) // n == (body - 1) // n:
            if feature == END and body == b - 1:
                return True
            if feature == BASE and (b - 1) % n == 0:
                return True
            if what == END and feature == SIDE and body == b + 1:
                return True
    return False


@compiled
def free_step(
    hand: CaptureHand, at: Bench, most: float, pull: float, reach: float
) -> tuple[float, int, int, int]:  # fmt: skip
    """(time in which no other contact begins, body, feature, side); a body other than NOTHING: it begins now."""
    s, n, small = at.state, len(hand.lengths), TOUCH * reach
    x, y, vx, vy, off = s[X], s[Y], s[VX], s[VY], hand.radius + hand.half_thickness
    step, least, speed = most, most / 64.0, hypot(vx, vy) + pull * most
    graze = -GRAZE * speed
    if not _is_held(hand, at, PALM, SIDE):
        up = 1.0 if y > 0.0 else -1.0
        gap = up * y - hand.radius
        if gap <= small and up * vy < graze and gap > -SKIN * reach and abs(x) <= hand.half_palm:
            return 0.0, PALM, SIDE, int(up)
        step = min(step, max(parabola_root(max(gap, 0.0), up * vy, pull), 0.0 if gap > small else least))
    for f in range(2):
        qx, ux = side_of(f) * x - hand.half_palm, side_of(f) * vx
        far = hypot(qx, y)
        if not _is_held(hand, at, 1 + f * n, BASE):
            rate = (qx * ux + y * vy) / far
            if far - off <= small and rate < graze:
                return 0.0, 1 + f * n, BASE, 1
            step = min(step, max(parabola_root(max(far - off, 0.0), rate, pull), 0.0 if far - off > small else least))
        until = s[T] + most - at.fingers[f, 0]
        for j in range(n):
            b = 1 + f * n + j
            if not _is_held(hand, at, b, END):
                apart, rate = end_view(hand, at.fingers[f], j, s[T], qx, y, ux, vy)
                if apart - off <= small and rate < graze:
                    return 0.0, b, END, 1
                bound = pull + joint_bounds(hand, at.fingers[f], j + 1, until)[1]
                clear = parabola_root(max(apart - off, 0.0), rate, bound)
                step = min(step, max(clear, 0.0 if apart - off > small else least))
            if not _is_held(hand, at, b, SIDE):
                w, rate, foot = side_view(hand, at.fingers[f], j, s[T], qx, y, ux, vy)
                up = 1.0 if w > 0.0 else -1.0
                gap, on = up * w - off, 0.0 <= foot <= hand.lengths[j]
                if gap <= small and up * rate < graze and on:
                    return 0.0, b, SIDE, int(up)
                bound = pull + side_bound(hand, at.fingers[f], j, until, far + speed * most, speed)
                clear = parabola_root(abs(gap), up * rate if gap > 0.0 else -up * rate, bound)
                step = min(step, max(clear, 0.0 if gap > small else least))
    return step, NOTHING, SIDE, 1


@compiled
def _go_back(at: Bench, t: float, x: float, y: float, vx: float, vy: float, spin: float) -> None:
    s = at.state
    s[T], s[X], s[Y], s[VX], s[VY], s[SPIN] = t, x, y, vx, vy, spin


@compiled
def follow_held(
    hand: CaptureHand, law: ImpactLaw, at: Bench, until: float, reach: float, most_steps: int
) -> tuple[int, int, int, bool]:
    """Carry sustained contact to its end: (body, feature, side) of a contact that begins, or NOTHING; whether it holds.

    It ends with a new contact, or where it no longer holds (the state is just past that), or at the time ``until``.
    """
    s, fastest = at.state, fastest_rate(hand, at.fingers)
    for _ in range(most_steps):
        if s[T] >= until:
            return NOTHING, SIDE, 1, True
        first, second = loads(hand, at)
        pull = 2.0 * (first + (second if second < inf else 0.0)) + fastest * fastest * hand.radius
        step = min(STRIDE / fastest if fastest > 0.0 else inf, until - s[T])
        step, body, feature, side = free_step(hand, at, step, pull, reach)
        if body != NOTHING:
            return body, feature, side, True
        t, x, y, vx, vy, spin = s[T], s[X], s[Y], s[VX], s[VY], s[SPIN]
        if t + step == t:
            step = LEAST * max(t, 1.0 / fastest if fastest > 0.0 else t)
        advance_held(hand, law, at, step, reach)
        if s[T] >= until - 1e-15 * until:
            s[T] = until
        if not holds(hand, at):
            low, high = 0.0, step
            for _ in range(HALVINGS):
                _go_back(at, t, x, y, vx, vy, spin)
                middle = 0.5 * (low + high)
                advance_held(hand, law, at, middle, reach)
                low, high = (middle, high) if holds(hand, at) else (low, middle)
            _go_back(at, t, x, y, vx, vy, spin)
            advance_held(hand, law, at, max(high, LEAST * max(t, 1.0 / fastest if fastest > 0.0 else t)), reach)
            return NOTHING, SIDE, 1, False
    return NOTHING, SIDE, 1, True
