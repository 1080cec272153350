"""The facts of a report: closure and, where a model covers the case, its regions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.regions.build import build_region
from palmar.regions.region import Region
from palmar.studies.closure import ClosureAnswer, closure_answer


@dataclass(frozen=True)
class Report:
    """A case and everything palmar can say about it; ``uncovered`` says why there are no regions."""

    name: str
    case: Case
    closure: ClosureAnswer
    regions: tuple[Region, ...]
    uncovered: str | None


def report_facts(name: str, case: Case, progress: Callable[[str], None]) -> Report:
    """Compute them, announcing each step."""
    progress("closure")
    closure = closure_answer(case)
    progress("regions")
    wanted = (Closure.STRUCTURAL, Closure.FRICTIONAL) if case.contact.friction > 0.0 else (Closure.STRUCTURAL,)
    try:
        regions = tuple(build_region(case, closure=each) for each in wanted)
    except NotCoveredError as error:
        return Report(name, case, closure, (), str(error))
    return Report(name, case, closure, regions, None)
