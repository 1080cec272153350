"""What ``palmar region`` says beside the region itself."""

from __future__ import annotations

from palmar.faces.cli.texts import notes, table
from palmar.faces.region_words import (
    capture_rows,
    ends_lines,
    ends_rows,
    pre_opening_rows,
    validity_lines,
    velocity_line,
)
from palmar.models.case import Case
from palmar.studies.region_questions import Answers


def answers_text(case: Case, given: Answers) -> list[str]:
    """What `palmar region CASE` says beside the region, in paragraphs."""
    parts = []
    if given.capture is not None:
        parts.append("\n".join([table(list(capture_rows(given.capture))), *notes(given.capture.notes)]))
    if given.pre_opening is not None:
        parts.append(table(list(pre_opening_rows(case, given.pre_opening))))
    if given.ends is not None:
        parts.append("\n".join([table(ends_rows(given.ends)), *ends_lines(given.ends, given.angles)]))
    elif given.asked.ends:
        parts.append("Nothing is caught, so there is no place where it ends.")
    if given.velocity is not None:
        parts.append(velocity_line(given.velocity))
    return [*parts, "\n".join(validity_lines(given.validity))]
