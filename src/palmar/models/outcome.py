"""How a closing motion ends."""

from __future__ import annotations

from enum import Enum


class Outcome(Enum):
    """One word per start. Assumption throughout: a finger that stalls stays where it is, it is not driven back."""

    STRUCTURAL = "structural"
    """Held without friction: the normals of the final contacts positively span the plane."""
    FRICTIONAL = "frictional"
    """Held at rest by contact forces inside the friction cones."""
    CAGED = "caged"
    """Enclosed with play: it cannot leave, but nothing presses on it."""
    ESCAPED = "escaped"
    """Touched, then left."""
    MISSED = "missed"
    """Never touched."""
    JAMMED = "jammed"
    """The fingers stalled on it without holding it."""
    INVALID = "invalid"
    """It overlaps the hand at the start."""
    UNDECIDED = "undecided"
    """The bound on events was reached before an end."""

    @property
    def caught(self) -> bool:
        """Whether the object is the hand's at the end."""
        return self in (Outcome.STRUCTURAL, Outcome.FRICTIONAL, Outcome.CAGED)

    @property
    def code(self) -> int:
        """The small integer by which kernels name it."""
        return _CODES[self]

    @classmethod
    def from_code(cls, code: int) -> Outcome:
        """The outcome of a kernel's integer."""
        return _OUTCOMES[code]


_OUTCOMES = tuple(Outcome)
_CODES = {each: number for number, each in enumerate(_OUTCOMES)}
