"""The case files that come with palmar, and a case by its shipped name or path."""

from __future__ import annotations

import difflib
from importlib import resources
from pathlib import Path

from palmar.errors import InputError
from palmar.models.case import Case
from palmar.models.case_file import parse_case, read_case

_FOLDER = resources.files("palmar.cases")


def shipped_names() -> list[str]:
    """Names of the shipped cases, in alphabetical order."""
    return sorted(entry.name.removesuffix(".toml") for entry in _FOLDER.iterdir() if entry.name.endswith(".toml"))


def shipped_text(name: str) -> str:
    """The TOML text of a shipped case; raises InputError with the names there are."""
    names = shipped_names()
    if name not in names:
        close = difflib.get_close_matches(name, names, n=1)
        hint = f"did you mean {close[0]}?" if close else f"shipped are {', '.join(names)}"
        raise InputError(name[:200], None, f"no such file and no shipped case of this name, {hint}")
    return (_FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def description(name: str) -> str:
    """The first line of a shipped case: what it is."""
    return shipped_text(name).splitlines()[0].removeprefix("# ")


def open_case(name_or_path: str) -> tuple[str, Case]:
    """(name for headings, case) of a file, or of a shipped case where no such file exists.

    Raises InputError in one line: what, where, and what is allowed.
    """
    path = Path(name_or_path)
    if path.exists() or path.suffix == ".toml" or len(path.parts) > 1:
        return path.stem, read_case(path)
    return name_or_path, parse_case(shipped_text(name_or_path), name_or_path)
