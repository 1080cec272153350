"""The trials of a search by trial and error in a file, one JSON object a line, so that a run that was cut off goes on."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from palmar.errors import InputError, OutputError
from palmar.models.outcome import Outcome

if TYPE_CHECKING:
    from palmar.studies.limits import Trial


class TrialLog:
    """The file of one search; ``settings``: all that its trials depend on."""

    def __init__(self, path: Path, settings: str) -> None:
        self.path, self.key = path, sha256(settings.encode()).hexdigest()

    def read(self) -> list[Trial]:
        """Trials so far; a new file begins with the settings' hash. Raises InputError where it is another search's."""
        from palmar.studies.limits import Trial

        try:
            text = self.path.read_text(encoding="utf-8") if self.path.exists() else ""
            whole = text[: text.rfind("\n") + 1]
            if whole != text:
                self.path.write_text(whole, encoding="utf-8")  # the run was cut off in the middle of a line
            if not whole:
                self._write(json.dumps({"search": self.key}))
                return []
            head, *lines = whole.splitlines()
            if json.loads(head) != {"search": self.key}:
                raise InputError("--log", str(self.path), "holds another search; give a new file")
            rows = [json.loads(line) for line in lines]
            return [
                Trial(int(row["ray"]), float(row["distance"]), (row["x"], row["y"]), Outcome(row["outcome"]))
                for row in rows
            ]
        except (OSError, ValueError, KeyError, TypeError):
            raise InputError("--log", str(self.path), "must be the log of this search, or a new file") from None

    def add(self, trial: Trial) -> None:
        """Append one trial."""
        x, y = trial.placed
        row = {"ray": trial.ray, "distance": trial.distance, "x": x, "y": y, "outcome": trial.outcome.value}
        self._write(json.dumps(row))

    def _write(self, line: str) -> None:
        try:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(line + "\n")
        except OSError as error:
            raise OutputError(f"{self.path}: {error.strerror}") from None
