"""Batches of starts on a CUDA device, one thread for each start, by the same mechanics as on processors.

A kernel here reads a start, calls the function that the batch for processors calls (``close_on_disk``, ``capture_on``) and
stores its end. That function and all that it calls are compiled for the device from their one source.
"""

from __future__ import annotations

import dis
from functools import cache
from importlib.util import find_spec
from math import atan
from types import FunctionType
from typing import Any

import numpy as np
from numba import config, cuda, float64
from numba.core.dispatcher import Dispatcher
from numpy.typing import ArrayLike, NDArray

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import MOST_EVENTS
from palmar.mechanics.impact.capture_run import capture_on
from palmar.mechanics.impact.capture_state import (
    EVENT_WIDTH,
    MOST_TOUCHING,
    STATE_WIDTH,
    TOUCHING_WIDTH,
    Bench,
    T,
    X,
    Y,
)  # fmt: skip
from palmar.mechanics.impact.collision import ImpactLaw
from palmar.mechanics.impact.finger_motion import FINGER_WIDTH, MOST_LINKS, CaptureHand, turned
from palmar.mechanics.impact.slowed import covered
from palmar.mechanics.pushing.closing import Ends
from palmar.mechanics.pushing.closing_disk import close_on_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand, Tables
from palmar.worlds.planar.free import FreeWorld
from palmar.worlds.planar.table import TableWorld

Floats = NDArray[np.float64]
Codes = NDArray[np.int8]
ROWS_PER_LAUNCH, THREADS_PER_BLOCK = 1 << 20, 64
"""A launch's starts and ends are 80 MB at most; blocks are small, so that one slow start keeps few others waiting."""
CHAIN_SHAPE = (2 * MOST_LINKS + 2, 2)
_settings: Any = config
_settings.CUDA_LOW_OCCUPANCY_WARNINGS = 0  # that few starts leave a device idle is nothing to warn of


def refuse_without_gpu() -> None:
    """Raise NotCoveredError where no CUDA device can be used, and say what is missing."""
    if find_spec("numba_cuda") is None and not _settings.ENABLE_CUDASIM:
        raise NotCoveredError('device "gpu": needs the extra, pip install "palmar[gpu]"')
    if not cuda.is_available():
        raise NotCoveredError('device "gpu": no CUDA device, or no driver for it, is found on this machine')


def table_ends(world: TableWorld, starts: ArrayLike) -> Ends:
    """As ``TableWorld.ends``, on the device; raises NotCoveredError without one."""
    hand = ClosingHand(*map(float, world.hand))
    return _ends(_close, starts, hand, world.tables, atan(hand.friction))


def free_ends(world: FreeWorld, starts: ArrayLike) -> Ends:
    """As ``FreeWorld.ends``, on the device; raises NotCoveredError without one."""
    law, no_log = ImpactLaw(*map(float, covered(world.hand, world.law))), np.empty((0, EVENT_WIDTH))
    return _ends(_capture, starts, world.hand, law, no_log, float(world.restitution))


def _ends(kernel: Any, starts: ArrayLike, *world: Any) -> Ends:
    refuse_without_gpu()
    rows, there = np.asarray(starts, dtype=float), _to_device(world)
    codes, ends = np.empty(len(rows), np.int8), np.empty((len(rows), 5))
    for first in range(0, len(rows), ROWS_PER_LAUNCH):
        some = slice(first, first + ROWS_PER_LAUNCH)
        places = _to_device(rows[some])
        its_codes, its_ends = cuda.device_array(len(places), np.int8), cuda.device_array((len(places), 5))
        kernel[-(-len(places) // THREADS_PER_BLOCK), THREADS_PER_BLOCK](*there, places, its_codes, its_ends)
        its_codes.copy_to_host(codes[some])
        its_ends.copy_to_host(ends[some])
    return Ends(codes, ends[:, :3], ends[:, 3:])


def _to_device(given: Any) -> Any:
    """Arrays are copied; a named tuple of arrays and numbers stays one."""
    if isinstance(given, tuple):
        return type(given)(*map(_to_device, given)) if hasattr(given, "_fields") else tuple(map(_to_device, given))
    return cuda.to_device(np.ascontiguousarray(given)) if isinstance(given, np.ndarray) else given


@cache
def _on_device(kernel: Any) -> Any:
    """A compiled function of the mechanics, and all that it calls, as functions for the device.

    Where a kernel calls them directly numba does the same, but not in its simulator of a device (NUMBA_ENABLE_CUDASIM=1), in
    which these run as Python. ``CONTRACT`` is a device's habit anyway.
    """
    body = kernel.py_func
    names = {each.argval for each in dis.get_instructions(body) if each.opname == "LOAD_GLOBAL"} | {"__builtins__"}
    known = {name: value for name, value in body.__globals__.items() if name in names}
    known |= {name: _on_device(value) for name, value in known.items() if isinstance(value, Dispatcher)}
    return cuda.jit(FunctionType(body.__code__, known, body.__name__), device=True)


_close_on_disk, _capture_on, _turned = _on_device(close_on_disk), _on_device(capture_on), _on_device(turned)


def _close_one(hand: ClosingHand, tables: Tables, alpha: float, starts: Floats, codes: Codes, ends: Floats) -> None:
    """One thread: the end of its row of ``starts`` (N, 2) on the table -> ``codes`` (N,) and ``ends`` (N, 5)."""
    k = cuda.grid(1)
    if k < len(starts):
        end = _close_on_disk(hand, tables, alpha, starts[k, 0], starts[k, 1])
        codes[k] = end.code
        ends[k, 0], ends[k, 1], ends[k, 2], ends[k, 3], ends[k, 4] = end.x, end.y, end.theta, end.right, end.left


def _capture_one(
    hand: CaptureHand, law: ImpactLaw, no_log: Floats, e: float, starts: Floats, codes: Codes, ends: Floats
) -> None:
    """One thread: the end of its row of ``starts`` (N, 5) in free space -> ``codes`` (N,) and ``ends`` (N, 5)."""
    k = cuda.grid(1)
    if k < len(starts):
        state, fingers = cuda.local.array(STATE_WIDTH, float64), cuda.local.array((2, FINGER_WIDTH), float64)
        chain = cuda.local.array(CHAIN_SHAPE, float64)
        touching = cuda.local.array((MOST_TOUCHING, TOUCHING_WIDTH), float64)
        at, row, end = Bench(state, fingers, chain, touching, no_log), starts[k], ends[k]
        codes[k] = _capture_on(hand, law, at, row[0], row[1], row[3], row[4], 0.0, e, MOST_EVENTS)
        end[0], end[1], end[2] = state[X], state[Y], row[2]
        end[3], end[4] = _turned(fingers[0], 0, state[T])[0], _turned(fingers[1], 0, state[T])[0]


_close, _capture = cuda.jit(_close_one, cache=True), cuda.jit(_capture_one, cache=True)
