"""``palmar figures``: every figure of the source's chapters, drawn anew."""

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
    """Redo the source's figures 2.1 to 2.8, 3.2 and 3.3."""
    from palmar.faces.exports.whole_file import make_folder
    from palmar.faces.plots.source_figures import write_source_figures

    written = write_source_figures(make_folder(out), suffixes=tuple(format), progress=progress)
    show("\n".join(map(str, written)), {"files": [str(each) for each in written]}, json)
