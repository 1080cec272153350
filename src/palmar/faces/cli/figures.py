"""``palmar figures``: every figure of the source's chapters, drawn anew, and its numbers beside palmar's."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import App, Parameter

from palmar.faces.cli.printing import AsJson, progress, show

app = App(name="figures")


@app.default
def figures(
    *,
    out: Annotated[Path, Parameter(help="Folder for the figures; made if it does not exist.")],
    format: Annotated[list[Literal["svg", "pdf", "png"]], Parameter(help="One or more formats.")] = ["svg"],  # noqa: B006
    json: AsJson = False,
) -> None:
    """Redo the source's figures of chapters 2 to 5."""
    from palmar.faces.exports.whole_file import make_folder
    from palmar.faces.plots.source_figures import write_source_figures

    written = write_source_figures(make_folder(out), suffixes=tuple(format), progress=progress)
    show("\n".join(map(str, written)), {"files": [str(each) for each in written]}, json)


@app.command
def numbers(*, json: AsJson = False) -> None:
    """The numbers that the source prints beside what palmar finds, with the guarantee, and why some differ."""
    from palmar.faces.source_numbers_record import source_numbers_record, source_numbers_text
    from palmar.studies.source_numbers import source_numbers

    found = source_numbers()
    show(source_numbers_text(found), source_numbers_record(found), json)
