"""How a process of the cell settles in: no pauses of its own making, a rank if the system grants one, and no orphans."""

from __future__ import annotations

import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import parent_process

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Matrices of 4 by 4 gain nothing from more threads, and threads that wake up disturb the servos."""
PLANT_RANK, CONTROLLER_RANK = 20, 10
"""Of SCHED_FIFO."""


def settle(rank: int | None) -> bool:
    """Stop collecting garbage, and take a rank of SCHED_FIFO; whether it was granted.

    Call it before threads are made: they inherit the rank.
    """
    gc.collect()
    gc.freeze()
    gc.disable()
    if rank is None or not hasattr(os, "sched_setscheduler"):
        return False
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(rank))
    except PermissionError:
        return False
    return True


def orphaned() -> bool:
    """Whether the process that started this one is gone."""
    parent = parent_process()
    return parent is not None and not parent.is_alive()


@contextmanager
def environment(values: dict[str, str]) -> Iterator[None]:
    """In which processes are started: these variables are set where the user has not set them."""
    ours = {name: value for name, value in values.items() if name not in os.environ}
    os.environ.update(ours)
    try:
        yield
    finally:
        for name in ours:
            os.environ.pop(name, None)
