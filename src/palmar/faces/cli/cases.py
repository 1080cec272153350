"""``palmar cases``: the shipped cases."""

from __future__ import annotations

from typing import Annotated

from cyclopts import App, Parameter

from palmar.faces.cli.printing import AsJson, show
from palmar.faces.cli.texts import table
from palmar.models.shipped import description, shipped_names, shipped_text

app = App(name="cases")


@app.default
def cases(
    name: Annotated[str | None, Parameter(help="Print this shipped case.")] = None, *, json: AsJson = False
) -> None:
    """List the shipped cases, or print one as TOML to start your own from."""
    if name is not None:
        text = shipped_text(name)
        show(text.rstrip("\n"), {"name": name, "toml": text}, json)
        return
    rows = [(each, description(each)) for each in shipped_names()]
    show(table(rows), {"cases": [{"name": each, "description": what} for each, what in rows]}, json)
