"""From a job to its parts: which function answers which step of which kind."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from palmar.errors import InputError
from palmar.faces.studio.answers import brief, design, experiments, library, look, maps, motion, paint, plan
from palmar.faces.studio.answers.export import export
from palmar.faces.studio.answers.part import File, Part, Question
from palmar.faces.studio.kinds import Kind
from palmar.models.case import Case
from palmar.models.case_file import build_case, parse_case
from palmar.models.shipped import shipped_text

Answer = Callable[[Question], Iterator[Part]]

ANSWERS: dict[Kind, tuple[Answer, ...]] = {
    Kind.LOOK: (look.at_once, look.roughly, look.exactly, look.at_last),
    Kind.SIMULATE: (motion.simulate,),
    Kind.BEHAVIOUR_REGION: (look.feedback_coarsely, look.feedback_wholly),
    Kind.PAINT: (paint.coarsely, paint.wholly),
    Kind.PLAN: (plan.plan,),
    Kind.TESTBED: (motion.prediction, motion.bed),
    Kind.CLOSURE_MAP: (maps.whole_map,),
    Kind.MAP_HAND: (maps.hand_at,),
    Kind.DESIGN: (design.design,),
    Kind.BRIEF: (brief.at_once, brief.at_last),
    Kind.BRIEF_FRONT: (brief.front,),
    Kind.BRIEFS: (brief.briefs,),
    Kind.EXPERIMENTS: (experiments.experiments,),
    Kind.CASES: (library.cases,),
    Kind.READ_TOML: (library.read_toml,),
    Kind.WRITE_TOML: (library.write_toml,),
}


def answered(kind: Kind, step: int, case: Any, parameters: dict[str, Any]) -> Iterator[Part | File]:
    """The parts of one step; raises PalmarError in one line."""
    asked = Question(None if case is None else read(case), parameters)
    if kind is Kind.EXPORT:
        yield export(asked)
        return
    yield from ANSWERS[kind][step](asked)


def read(case: Any) -> Case:
    """A case from its tables or its text; raises InputError."""
    if isinstance(case, str):
        return parse_case(case)
    if isinstance(case, dict):
        return build_case(case)
    raise InputError("case", None, "must be the tables of a case file, or its text")


def warm_up() -> None:
    """Load the kernels that the first look needs."""
    asked = Question(parse_case(shipped_text("testbed_table")), {})
    for step in (look.at_once, look.exactly):
        list(step(asked))
