"""What every command shares: options, one JSON object or a text, progress on stderr."""

from __future__ import annotations

import json
import math
import sys
from typing import Annotated, Any

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.records import finite

CaseName = Annotated[str, Parameter(help="A case file (TOML), or the name of a shipped case.", show_default=False)]
AsJson = Annotated[bool, Parameter(name="--json", negative="", help="Print one JSON object and nothing else.")]
Check = Annotated[bool, Parameter(negative="", help="Leave with exit status 1 if the answer is no.")]


class AnswerIsNo(Exception):
    """The answer is no and the caller asked to be told by the exit status."""


def show(text: str, record: dict[str, Any], as_json: bool) -> None:
    """Print the record as JSON, or the text for people."""
    print(json.dumps(finite(record), allow_nan=False) if as_json else text)


def answer(yes: bool, check: bool) -> None:
    """Raise AnswerIsNo if the caller wants to be told."""
    if check and not yes:
        raise AnswerIsNo


def progress(step: str) -> None:
    """One line of progress on stderr."""
    print(f"palmar: {step}", file=sys.stderr, flush=True)


def one_line(message: str) -> str:
    """Any message as one printable line."""
    return "".join(each if each.isprintable() else " " for each in " ".join(message.split()))


def number(text: str, option: str) -> float:
    """A finite number from the command line; raises InputError naming the option."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(option, repr(text[:60]), "must be a finite number")
    return value


def numbers(text: str, option: str, counts: tuple[int, ...], form: str) -> list[float]:
    """Finite numbers separated by commas, as many as one of ``counts``; raises InputError naming option and form."""
    parts = text.split(",")
    if len(parts) not in counts:
        raise InputError(option, repr(text[:60]), f"must be {form}")
    values = [number(part, option) for part in parts]
    if any(abs(value) > 1e6 for value in values):
        raise InputError(option, repr(text[:60]), "numbers must be at most 1000000")
    return values
