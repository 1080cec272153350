"""The case at a glance: the drawing, the verdict, and the regions by any models; closed forms first, then the rest."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from palmar.errors import NotCoveredError
from palmar.faces.jointed_record import jointed_record
from palmar.faces.plots.region_picture import VISIBLE
from palmar.faces.records import closure_record, region_facts, region_sets
from palmar.faces.region_records import answers_record
from palmar.faces.studio.answers.drawing import MM, drawing, shown
from palmar.faces.studio.answers.library import case_value
from palmar.faces.studio.answers.part import Part, Question, Stage
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.models.quantity import Value
from palmar.models.support import SupportKind
from palmar.regions.build import build_region, takes_milliseconds
from palmar.regions.region import Model, Region
from palmar.studies.behaviour_region import behaviour_region
from palmar.studies.closure import closure_answer, closure_verdict
from palmar.studies.jointed_closure import (
    JointedClosure,
    bends,
    bends_in_closed_form,
    jointed_closure,
    jointed_verdict,
)
from palmar.studies.region_questions import Questions, answers
from palmar.studies.run_behaviour import Circumstances

QUICK_TOLERANCE = 1e-4
"""Of the first outlines, as a share of the finger's length."""
COARSE = {SupportKind.TABLE: 1.0 / 20.0, SupportKind.FREE: 1.0 / 8.0}
"""Spacing of the first simulated starts, as a share of the finger's length."""

FEEDBACK_COARSE, FEEDBACK_TICK = 1.0 / 8.0, 0.02
"""Spacing, as a share of the finger's length, and time between two observations (s) of runs under feedback."""


class Look(Value):
    """Which models side by side; ``settled`` false leaves out what takes longer than a drag."""

    models: tuple[Model, ...] = (Model.EXACT,)
    closure: Closure = Closure.FRICTIONAL
    settled: bool = True


def at_once(asked: Question) -> Iterator[Part]:
    """Within milliseconds: what is in closed form, its outlines a little coarser than the command line's."""
    case, wanted = asked.required_case, asked.parameters(Look)
    for model in _each(wanted):
        if takes_milliseconds(case, model, wanted.closure):
            yield _region(case, model, wanted.closure, QUICK_TOLERANCE * case.hand.finger_length, "quick")
    if bends_in_closed_form(case):
        yield _bent(case, jointed_verdict(case), "quick")
    elif isinstance(case.object, Disk) and not bends(case):
        yield Part("closure", closure_record(closure_verdict(case)), "quick", Guarantee.CLOSED_FORM)


def roughly(asked: Question) -> Iterator[Part]:
    """Within a tenth of a second or so: simulated regions, with a coarse spacing."""
    case, wanted = asked.required_case, asked.parameters(Look)
    for model in _each(wanted):
        if not takes_milliseconds(case, model, wanted.closure):
            coarse = COARSE[case.support.kind] * case.hand.finger_length if model is Model.EXACT else None
            yield _region(case, model, wanted.closure, coarse, "quick" if coarse else "settled")


def exactly(asked: Question) -> Iterator[Part]:
    """The command line's numbers where they take no longer than that, and the drawing."""
    case, wanted = asked.required_case, asked.parameters(Look)
    for model in _each(wanted):
        if wanted.settled and _is_settled_soon(case, model, wanted.closure):
            yield _region(case, model, wanted.closure, None, "settled")
    if not bends(case):
        yield Part("closure", closure_record(closure_answer(case)), "settled", Guarantee.CLOSED_FORM)
    yield Part("drawing", {**drawing(case), **case_value(case)})


def at_last(asked: Question) -> Iterator[Part]:
    """The command line's answers that take longer."""
    case, wanted = asked.required_case, asked.parameters(Look)
    if not wanted.settled:
        return
    if bends(case):
        yield _bent(case, jointed_closure(case), "settled")
    for model in _each(wanted):
        try:
            region = build_region(case, model, wanted.closure)
        except NotCoveredError as error:
            yield _uncovered(model, error, "settled")
            continue
        if model is Model.EXACT and not _is_settled_soon(case, model, wanted.closure):
            yield Part("region", region_value(case, region), "settled", region.guarantee)
        said = answers_record(case, answers(case, region, model, wanted.closure, Questions()))
        yield Part("validity", {"model": model.value, **said})


def feedback_coarsely(asked: Question) -> Iterator[Part]:
    """The region of a behaviour under feedback, at a coarse spacing."""
    yield _feedback(asked.required_case, FEEDBACK_COARSE, "quick")


def feedback_wholly(asked: Question) -> Iterator[Part]:
    """As ``palmar behaviours region`` has it."""
    yield _feedback(asked.required_case, None, "settled")


def _feedback(case: Case, share: float | None, stage: Stage) -> Part:
    tolerance = None if share is None else share * case.hand.finger_length
    with ThreadPoolExecutor(1) as pool:
        region = behaviour_region(case, pool, tolerance, Circumstances(tick=FEEDBACK_TICK))
    return Part("region", region_value(case, region), stage, region.guarantee)


def _each(wanted: Look) -> tuple[Model, ...]:
    return tuple(dict.fromkeys(wanted.models))


def _is_settled_soon(case: Case, model: Model, closure: Closure) -> bool:
    """Whether the command line's region takes a tenth of a second at most: in closed form, or few simulated pushes."""
    if takes_milliseconds(case, model, closure):
        return True
    plain = case.support.wall is None and case.behaviour.name is BehaviourName.CLOSE and not case.ranges
    return plain and case.support.kind is SupportKind.TABLE


def _bent(case: Case, found: JointedClosure, stage: Stage) -> Part:
    guarantee = Guarantee.CLOSED_FORM if found.cases else None
    return Part("closure", jointed_record(case.hand, found), stage, guarantee)


def _region(case: Case, model: Model, closure: Closure, tolerance: float | None, stage: Stage) -> Part:
    try:
        region = build_region(case, model, closure, None, tolerance)
    except NotCoveredError as error:
        return _uncovered(model, error, stage)
    return Part("region", region_value(case, region), stage, region.guarantee)


def _uncovered(model: Model, error: NotCoveredError, stage: Stage) -> Part:
    return Part("region", {"model": model.value, "uncovered": str(error)}, stage)


def region_value(case: Case, region: Region) -> dict[str, Any]:
    """The record without coordinates, and the sets as they are drawn; an error band that nobody would see is none."""
    length, sets = case.hand.finger_length, region_sets(region)
    allowed = region.allowed_error
    if region.band < VISIBLE * region.area:
        sets.pop("outer", None)
    drawn = {name: None if name not in sets else shown(sets[name], length) for name in SETS}
    return {
        "model": region.model.value,
        "closure": region.closure.value,
        "record": region_facts(region),
        **{f"{name}_mm": each for name, each in drawn.items()},
        "allowed_mm": None
        if allowed is None
        else {"centre": [MM * each for each in allowed.centre], "radius": MM * allowed.radius},
    }


SETS = ("centre", "contact", "whole", "outer", "certain")
