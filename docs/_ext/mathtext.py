"""Formulas as inline SVG, set by Matplotlib's mathtext: no LaTeX, no script and no network at build or reading time.

The outlines take the colour of the surrounding text, sit on its baseline and scale with it; the TeX source is the
label a screen reader speaks. A block may hold several lines, parted by a double backslash. What mathtext cannot set
is a warning, hence an error under `-W`.
"""

from __future__ import annotations

import re
from html import escape

from docutils import nodes
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser
from matplotlib.path import Path
from matplotlib.textpath import TextPath, TextToPath
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

LOG = logging.getLogger(__name__)
SIZE = TextToPath.FONT_SCALE  # drawing units per em: the size at which mathtext itself measures
ENLARGE = 1.1  # STIX has a smaller x-height than the sans serif of the text
COMMANDS = {int(Path.MOVETO): "M", int(Path.LINETO): "L", int(Path.CURVE3): "Q", int(Path.CURVE4): "C"}
FONT = FontProperties(size=SIZE, math_fontfamily="stix")
PARSER = MathTextParser("path")


def outline(formula: str) -> str:
    """The filled outlines of a formula as SVG path data, y downwards."""
    words = []
    path = TextPath((0, 0), formula, size=SIZE, prop=FONT)
    for vertices, code in path.iter_segments(simplify=False, curves=True):
        if code == Path.CLOSEPOLY:
            words.append("Z")
            continue
        points = [f"{round(x, 1):g} {round(-y, 1):g}" for x, y in vertices.reshape(-1, 2)]
        words.append(COMMANDS[int(code)] + " ".join(points))
    return "".join(words)


def spell(tex: str, block: bool) -> str:
    r"""TeX in mathtext's dialect: no \le, no space before a function's name, small fractions even in a block."""
    tex = re.sub(r"\\([lg])e(?![a-z])", r"\\\1eq", " ".join(tex.split()))
    tex = re.sub(r"(?<=[\w)}])\s*(?=\\(arc)?(sin|cos|tan)(?![a-z]))", r"\\,", tex)
    return tex.replace(r"\frac", r"\dfrac") if block else tex


def svg(tex: str, block: bool) -> str:
    """One line of TeX as an SVG element."""
    formula = f"${spell(tex, block)}$"
    width, height, depth = PARSER.parse(formula, 72, FONT)[:3]
    em = ENLARGE / SIZE
    box = f"0 {depth - height:.1f} {width:.1f} {height:.1f}"
    style = f"width:{width * em:.3f}em;height:{height * em:.3f}em;vertical-align:{-depth * em:.3f}em"
    return (
        f'<svg class="mathtext" role="img" aria-label="{escape(tex.strip())}" viewBox="{box}" style="{style}">'
        f'<path d="{outline(formula)}"/></svg>'
    )


def write(translator: HTML5Translator, node: nodes.math | nodes.math_block, lines: list[str]) -> None:
    """Put one formula, drawn line by line, into the page."""
    block = isinstance(node, nodes.math_block)
    try:
        drawn = [svg(line, block) for line in lines]
    except ValueError as error:
        LOG.warning("mathtext cannot set %r: %s", node.astext(), error, location=node, type="mathtext")
        drawn = [escape(node.astext())]
    tag = "div" if block else "span"
    identity = "".join(f'<span id="{name}"></span>' for name in node["ids"]) if block else ""
    rows = "".join(f"<div>{row}</div>" for row in drawn) if block else drawn[0]
    translator.body.append(f'{identity}<{tag} class="math-{"block" if block else "inline"}">{rows}</{tag}>')
    raise nodes.SkipNode


def visit_math(translator: HTML5Translator, node: nodes.math) -> None:
    """A formula within a line."""
    write(translator, node, [node.astext()])


def visit_math_block(translator: HTML5Translator, node: nodes.math_block) -> None:
    """A formula, or several lines of them, set apart."""
    source = re.sub(r"\\(begin|end)\{[a-z]+\*?\}|(?<!\\)&", "", node.astext())
    write(translator, node, [line for line in source.split(r"\\") if line.strip()])


def setup(app: Sphinx) -> dict[str, object]:
    """Announce the renderer to Sphinx; `html_math_renderer = "mathtext"` selects it."""
    app.add_html_math_renderer(
        "mathtext", inline_renderers=(visit_math, None), block_renderers=(visit_math_block, None)
    )
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
