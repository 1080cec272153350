"""``palmar design``: what closed forms say of a brief at once, then the smallest hand, its trial, and the front."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

from pydantic import Field

from palmar.errors import InputError
from palmar.faces.design_record import design_record
from palmar.faces.design_words import brief_words, design_rows, fewest_words, impossible_words, link_row
from palmar.faces.plots.design_picture import objects_of
from palmar.faces.studio.answers.drawing import MM, millimetres
from palmar.faces.studio.answers.library import case_value
from palmar.faces.studio.answers.part import Part, Question
from palmar.models.behaviour import Behaviour
from palmar.models.case import Start
from palmar.models.design_brief import DesignBrief
from palmar.models.design_brief_file import (
    brief_description,
    brief_tables,
    build_brief,
    dump_brief,
    parse_brief,
    shipped_brief_text,
    shipped_briefs,
)
from palmar.models.guarantee import Guarantee
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.quantity import Value
from palmar.studies.design.bounds import bound
from palmar.studies.design.circumstances import case_of
from palmar.studies.design.curled import may_curl
from palmar.studies.design.design import CASES, Design, front_hands, largest_error, stages, with_error
from palmar.studies.design.tolerance import Place, is_exact


class Briefed(Value):
    """A brief as tables or text, and the command line's options; ``search``: whether a hand is worth a long search."""

    brief: dict[str, Any] | str
    search: bool = False
    cases: Annotated[int, Field(ge=1, le=1_000_000, strict=True)] = CASES
    seed: Annotated[int, Field(ge=0, lt=2**32, strict=True)] = 0
    front: Annotated[int, Field(ge=0, le=50, strict=True)] = 0


class Wanted(Value):
    """A shipped brief by its name, or one to be read as tables or text; without either the shipped ones are listed."""

    name: str | None = None
    brief: dict[str, Any] | str | None = None


def brief_of(given: Briefed) -> DesignBrief:
    """The brief; raises InputError in one line."""
    return _read(given.brief)


def _read(given: dict[str, Any] | str) -> DesignBrief:
    return parse_brief(given) if isinstance(given, str) else build_brief(given)


def briefs(asked: Question) -> Iterator[Part]:
    """The shipped briefs, or one that was chosen or dropped onto the page."""
    wanted = asked.parameters(Wanted)
    if wanted.name is not None:
        yield Part("brief", _brief_value(parse_brief(shipped_brief_text(wanted.name), wanted.name)))
    elif wanted.brief is not None:
        yield Part("brief", _brief_value(_read(wanted.brief)))
    else:
        known = [{"name": each, "description": brief_description(each)} for each in shipped_briefs()]
        yield Part("briefs", {"briefs": known})


def at_once(asked: Question) -> Iterator[Part]:
    """What is asked for in words, and the least that a hand must measure by closed forms, or why none will do."""
    brief = brief_of(asked.parameters(Briefed))
    value: dict[str, Any] = {"words": brief_words(brief), "soon": _is_soon(brief), "least_m": None, "impossible": None}
    if brief.targets.radii is not None:
        each_way = [bound(brief, links) for links in sorted(set(brief.limits.links))]
        left = [each for each in each_way if each.because is None]
        if left:
            value["least_m"] = min(each.least for each in left)
        else:
            value["impossible"] = impossible_words(min(each_way, key=lambda each: each.proven))
    yield Part("bound", value, "quick", Guarantee.CLOSED_FORM)


def at_last(asked: Question) -> Iterator[Part]:
    """The smallest hand, then the same hand tried; nothing where a search takes long and was not asked for."""
    given = asked.parameters(Briefed)
    brief = brief_of(given)
    if not (given.search or _is_soon(brief)):
        return
    for found in stages(brief, given.cases, given.seed):
        is_tried = found.chosen is None or found.verification is not None
        yield Part("design", _design_value(found), "settled" if is_tried else "quick", found.guarantee)


def front(asked: Question) -> Iterator[Part]:
    """The front of size against tolerated error, once more with each point; of no points nothing, which ends a search."""
    given = asked.parameters(Briefed)
    brief = brief_of(given)
    points: list[dict[str, Any]] = []
    least = _least_at_the_end(brief) if given.front > 0 else None
    for option, error in front_hands(brief, given.front):
        assert option.hand is not None
        shown = _hand_value(brief, option.hand, option.place, error, option.does)
        points.append({"size_m": option.size, "error_m": error, **shown})
        value = {"points": list(points), "of": given.front, "least_m": least}
        yield Part("front", value, guarantee=Guarantee.SAMPLED)
    if given.front > 0 and not points:
        raise InputError("front", None, "there is none: no hand meets the brief, whatever the error")


def _least_at_the_end(brief: DesignBrief) -> list[float] | None:
    """Size that no hand undercuts at the front's largest error, and that error (m): about where the front will end."""
    if brief.targets.radii is None:
        return None
    error = largest_error(brief)
    ends = [bound(with_error(brief, error), links) for links in brief.limits.links]
    least = [each.least for each in ends if each.because is None]
    return [min(least), error] if least else None


def _is_soon(brief: DesignBrief) -> bool:
    """Whether a hand is found within seconds: disks on a table, closed on by straight fingers without feeling for them."""
    return is_exact(brief) and not may_curl(brief)


def _brief_value(brief: DesignBrief) -> dict[str, Any]:
    return {"brief": brief_tables(brief), "toml": dump_brief(brief), "words": brief_words(brief)}


def _design_value(found: Design) -> dict[str, Any]:
    """The command line's record and words, and the hand to draw."""
    chosen = found.chosen
    several = len(found.options) > 1
    value: dict[str, Any] = {
        "record": design_record(found),
        "rows": design_rows(found),
        "impossible": impossible_words(found) if chosen is None else None,
        "links": [link_row(each) for each in found.options] if several else [],
        "fewest": fewest_words(found) if several else None,
        "hand": None,
    }
    if chosen is not None and chosen.hand is not None:
        value["hand"] = _hand_value(found.brief, chosen.hand, chosen.place, found.error or 0.0, chosen.does)
    return value


def _hand_value(brief: DesignBrief, hand: Hand, place: Place | None, error: float, does: Behaviour) -> dict[str, Any]:
    """A hand with its objects and the circle of errors; as a case it is before the largest object at the least friction."""
    things = objects_of(brief)
    last = things[-1]
    reach = last.radius if isinstance(last, Disk) else max(y for _, y in last.vertices)
    at = place or (0.0, reach + hand.half_thickness)
    case = case_of(brief, hand, last, brief.targets.friction[0], brief.targets.restitution[1], does)
    tables = case_value(case.model_copy(update={"start": Start(at=at)}))["case"]
    return {
        "case": tables,
        "radii_mm": [MM * each.radius for each in things if isinstance(each, Disk)],
        "place_mm": millimetres(at),
        "error_mm": MM * error,
    }
