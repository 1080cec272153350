"""The mean of one column of a sweep: a line over one number, or a map over two."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from palmar.errors import InputError
from palmar.faces.plots.style import NORMAL, SMALL_SIZE, TEXT_SIZE, Role, new_figure, save

WIDE, HIGH = 120.0, 90.0
SHADES = "cividis"
UNITS = ("mm_s2", "mm_s", "deg_s2", "deg_s", "N_m", "N_mm", "m2", "mm", "deg", "rad", "kg", "m", "s", "N")


def draw_sweep(path: Path, value: str, keys: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """Draw rows (key[, key], mean, count) into a file; raises InputError if there is nothing to draw."""
    kept = [row for row in rows if all(each is not None for each in row)]
    if not kept:
        raise InputError("--value", repr(value), "has no number in any row")
    figure = new_figure(WIDE, HIGH)
    axes = figure.add_axes((0.15, 0.15, 0.80 if len(keys) == 1 else 0.66, 0.78))
    table = np.array([row[:-1] for row in kept], float)
    if len(keys) == 1:
        axes.plot(table[:, 0], table[:, 1], color=Role.CENTRE.line, linewidth=NORMAL)
        axes.set_ylabel(named(value, share=True), fontsize=TEXT_SIZE)
        axes.grid(color=Role.GHOST.fill)
    else:
        bar = figure.colorbar(_map(axes, table), cax=figure.add_axes((0.85, 0.15, 0.03, 0.78)))
        bar.set_label(named(value, share=True), fontsize=TEXT_SIZE)
        bar.ax.tick_params(labelsize=SMALL_SIZE)
        axes.set_ylabel(named(keys[1]), fontsize=TEXT_SIZE)
    axes.set_xlabel(named(keys[0]), fontsize=TEXT_SIZE)
    axes.tick_params(labelsize=SMALL_SIZE)
    count = sum(row[-1] for row in kept)
    axes.set_title(f"{count:,} rows".replace(",", " "), fontsize=SMALL_SIZE, loc="right")
    save(figure, path)


def _map(axes: Axes, table: np.ndarray) -> Any:
    """Cells with no row stay white."""
    across, up = np.unique(table[:, 0]), np.unique(table[:, 1])
    means = np.full((len(up), len(across)), np.nan)
    means[np.searchsorted(up, table[:, 1]), np.searchsorted(across, table[:, 0])] = table[:, 2]
    return axes.pcolormesh(_edges(across), _edges(up), means, cmap=SHADES, rasterized=True)


def _edges(middles: np.ndarray) -> np.ndarray:
    if len(middles) == 1:
        return np.array([middles[0] - 0.5, middles[0] + 0.5])
    between = 0.5 * (middles[1:] + middles[:-1])
    return np.concatenate([[2.0 * middles[0] - between[0]], between, [2.0 * middles[-1] - between[-1]]])


def named(key: str, share: bool = False) -> str:
    """A column's name for people: its unit in brackets, and what a mean of a truth is."""
    section, *rest = key.split(".")
    words, index = (rest[0] if rest else section), (f" {'xy'[int(rest[1])]}" if rest[1:] and rest[1] in "01" else "")
    unit = next((each for each in UNITS if words.endswith(f"_{each}")), None)
    stem = (words if unit is None else words.removesuffix(f"_{unit}")).replace("_", " ")
    stem = "" if stem == "at" else stem
    whole = " ".join(f"{section} {stem}{index}".split()) if rest else stem
    if unit is None:
        return f"share {whole}" if share and key in ("caught", "structural", "frictional", "guaranteed") else whole
    return f"{'mean ' if share else ''}{whole}, {unit.replace('m2', 'm²').replace('_', ' ')}"
