"""What a page is told first: version, limits, what there is to choose, and which numbers a case has."""

from __future__ import annotations

import shutil
from enum import Enum
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from palmar.behaviours.descriptions import DESCRIPTIONS
from palmar.faces.studio.kinds import EXPORTS, Kind
from palmar.faces.studio.requests import LARGEST_MESSAGE
from palmar.models.behaviour import Behaviour
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.quantity import Unit, Value, file_key, unit_of
from palmar.models.sensors import Sensors
from palmar.models.support import Support

SECTIONS: dict[str, type[Value]] = {
    "hand": Hand, "contact": Contact, "support": Support, "sensors": Sensors, "behaviour": Behaviour,
}  # fmt: skip


@cache
def hello() -> dict[str, Any]:
    """The first frame."""
    return {
        "kind": "hello",
        "version": version("palmar"),
        "mujoco": find_spec("mujoco") is not None,
        "ffmpeg": shutil.which("ffmpeg") is not None,
        "kinds": [each.value for each in Kind],
        "limits": {"message_bytes": LARGEST_MESSAGE, "grid_points": 40_000, "map_grid": 201},
        "exports": {what: list(formats) for what, formats in EXPORTS.items()},
        "behaviours": [
            {"name": name.value, "summary": each.summary, "parameters": _defaults(each.parameters)}
            for name, each in DESCRIPTIONS.items()
        ],
        "keys": {
            **{section: _keys(model) for section, model in SECTIONS.items()},
            "object": {"disk": _keys(Disk), "polygon": _keys(ConvexPolygon)},
        },
    }


def _defaults(names: tuple[str, ...]) -> dict[str, Any]:
    fields = {name: Behaviour.model_fields[name] for name in names}
    return {file_key(name, field): _in_file(field.default, unit_of(field)) for name, field in fields.items()}


def _keys(model: type[Value]) -> dict[str, dict[str, Any]]:
    return {file_key(name, field): _key(field) for name, field in model.model_fields.items()}


def _key(field: FieldInfo) -> dict[str, Any]:
    """Type, unit, default, bounds and choices of one number of a case."""
    unit, given = unit_of(field), field.annotation
    choices = [each.value for each in _enums(given)]
    bounds = {
        name: _in_file(float(getattr(each, ends)), unit)
        for each in _metadata(field)
        for name, ends in (("minimum", "ge"), ("minimum", "gt"), ("maximum", "le"), ("maximum", "lt"))
        if getattr(each, ends, None) is not None
    }
    return {
        "type": "choice" if choices else _type_of(given),
        "unit": None if unit is None else unit.printed,
        **({} if field.is_required() else {"default": _in_file(field.get_default(), unit)}),
        **bounds,
        **({"choices": choices} if choices else {}),
    }


def _in_file(value: Any, unit: Unit | None) -> Any:
    """A default or a bound as a case file has it."""
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, tuple):
        return [_in_file(each, unit) for each in value]
    return unit.from_si(value) if unit is not None and isinstance(value, float) else value


def _parts(given: Any) -> list[Any]:
    """The types that an annotation is made of, None aside."""
    if get_origin(given) in (Union, UnionType):
        return [each for part in get_args(given) if part is not NoneType for each in _parts(part)]
    return [given]


def _enums(given: Any) -> list[Enum]:
    return [member for each in _parts(given) if isinstance(each, type) and issubclass(each, Enum) for member in each]


def _type_of(given: Any) -> str:
    (first, *_) = _parts(given)
    if get_origin(first) is Annotated:
        first = get_args(first)[0]
    if get_origin(first) is not tuple:
        return "text" if first is str else "number"
    inner = get_args(first)[0]
    return "points" if get_origin(inner) is tuple else "numbers"


def _metadata(field: FieldInfo) -> list[Any]:
    return [*field.metadata, *(each for part in _parts(field.annotation) for each in getattr(part, "__metadata__", ()))]
