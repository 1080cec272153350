"""The case file: TOML in millimetres and degrees on one side, a frozen ``Case`` in SI on the other."""

from __future__ import annotations

import difflib
import json
import re
import tomllib
from math import isfinite
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from palmar.errors import InputError
from palmar.models.bed import Bed
from palmar.models.behaviour import Behaviour
from palmar.models.case import Case, Range, Start
from palmar.models.contact import Contact
from palmar.models.explain import explain
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.quantity import Unit, Value, file_key, unit_of
from palmar.models.sensors import SensorLayout, Sensors
from palmar.models.support import Support
from palmar.models.text_file import read_text

MOST_RANGES = 6

_SECTIONS: dict[str, type[Value]] = {
    "hand": Hand, "object": Disk, "contact": Contact, "support": Support,
    "start": Start, "sensors": Sensors, "behaviour": Behaviour, "bed": Bed,
}  # fmt: skip
_SHAPES: dict[str, type[Value]] = {"disk": Disk, "polygon": ConvexPolygon}
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(rf"\s*({_NUMBER})\s*\.\.\s*({_NUMBER})\s*")


def read_case(path: Path) -> Case:
    """The case in a TOML file.

    Raises InputError naming file, field, value and what is allowed.
    """
    return parse_case(read_text(path, words=", a case file is a few lines"), str(path))


def parse_case(text: str, name: str = "case") -> Case:
    """The case in a TOML text; ``name`` stands for the file in error messages."""
    try:
        raw = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(name, None, f"is not valid TOML: {str(error) or 'nested too deep'}") from None
    return build_case(raw, name)


def build_case(raw: dict[str, Any], name: str = "case") -> Case:
    """The case in tables as TOML has them; ``name`` stands for the file in error messages."""
    for section in raw:
        _known(section, _SECTIONS, name, "section")
    ranges: list[Range] = []
    parts = {section: _read_section(raw, section, name, ranges) for section in _SECTIONS if section in raw}
    for section in ("hand", "object"):
        if section not in parts:
            raise InputError(f"{name}: [{section}]", None, "is missing, every case needs this section")
    if len(ranges) > MOST_RANGES:
        raise InputError(name, f"{len(ranges)} ranges", f"at most {MOST_RANGES} numbers may be ranges")
    try:
        case = Case.model_validate(parts)
    except ValidationError as error:
        message = error.errors()[0]["msg"].removeprefix("Value error, ")
        raise InputError(name, None, message) from None
    try:
        case = Case.model_validate({**parts, "ranges": tuple(ranges)})
        list(case.corners())
    except ValidationError as error:
        raise InputError(name, None, f"a range leaves what is allowed: {error.errors()[0]['msg']}") from None
    return case


def dump_case(case: Case) -> str:
    """TOML text that ``parse_case`` reads back as the same case."""
    return dump_tables(case_tables(case))


def dump_tables(tables: dict[str, dict[str, Any]]) -> str:
    """TOML text of a case's tables."""
    sections = [
        "\n".join([f"[{name}]", *(f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in table.items())])
        for name, table in tables.items()
    ]
    return "\n\n".join(sections) + "\n"


def case_tables(case: Case) -> dict[str, dict[str, Any]]:
    """The tables that ``build_case`` reads back as the same case; what is absent is left out."""
    ranges = {each.place: each for each in case.ranges}
    tables: dict[str, dict[str, Any]] = {}
    for section in _SECTIONS:
        part: Value = getattr(case, section)
        if part == Bed():
            continue  # few cases are about a test bed
        values = part.model_dump(mode="json")
        tables[section] = {
            file_key(name, field): _to_file(values[name], unit_of(field), (section, name), ranges)
            for name, field in type(part).model_fields.items()
            if values[name] is not None
        }
    return tables


def with_friction(case: Case, text: str, where: str) -> Case:
    """The case with another friction of the contacts, a number or a range as in a file; raises InputError."""
    try:
        value: float | str = float(text)
    except ValueError:
        value = text.strip()
    ranges = [each for each in case.ranges if each.place != ("contact", "friction")]
    read = _read_section({"contact": {"friction": value}}, "contact", where, ranges)
    assert isinstance(read, Contact)
    contact = case.contact.model_copy(update={"friction": read.friction})
    return case.model_copy(update={"contact": contact, "ranges": tuple(ranges)})


def with_layout(case: Case, text: str, where: str) -> Case:
    """The case with another sensor layout: a preset's name, or stretches with commas between; raises InputError."""
    given: str | list[str] = text.strip()
    if given not in [each.value for each in SensorLayout] and (
        "," in text or text.startswith(("palm ", "right", "left"))
    ):
        given = [each.strip() for each in text.split(",")]
    read = _read_section({"sensors": {"layout": given}}, "sensors", where, [])
    assert isinstance(read, Sensors)
    sensors = case.sensors.model_copy(update={"layout": read.layout})
    try:
        sensors.stretches(case.hand)
    except ValueError as error:
        raise InputError(where, None, str(error).removeprefix("sensors.layout: ")) from None
    return case.model_copy(update={"sensors": sensors})


def _read_section(raw: dict[str, Any], section: str, name: str, ranges: list[Range]) -> Value:
    table = raw[section]
    where = f"{name}: {section}"
    if not isinstance(table, dict):
        raise InputError(where, json.dumps(table, default=str)[:60], f"must be a table, [{section}]")
    model = _SECTIONS[section]
    if section == "object":
        shape = table.get("shape", "disk")
        if not isinstance(shape, str) or shape not in _SHAPES:
            raise InputError(f"{where}.shape", json.dumps(shape, default=str)[:60], 'must be "disk" or "polygon"')
        model = _SHAPES[shape]
    fields = {file_key(field_name, field): (field_name, field) for field_name, field in model.model_fields.items()}
    data: dict[str, Any] = {}
    found: list[Range] = []
    for key, value in table.items():
        _known(key, fields, where, "key")
        field_name, field = fields[key]
        data[field_name] = _to_si(value, unit_of(field), (section, field_name), f"{where}.{key}", found)
    ranges.extend(found)
    try:
        part = model.model_validate(data)
        for end in ("low", "high"):
            model.model_validate(_at_end(data, found, end))
    except ValidationError as error:
        raise explain(error, model, table, where) from None
    return part


def _at_end(data: dict[str, Any], found: list[Range], end: str) -> dict[str, Any]:
    """The section's data with every range at its lower or upper end, so that both are validated."""
    moved = dict(data)
    for each in found:
        _, field, *inner = each.place
        moved[str(field)] = _replaced(moved[str(field)], inner, getattr(each, end))
    return moved


def _replaced(value: Any, inner: list[Any], end: float) -> Any:
    if not inner:
        return end
    return [_replaced(item, inner[1:], end) if i == inner[0] else item for i, item in enumerate(value)]


def _to_si(value: Any, unit: Unit | None, place: tuple[str | int, ...], where: str, found: list[Range]) -> Any:
    """Numbers, and numbers in lists, from the file's unit to SI; anything else is left for the model to refuse."""
    if isinstance(value, list):
        return [_to_si(item, unit, (*place, i), f"{where}[{i}]", found) for i, item in enumerate(value)]
    if isinstance(value, str) and (match := _RANGE.fullmatch(value)):
        low, high = (_scaled(float(end), unit) for end in match.groups())
        if not isfinite(low) or not isfinite(high):
            raise InputError(where, json.dumps(value), "both ends of a range must be finite numbers")
        if not low <= high:
            raise InputError(where, json.dumps(value), "the lower end of a range comes first")
        found.append(Range(place=place, low=low, high=high))
        return 0.5 * (low + high)
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            return _scaled(float(value), unit)
        except OverflowError:
            return float("inf")
    return value


def _scaled(value: float, unit: Unit | None) -> float:
    return value if unit is None else unit.to_si(value)


def _to_file(value: Any, unit: Unit | None, place: tuple[str | int, ...], ranges: dict[Any, Range]) -> Any:
    if place in ranges:
        each = ranges[place]
        low, high = ((end if unit is None else unit.from_si(end)) for end in (each.low, each.high))
        return f"{low!r}..{high!r}"
    if isinstance(value, list | tuple):
        return [_to_file(item, unit, (*place, i), ranges) for i, item in enumerate(value)]
    return unit.from_si(value) if unit is not None and isinstance(value, float) else value


def _known(key: str, allowed: dict[str, Any], where: str, kind: str) -> None:
    if key not in allowed:
        close = difflib.get_close_matches(key, allowed, n=1)
        hint = f"did you mean {close[0]}?" if close else f"allowed are {', '.join(allowed)}"
        place = f"{where}{': ' if kind == 'section' else '.'}{key[:60]}"
        raise InputError(place, None, f"unknown {kind}, {hint}")
