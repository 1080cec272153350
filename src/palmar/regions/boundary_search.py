"""Which nodes of a square grid belong to a set that can only be asked about node by node, asked along its boundary.

All nodes of a coarse grid are asked. The grid is then halved again and again: a new node between nodes that agree is taken
to agree with them, one between nodes that differ is asked. After that, whoever has a neighbour that differs from him, and
has not been asked, is asked too, until there is none left: the boundary is traced wherever it leads. So at the end every
node next to one that differs has been asked; what lies between nodes that agree, and hangs together with no boundary that
was met, is not seen.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Inside = Callable[[Floats, Floats], Bools]
"""Which of the points (N,), (N,), m, are in the set."""


@dataclass(frozen=True)
class Nodes:
    """Whether each node (rows: y, columns: x) is in the set; the step (m) of the grid."""

    held: Bools
    step: float


@dataclass(frozen=True)
class Box:
    """Where to search (m): a box about the y axis from y = 0, and the number of its coarse cells across, even.

    ``mirrored``: the set is known to be its own mirror image, so only x >= 0 is asked.
    """

    width: float
    height: float
    cells: int
    mirrored: bool


def nodes_inside(inside: Inside, box: Box, levels: int) -> Nodes:
    """The nodes in the set, on the grid of ``box`` halved ``levels`` times."""
    step = box.width / box.cells
    known = np.zeros((ceil(box.height / step) + 1, box.cells + 1), bool)
    held = known.copy()
    _ask(inside, box, step, held, known, ~known)
    for _ in range(levels):
        step *= 0.5
        held, known, asked = _halved(held, known)
        while asked.any():
            _ask(inside, box, step, held, known, asked)
            asked = any_near(held) & any_near(~held) & ~known
    return Nodes(held, step)


def any_near(nodes: Bools) -> Bools:
    """Whether a node or one of its eight neighbours is set; beyond the grid none is."""
    wide = np.pad(nodes, 1)
    rows = wide[:-2] | wide[1:-1] | wide[2:]
    found: Bools = rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:]
    return found


def all_near(nodes: Bools) -> Bools:
    """Whether a node and all of its eight neighbours are set; beyond the grid none is."""
    wide = np.pad(nodes, 1)
    rows = wide[:-2] & wide[1:-1] & wide[2:]
    found: Bools = rows[:, :-2] & rows[:, 1:-1] & rows[:, 2:]
    return found


def _halved(held: Bools, known: Bools) -> tuple[Bools, Bools, Bools]:
    """The grid of half the step: nodes held or taken to be held, known, and to be asked."""
    shape = (2 * held.shape[0] - 1, 2 * held.shape[1] - 1)
    finer, asked, settled = np.zeros(shape, bool), np.zeros(shape, bool), np.zeros(shape, bool)
    finer[::2, ::2], settled[::2, ::2] = held, known
    for into, along in ((np.s_[1::2, ::2], (held[:-1], held[1:])), (np.s_[::2, 1::2], (held[:, :-1], held[:, 1:]))):
        finer[into], asked[into] = along[0] & along[1], along[0] ^ along[1]
    corners = held[:-1, :-1], held[1:, :-1], held[:-1, 1:], held[1:, 1:]
    every, some = np.logical_and.reduce(corners), np.logical_or.reduce(corners)
    finer[1::2, 1::2], asked[1::2, 1::2] = every, some & ~every
    return finer, settled, asked


def _ask(inside: Inside, box: Box, step: float, held: Bools, known: Bools, asked: Bools) -> None:
    """Ask about nodes, and write what was found to ``held`` and ``known``."""
    last = held.shape[1] - 1
    if box.mirrored:
        asked = asked | asked[:, ::-1]
        asked[:, : last // 2] = False
    rows, columns = np.nonzero(asked)
    x, y = step * (columns.astype(np.float64) - 0.5 * last), step * rows.astype(np.float64)
    found = inside(x, y)
    held[rows, columns], known[rows, columns] = found, True
    if box.mirrored:
        held[rows, last - columns], known[rows, last - columns] = found, True
