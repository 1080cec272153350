"""The brief's file: TOML in millimetres on one side, a frozen ``DesignBrief`` in SI on the other."""

from __future__ import annotations

import difflib
import json
import re
import tomllib
from importlib import resources
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from palmar.errors import InputError
from palmar.models.case_file import dump_tables
from palmar.models.design_brief import DesignBrief, Limits, Targets
from palmar.models.explain import explain
from palmar.models.quantity import Unit, Value, file_key, unit_of
from palmar.models.sensors import Sensors
from palmar.models.text_file import read_text

PAIRS = ("radii", "friction", "restitution", "palm_width", "finger_length")
"""Fields that take a number, "low..high", or a list of values whose ends count."""
_SECTIONS: dict[str, type[Value]] = {"targets": Targets, "limits": Limits}
_FOLDER = resources.files("palmar.cases") / "briefs"
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(rf"\s*({_NUMBER})\s*\.\.\s*({_NUMBER})\s*")


def shipped_briefs() -> list[str]:
    """Names of the briefs that come with palmar."""
    return sorted(entry.name.removesuffix(".toml") for entry in _FOLDER.iterdir() if entry.name.endswith(".toml"))


def shipped_brief_text(name: str) -> str:
    """The TOML text of a shipped brief; raises InputError with the names there are."""
    names = shipped_briefs()
    if name not in names:
        raise InputError(name[:200], None, f"no such file and no shipped brief, shipped are {', '.join(names)}")
    return (_FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def brief_description(name: str) -> str:
    """The first line of a shipped brief: what it asks for."""
    return shipped_brief_text(name).splitlines()[0].removeprefix("# ")


def open_brief(name_or_path: str) -> tuple[str, DesignBrief]:
    """(name for headings, brief) of a file or a shipped one; raises InputError in one line."""
    path = Path(name_or_path)
    if path.exists() or path.suffix == ".toml" or len(path.parts) > 1:
        return path.stem, parse_brief(read_text(path, words=", a brief is a few lines"), str(path))
    return name_or_path, parse_brief(shipped_brief_text(name_or_path), name_or_path)


def parse_brief(text: str, name: str = "brief") -> DesignBrief:
    """The brief in a TOML text; ``name`` stands for the file in error messages."""
    try:
        raw = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(name, None, f"is not valid TOML: {str(error) or 'nested too deep'}") from None
    return build_brief(raw, name)


def build_brief(raw: dict[str, Any], name: str = "brief") -> DesignBrief:
    """The brief in the tables of a file; ``name`` stands for it in error messages."""
    for section in raw:
        _known(section, _SECTIONS, f"{name}: {section[:60]}", "section")
    if "targets" not in raw:
        raise InputError(f"{name}: [targets]", None, "is missing, every brief needs this section")
    parts = {section: _section(raw[section], section, name) for section in _SECTIONS if section in raw}
    return DesignBrief.model_validate(parts)


def brief_tables(brief: DesignBrief) -> dict[str, dict[str, Any]]:
    """The tables that ``build_brief`` reads back as the same brief; what is absent is left out."""
    return {section: _to_file(getattr(brief, section)) for section in _SECTIONS}


def dump_brief(brief: DesignBrief) -> str:
    """TOML text that ``parse_brief`` reads back as the same brief."""
    return dump_tables(brief_tables(brief))


def _to_file(part: Value) -> dict[str, Any]:
    values, table = part.model_dump(mode="json"), {}
    for name, field in type(part).model_fields.items():
        value = values[name]
        if value is None:
            continue
        if name == "sensors":
            value = value["layout"]
        value = _from_si(value, unit_of(field))
        if name in PAIRS:
            low, high = value
            value = low if low == high else "..".join(repr(end).removesuffix(".0") for end in value)
        table[file_key(name, field)] = value
    return table


def _from_si(value: Any, unit: Unit | None) -> Any:
    if isinstance(value, list):
        return [_from_si(each, unit) for each in value]
    return unit.from_si(value) if unit is not None and isinstance(value, float) else value


def _section(table: Any, section: str, name: str) -> Value:
    where, model = f"{name}: {section}", _SECTIONS[section]
    if not isinstance(table, dict):
        raise InputError(where, json.dumps(table, default=str)[:60], f"must be a table, [{section}]")
    fields = {file_key(field_name, field): (field_name, field) for field_name, field in model.model_fields.items()}
    data: dict[str, Any] = {}
    for key, value in table.items():
        _known(key, fields, f"{where}.{key[:60]}", "key")
        field_name, field = fields[key]
        data[field_name] = _to_si(field_name, value, unit_of(field), f"{where}.{key}")
    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise explain(error, model, table, where) from None


def _to_si(field: str, value: Any, unit: Unit | None, where: str) -> Any:
    if field == "sensors":
        try:
            return Sensors.model_validate({"layout": value})
        except ValidationError as error:
            raise explain(error, Sensors, {"layout": value}, where) from None
    if field in PAIRS:
        value = _pair(value, where)
    return _scaled(value, unit)


def _pair(value: Any, where: str) -> list[Any]:
    if isinstance(value, str):
        match = _RANGE.fullmatch(value)
        if match is None:
            raise InputError(where, json.dumps(value)[:60], 'must be a number, "low..high" or a list of numbers')
        return [float(end) for end in match.groups()]
    if not isinstance(value, list):
        return [value, value]
    if not value or not all(isinstance(each, int | float) and not isinstance(each, bool) for each in value):
        raise InputError(where, json.dumps(value, default=str)[:60], "must be a list of numbers")
    return [min(value), max(value)]


def _scaled(value: Any, unit: Unit | None) -> Any:
    if isinstance(value, list):
        return [_scaled(each, unit) for each in value]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    if unit is None:
        return value
    return unit.to_si(float(value)) if abs(value) < 1e300 else float("inf")


def _known(key: str, allowed: dict[str, Any], where: str, kind: str) -> None:
    if key not in allowed:
        close = difflib.get_close_matches(key, allowed, n=1)
        hint = f"did you mean {close[0]}?" if close else f"allowed are {', '.join(allowed)}"
        raise InputError(where, None, f"unknown {kind}, {hint}")
