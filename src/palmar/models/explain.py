"""One plain line for a value that a model refuses: which key, what it was, what is allowed, in the file's unit."""

from __future__ import annotations

import json
from typing import Any

from pydantic import ValidationError

from palmar.errors import InputError
from palmar.models.quantity import Unit, Value, file_key, unit_of

LONGEST_VALUE = 60

_BOUNDS = {
    "greater_than": ("gt", "must be greater than"),
    "greater_than_equal": ("ge", "must be at least"),
    "less_than": ("lt", "must be less than"),
    "less_than_equal": ("le", "must be at most"),
}


def explain(error: ValidationError, model: type[Value], table: dict[str, Any], where: str) -> InputError:
    """The first complaint of ``error`` as an InputError about the case file's ``table`` (raw values, file keys)."""
    first = error.errors()[0]
    place = first["loc"]
    if not place:
        return InputError(where, None, str(first["ctx"]["error"]))
    name, *inner = place
    field = model.model_fields[str(name)]
    unit, key = unit_of(field), file_key(str(name), field)
    raw = table.get(key)
    for index in inner:
        raw = raw[index] if isinstance(raw, list) and isinstance(index, int) and index < len(raw) else raw
    path = f"{where}.{key}" + "".join(f"[{index}]" for index in inner if isinstance(index, int))
    received = None if first["type"] == "missing" else _shown(raw)
    return InputError(path, received, _allowed(first, unit))


def _allowed(complaint: Any, unit: Unit | None) -> str:
    kind, context = complaint["type"], complaint.get("ctx", {})
    if kind in _BOUNDS:
        name, words = _BOUNDS[kind]
        limit = context[name] if unit is None else unit.from_si(context[name])
        return f"{words} {limit:g}" + (f" {unit.printed}" if unit else "")
    if kind == "value_error":
        return str(context["error"])
    if kind == "enum":
        return f"must be one of {context['expected']}"
    if kind in ("too_short", "too_long"):
        ends = ("min_length", "at least") if kind == "too_short" else ("max_length", "at most")
        return f"needs {ends[1]} {context[ends[0]]} entries, has {context['actual_length']}"
    phrases = {
        "missing": "is missing",
        "float_type": "must be a number" + (f" in {unit.printed}" if unit else ""),
        "finite_number": "must be a finite number",
        "tuple_type": "must be a list" + (f" of numbers in {unit.printed}" if unit else ""),
    }
    return phrases.get(kind, str(complaint["msg"]).lower())


def _shown(raw: Any) -> str:
    text = json.dumps(raw, default=str, ensure_ascii=False)
    return text if len(text) <= LONGEST_VALUE else text[: LONGEST_VALUE - 1] + "…"
