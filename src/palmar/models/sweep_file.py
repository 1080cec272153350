"""The specification of a sweep: TOML with a case, a command and what varies, read into a ``Sweep``."""

from __future__ import annotations

import difflib
import json
import math
import tomllib
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from palmar.errors import InputError
from palmar.models.case_file import dump_case
from palmar.models.shipped import open_case
from palmar.models.sweep import Axis, Spread, Sweep, SweepCommand, put
from palmar.models.text_file import read_text

MOST_ROWS, MOST_VALUES = 10**13, 100_000
_FOLDER = resources.files("palmar.cases") / "sweeps"
_KEYS = ("case", "command", "samples", "seed", "uncertainty_mm", "approaches_max")


def shipped_sweeps() -> list[str]:
    """Names of the specifications that come with palmar."""
    return sorted(entry.name.removesuffix(".toml") for entry in _FOLDER.iterdir() if entry.name.endswith(".toml"))


def open_sweep(name_or_path: str) -> Sweep:
    """The sweep in a file, or a shipped one; raises InputError in one line: what, where, and what is allowed."""
    path = Path(name_or_path)
    if path.exists() or path.suffix == ".toml" or len(path.parts) > 1:
        return parse_sweep(read_text(path, words=", a specification is a few lines"), str(path), path.parent)
    names = shipped_sweeps()
    if name_or_path not in names:
        raise InputError(name_or_path[:200], None, f"no such file and no shipped sweep, shipped are {', '.join(names)}")
    return parse_sweep((_FOLDER / f"{name_or_path}.toml").read_text(encoding="utf-8"), name_or_path, Path())


def parse_sweep(text: str, name: str = "sweep", folder: Path = Path()) -> Sweep:
    """The sweep in a TOML text; a case's path in it is taken from ``folder``."""
    try:
        raw = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(name, None, f"is not valid TOML: {str(error) or 'nested too deep'}") from None
    _only(raw, ("sweep", "vary"), name)
    asked, vary = _table(raw, "sweep", name), _table(raw, "vary", name)
    _only(asked, _KEYS, f"{name}: sweep")
    if not vary:
        raise InputError(f"{name}: [vary]", None, "is missing or empty: name at least one number that varies")
    base = dump_case(_case(asked, name, folder))
    axes = tuple(_axis(key, given, f"{name}: vary.{key}", base) for key, given in vary.items())
    found = Sweep(
        _command(asked, name),
        base,
        axes,
        _whole(asked, "samples", 1, 1, MOST_ROWS, name),
        _whole(asked, "seed", 0, 0, 2**63 - 1, name),
        1e-3 * _real(asked.get("uncertainty_mm", 10.0), f"{name}: sweep.uncertainty_mm"),
        _whole(asked, "approaches_max", 3, 1, 6, name),
    )
    if found.samples > 1 and len(found.grids) == len(axes):
        raise InputError(f"{name}: sweep.samples", str(found.samples), "nothing is drawn, every row would be the same")
    if found.rows > MOST_ROWS:
        raise InputError(name, f"{found.rows} rows", f"at most {MOST_ROWS}")
    _check_ends(found, name)
    return found


def _case(asked: dict[str, Any], name: str, folder: Path) -> Any:
    given = asked.get("case")
    if not isinstance(given, str):
        raise InputError(f"{name}: sweep.case", json.dumps(given, default=str)[:60], "must name a case or its file")
    path = folder / given
    _, case = open_case(str(path) if path.exists() and not path.is_dir() else given)
    if case.ranges:
        raise InputError(f"{name}: sweep.case", json.dumps(given)[:60], "must have numbers, no ranges: vary them here")
    return case


def _command(asked: dict[str, Any], name: str) -> SweepCommand:
    try:
        return SweepCommand(asked.get("command", "simulate"))
    except ValueError:
        received = json.dumps(asked["command"], default=str)[:60]
        allowed = ", ".join(each.value for each in SweepCommand)
        raise InputError(f"{name}: sweep.command", received, f"must be one of {allowed}") from None


def _axis(key: str, given: Any, where: str, base: str) -> Axis:
    if isinstance(given, list):
        given = {"values": given}
    if not isinstance(given, dict):
        raise InputError(where, json.dumps(given, default=str)[:60], "must be a list of values or a table")
    if set(given) == {"from", "to", "steps"}:
        low, high = _real(given["from"], f"{where}.from"), _real(given["to"], f"{where}.to")
        steps = _whole(given, "steps", 2, 2, MOST_VALUES, where)
        axis = Axis(key, Spread.GRID, tuple(np.linspace(low, high, steps).tolist()))
    else:
        axis = Axis(key, *_spread(given, where))
    try:
        put(tomllib.loads(base), axis.place, axis.numbers[0])
    except (KeyError, IndexError, TypeError, AttributeError):
        raise InputError(where, None, 'names no number: "section.key", or "section.key.0" in a list') from None
    return axis


def _spread(given: dict[str, Any], where: str) -> tuple[Spread, tuple[float, ...]]:
    names = [each.value for each in Spread]
    if len(given) != 1 or next(iter(given)) not in names:
        allowed = f"must be {{from, to, steps}} or one of {', '.join(names)}"
        raise InputError(where, json.dumps(given, default=str)[:60], allowed)
    spread, listed = Spread(next(iter(given))), next(iter(given.values()))
    where = f"{where}.{spread.value}"
    if not isinstance(listed, list) or not 0 < len(listed) <= MOST_VALUES:
        raise InputError(where, json.dumps(listed, default=str)[:60], f"must be a list of 1 to {MOST_VALUES} numbers")
    numbers = tuple(_real(each, where) for each in listed)
    if spread is Spread.GRID:
        return spread, numbers
    meant = "mean and standard deviation" if spread is Spread.NORMAL else "lower and upper end"
    wrong = len(numbers) != 2 or (numbers[1] < 0.0 if spread is Spread.NORMAL else numbers[0] > numbers[1])
    if wrong or (spread is Spread.LOG_UNIFORM and numbers[0] <= 0.0):
        raise InputError(where, json.dumps(listed)[:60], f"must be {meant}")
    return spread, numbers


def _check_ends(sweep: Sweep, name: str) -> None:
    """Least and greatest number of each axis must be allowed, the others as they are; a normal one's mean."""
    for axis in sweep.axes:
        for value in axis.numbers[:1] if axis.spread is Spread.NORMAL else (min(axis.numbers), max(axis.numbers)):
            try:
                sweep.case_at({axis.key: value})
            except InputError as error:
                raise InputError(f"{name}: vary.{axis.key}", f"{value:g}", str(error).removeprefix("row: ")) from None


def _table(raw: dict[str, Any], section: str, name: str) -> dict[str, Any]:
    table = raw.get(section, {})
    if not isinstance(table, dict):
        raise InputError(f"{name}: {section}", json.dumps(table, default=str)[:60], f"must be a table, [{section}]")
    return table


def _only(table: dict[str, Any], allowed: tuple[str, ...], where: str) -> None:
    for key in table:
        if key not in allowed:
            close = difflib.get_close_matches(key, allowed, n=1)
            hint = f"did you mean {close[0]}?" if close else f"allowed are {', '.join(allowed)}"
            raise InputError(f"{where}.{key[:60]}", None, f"unknown key, {hint}")


def _whole(table: dict[str, Any], key: str, default: int, least: int, most: int, name: str) -> int:
    value = table.get(key, default)
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise InputError(
            f"{name}: {key}", json.dumps(value, default=str)[:60], f"must be a whole number, {least} to {most}"
        )
    return value


def _real(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise InputError(where, json.dumps(value, default=str)[:60], "must be a finite number")
    return float(value)
