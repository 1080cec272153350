"""Functions of one hand in plain numbers, asked for many hands."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
FEW = 32
"""Hands that are not worth loading the compiler for."""


def of_each_hand(function: Callable[..., float], called: tuple[Callable[..., float], ...], *columns: Floats) -> Floats:
    """The function, which calls those ``called``, of every row of flat columns.

    A few rows are worked out sooner than the compiler is loaded; many are compiled.
    """
    if columns[0].size > FEW:
        from palmar.mechanics.compiled import over_arrays

        return np.asarray(over_arrays(function, called)(*columns))
    return np.array([function(*map(float, each)) for each in zip(*columns, strict=True)], dtype=float)
