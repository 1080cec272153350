"""How far an answer can be trusted."""

from __future__ import annotations

from enum import Enum


class Guarantee(Enum):
    """Every region carries one of these; the text says what it promises."""

    CLOSED_FORM = "closed_form"
    CERTIFIED = "certified"
    SAMPLED = "sampled"
    CONSTRUCTION = "construction"

    @property
    def meaning(self) -> str:
        """What it promises, in a phrase."""
        return _MEANING[self]


_MEANING = {
    Guarantee.CLOSED_FORM: "proven for the stated model",
    Guarantee.CERTIFIED: "every point verified with an error bound",
    Guarantee.SAMPLED: "simulated at points, spacing stated",
    Guarantee.CONSTRUCTION: "a geometric construction whose soundness is not proven",
}
