"""What is on the screen as a file: written as the command line writes it, into a folder of its own, and read back."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any

from matplotlib.figure import Figure
from pydantic import Field

from palmar.errors import InputError, OutputError
from palmar.faces.exports.region_file import write_region
from palmar.faces.jointed_record import jointed_record, map_record
from palmar.faces.plan_record import plan_record
from palmar.faces.plots.style import save
from palmar.faces.records import closure_record, finite, region_record
from palmar.faces.region_records import answers_record
from palmar.faces.studio.answers.behaviour import performed
from palmar.faces.studio.answers.brief import Briefed, brief_of
from palmar.faces.studio.answers.experiments import known_figure
from palmar.faces.studio.answers.maps import Grid
from palmar.faces.studio.answers.motion import Begin, begin_of, record_of, simulated
from palmar.faces.studio.answers.part import File, Question, read_parameters
from palmar.faces.studio.answers.plan import Planning, made
from palmar.faces.studio.kinds import EXPORTS
from palmar.models.case_file import dump_case
from palmar.models.closure import Closure
from palmar.models.design_brief_file import dump_brief
from palmar.models.quantity import LARGEST_LENGTH, Real, Value
from palmar.regions.build import build_region
from palmar.regions.region import Model
from palmar.studies.closure import closure_answer
from palmar.studies.closure_map import grid_map
from palmar.studies.jointed_closure import bends, jointed_closure
from palmar.studies.region_questions import Questions, answers

Size = Annotated[Real, Field(gt=0.0, le=1e3 * LARGEST_LENGTH)]
Write = Callable[[Question, Path], None]


class Wanted(Value):
    """What to write, and how."""

    what: str
    format: str


class RegionWanted(Value):
    """Of a region, of two or three side by side, or of one swept along LENGTH[, WIDTH]."""

    models: tuple[Model, ...] = (Model.EXACT,)
    closure: Closure = Closure.FRICTIONAL
    settled: bool = True
    sweep_mm: Annotated[tuple[Size, ...], Field(min_length=1, max_length=2)] = (100.0,)


class FigureWanted(Value):
    """Its number in the source."""

    figure: str


def export(asked: Question) -> File:
    """The file's bytes; ``asked.given`` holds ``what``, ``format`` and ``parameters``."""
    given = dict(asked.given)
    inner = given.pop("parameters", {})
    if not isinstance(inner, dict):
        raise InputError("parameters", None, "must be an object")
    wanted = read_parameters(Wanted, given)
    if wanted.what not in WRITERS:
        raise InputError("what", repr(wanted.what[:60]), f"must be one of {', '.join(WRITERS)}")
    write, formats = WRITERS[wanted.what], EXPORTS[wanted.what]
    if wanted.format not in formats:
        raise InputError("format", repr(wanted.format[:60]), f"{wanted.what} is written as {', '.join(formats)}")
    name = f"palmar_{wanted.what}.{wanted.format}"
    with TemporaryDirectory(prefix="palmar-") as folder:
        path = Path(folder) / name
        try:
            write(Question(asked.case, inner), path)
        except OutputError as error:
            raise OutputError(str(error).replace(str(path), name)) from None
        return File(name, path.read_bytes())


def _region(asked: Question, path: Path) -> None:
    case, given = asked.required_case, asked.parameters(RegionWanted)
    model, closure = given.models[0], given.closure
    region = build_region(case, model, closure)
    said = answers_record(case, answers(case, region, model, closure, Questions()))
    write_region(path, case, region, record=region_record(region) | said)


def _comparison(asked: Question, path: Path) -> None:
    from palmar.faces.plots.compare_picture import compare_picture
    from palmar.studies.compare import compare_regions

    given = asked.parameters(RegionWanted)
    sides = list(dict.fromkeys(given.models))
    if not 2 <= len(sides) <= 3:
        raise InputError("parameters.models", None, "must be two or three different models")
    case = asked.required_case
    save(compare_picture(case, compare_regions(case, sides, given.closure)), path)


def _solid(asked: Question, path: Path) -> None:
    from palmar.faces.cli.swept import write_swept

    case, given = asked.required_case, asked.parameters(RegionWanted)
    region = build_region(case, given.models[0], given.closure)
    write_swept(path, region.centre, ",".join(repr(each) for each in given.sweep_mm))


def _film(asked: Question, path: Path) -> None:
    from palmar.faces.plots.film import known_ending, write_film

    known_ending(path)
    case, given = asked.required_case, asked.parameters(Begin)
    if given.world != "planar":
        raise InputError("parameters.world", None, "films are of the world planar")
    begin = begin_of(case, given)
    write_film(path, case, begin, simulated(case, begin, None))


def _simulation(asked: Question, path: Path) -> None:
    from palmar.faces.cli.world_option import maker_of

    case, given = asked.required_case, asked.parameters(Begin)
    _write_record(path, record_of(case, begin_of(case, given), maker_of(given.world)))


def _trace(asked: Question, path: Path) -> None:
    from palmar.faces.cli.world_option import maker_of
    from palmar.faces.exports.trace_file import write_trace

    case, given = asked.required_case, asked.parameters(Begin)
    write_trace(path, performed(case, begin_of(case, given), maker_of(given.world)))


def _plan(asked: Question, path: Path) -> None:
    given = asked.parameters(Planning)
    case, found = made(asked.required_case, given)
    if path.suffix == ".json":
        _write_record(path, plan_record(found, given.approaches_max, None))
    elif path.suffix == ".gif":
        from palmar.faces.plots.plan_film import write_plan_film

        write_plan_film(path, case, found)
    else:
        from palmar.faces.plots.plan_picture import plan_picture

        save(plan_picture(case, found), path)


def _map(asked: Question, path: Path) -> None:
    from palmar.faces.plots.closure_map_picture import map_picture

    given = asked.parameters(Grid)
    if path.suffix == ".json":
        _write_record(path, map_record(grid_map(given.grid)))
    else:
        save(map_picture([]), path)


def _closure(asked: Question, path: Path) -> None:
    case = asked.required_case
    bent = bends(case)
    _write_record(
        path, jointed_record(case.hand, jointed_closure(case)) if bent else closure_record(closure_answer(case))
    )


def _report(asked: Question, path: Path) -> None:
    from palmar.faces.pages.report_page import report_page
    from palmar.studies.report import report_facts

    path.write_text(report_page(report_facts("case", asked.required_case, lambda step: None)), encoding="utf-8")


def _figure(asked: Question, path: Path) -> None:
    from palmar.faces.plots.source_figures import FIGURES

    figure: Figure = FIGURES[known_figure(asked.parameters(FigureWanted).figure)]()
    save(figure, path)


def _case(asked: Question, path: Path) -> None:
    path.write_text(dump_case(asked.required_case), encoding="utf-8")


def _design(asked: Question, path: Path) -> None:
    from palmar.faces.design_record import design_record
    from palmar.faces.plots.design_picture import design_picture
    from palmar.studies.design.design import design

    given = asked.parameters(Briefed)
    found = design(brief_of(given), given.cases, given.seed, given.front)
    if path.suffix == ".json":
        _write_record(path, design_record(found))
    elif found.chosen is None:
        raise InputError("design", None, f"there is no hand to draw: {found.options[0].because}")
    else:
        save(design_picture(found), path)


def _brief(asked: Question, path: Path) -> None:
    path.write_text(dump_brief(brief_of(asked.parameters(Briefed))), encoding="utf-8")


def _write_record(path: Path, record: dict[str, Any]) -> None:
    """As the command line prints it with --json."""
    path.write_text(json.dumps(finite(record), allow_nan=False) + "\n", encoding="utf-8")


WRITERS: dict[str, Write] = {
    "region": _region,
    "comparison": _comparison,
    "solid": _solid,
    "film": _film,
    "trace": _trace,
    "simulation": _simulation,
    "plan": _plan,
    "map": _map,
    "closure": _closure,
    "report": _report,
    "figure": _figure,
    "case": _case,
    "design": _design,
    "brief": _brief,
}
