"""The facts of a report: closure and, where a model covers the case, its regions."""

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


@dataclass(frozen=True)
class Report:
    """A case and everything palmar can say about it; ``uncovered`` says why there are no regions.

    ``closure`` is the answer for straight fingers, ``jointed`` that for fingers that bend, where the case is answered so.
    """

    name: str
    case: Case
    closure: ClosureAnswer
    jointed: JointedClosure | None
    regions: tuple[Region, ...]
    uncovered: str | None

    @property
    def verdict(self) -> Verdict:
        """Whether the hand holds the object, its fingers bending as they need."""
        return (self.jointed or self.closure).object


def report_facts(name: str, case: Case, progress: Callable[[str], None]) -> Report:
    """Compute them, announcing each step."""
    progress("closure")
    closure = closure_answer(case)
    jointed = jointed_closure(case) if bends(case) else None
    progress("regions")
    wanted = (Closure.STRUCTURAL, Closure.FRICTIONAL) if case.contact.friction > 0.0 else (Closure.STRUCTURAL,)
    try:
        regions = tuple(build_region(case, closure=each) for each in wanted)
    except NotCoveredError as error:
        return Report(name, case, closure, jointed, (), str(error))
    return Report(name, case, closure, jointed, regions, None)
