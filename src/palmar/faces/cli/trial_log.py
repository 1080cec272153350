"""Trials in a file, one JSON object a line, so that a run that was cut off goes on."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from palmar.errors import InputError, OutputError
from palmar.models.outcome import Outcome

if TYPE_CHECKING:
    from palmar.studies.limits import Trial

Row = dict[str, Any]
Log = Annotated[Path | None, Parameter(help="Keep every trial in this file; a run that was cut off goes on.")]


class TrialLog:
    """The file of one run; ``settings``: all that its trials depend on."""

    def __init__(self, path: Path, settings: str) -> None:
        self.path, self.key = path, sha256(settings.encode()).hexdigest()

    def outcomes(self) -> dict[int, Outcome]:
        """Of the trials so far, by their numbers. Raises InputError where the file is another run's."""
        try:
            return {int(row["start"]): Outcome(row["outcome"]) for row in self._rows()}
        except (ValueError, KeyError, TypeError):
            raise self._refused() from None

    def trials(self) -> list[Trial]:
        """Of a search for limits, so far. Raises InputError where the file is another run's."""
        from palmar.studies.limits import Trial

        try:
            return [
                Trial(
                    int(row["ray"]),
                    float(row["distance"]),
                    (float(row["x"]), float(row["y"])),
                    Outcome(row["outcome"]),
                )
                for row in self._rows()
            ]
        except (ValueError, KeyError, TypeError):
            raise self._refused() from None

    def add_outcome(self, number: int, outcome: Outcome) -> None:
        """Append what became of one start."""
        self._write({"start": number, "outcome": outcome.value})

    def add_trial(self, trial: Trial) -> None:
        """Append one trial of a search."""
        x, y = trial.placed
        self._write({"ray": trial.ray, "distance": trial.distance, "x": x, "y": y, "outcome": trial.outcome.value})

    def _rows(self) -> list[Row]:
        """All rows; a new file begins with the settings' hash."""
        try:
            text = self.path.read_text(encoding="utf-8") if self.path.exists() else ""
            whole = text[: text.rfind("\n") + 1]
            if whole != text:
                self.path.write_text(whole, encoding="utf-8")  # the run was cut off in the middle of a line
        except (OSError, ValueError):
            raise self._refused() from None
        if not whole:
            self._write({"search": self.key})
            return []
        head, *lines = whole.splitlines()
        if json.loads(head) != {"search": self.key}:
            raise InputError("--log", str(self.path), "holds another search; give a new file")
        return [json.loads(line) for line in lines]

    def _refused(self) -> InputError:
        return InputError("--log", str(self.path), "must be the log of this search, or a new file")

    def _write(self, row: Row) -> None:
        try:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
        except OSError as error:
            raise OutputError(f"{self.path}: {error.strerror}") from None
