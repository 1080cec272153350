"""The facts of a report: closure, the regions where a model covers the case, and strategies for two joints a finger."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.regions.build import build_region
from palmar.regions.region import Region
from palmar.studies.closure import ClosureAnswer, Verdict, closure_answer
from palmar.studies.jointed_closure import JointedClosure, bends, jointed_closure
from palmar.studies.preshape import Preshapes, preshapes
from palmar.studies.strategies import QUICK, Strategy, strategies


@dataclass(frozen=True)
class Closings:
    """How two joints a finger should close: strategies by a quick search, preshapes; ``uncovered``: why there are none."""

    strategies: tuple[Strategy, ...]
    preshapes: Preshapes | None
    uncovered: str | None


@dataclass(frozen=True)
class Report:
    """A case and everything palmar can say about it; ``uncovered`` says why there are no regions.

    ``closure`` is the answer for straight fingers, ``jointed`` that for fingers that bend, where the case is answered so;
    ``closings`` are for fingers of two links, None for others.
    """

    name: str
    case: Case
    closure: ClosureAnswer
    jointed: JointedClosure | None
    regions: tuple[Region, ...]
    uncovered: str | None
    closings: Closings | None

    @property
    def verdict(self) -> Verdict:
        """Whether the hand holds the object, its fingers bending as they need."""
        return (self.jointed or self.closure).object


def report_facts(name: str, case: Case, progress: Callable[[str], None]) -> Report:
    """Compute them, announcing each step."""
    progress("closure")
    closure = closure_answer(case)
    jointed = jointed_closure(case) if bends(case) else None
    regions, uncovered = _regions(case, progress)
    closings = _closings(case, progress) if len(case.hand.finger_links) == 2 else None
    return Report(name, case, closure, jointed, regions, uncovered, closings)


def _regions(case: Case, progress: Callable[[str], None]) -> tuple[tuple[Region, ...], str | None]:
    progress("regions")
    wanted = (Closure.STRUCTURAL, Closure.FRICTIONAL) if case.contact.friction > 0.0 else (Closure.STRUCTURAL,)
    try:
        return tuple(build_region(case, closure=each) for each in wanted), None
    except NotCoveredError as error:
        return (), str(error)


def _closings(case: Case, progress: Callable[[str], None]) -> Closings:
    progress("closing strategies")
    try:
        return Closings(strategies(case, effort=QUICK), preshapes(case), None)
    except NotCoveredError as error:
        return Closings((), None, str(error))
