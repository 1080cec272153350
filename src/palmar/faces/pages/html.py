"""Pieces of self-contained pages: tables and pictures."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape

from matplotlib.figure import Figure

from palmar.faces.plots.style import encoded
from palmar.faces.words import Row


def table(heads: Row, rows: Sequence[Row]) -> str:
    """A table as wide as the page allows."""
    top = "".join(f"<th>{escape(each)}</th>" for each in heads)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def picture(figure: Figure, description: str) -> str:
    """A figure inside the page."""
    data = base64.b64encode(encoded(figure)).decode("ascii")
    return f'<figure><img alt="{escape(description)}" src="data:image/svg+xml;base64,{data}"></figure>'
