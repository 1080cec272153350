"""Where a function that is known at points falls below zero: the secant, kept within a bracket.

The function may jump to a value that says no more than its sign (a link inside an object, no motion at all): such points
narrow the bracket, but no secant is drawn through them.
"""

from __future__ import annotations

from palmar.mechanics.compiled import inlined

EARLY, SURE_AFTER = 2, 7
"""Points up to which the secant is trusted to pass a jump by little, and after which every other one halves the bracket."""
BACK = 0.1
"""Part of the bracket by which to stay before its end where the secant does not."""


@inlined
def next_point(a: float, b: float, x1: float, f1: float, x2: float, f2: float, tried: int) -> float:
    """The point of (a, b) to be tried next; positive at a, negative at b; f1, f2 are the last values that are no jumps."""
    if tried >= SURE_AFTER and tried % 2 == 1:
        return 0.5 * (a + b)
    secant = x1 - f1 * (x1 - x2) / (f1 - f2)
    if a < secant < b:
        return secant
    return b - BACK * (b - a) if secant >= b and tried < EARLY else 0.5 * (a + b)
