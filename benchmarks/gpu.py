"""The same starts on this machine's processors and on its CUDA device: rates, and whether they end alike.

    python3 dev.py bench gpu

Says in one line that it is left out where there is no device. Rates are of whole batches, copies to and from the device
included, after a first batch that compiles. Ends count as the same within a nanometre (1e-9 rad). Status 1 if more than a
ten-thousandth of the outcomes differ, or more than a fiftieth of the ends.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numba import cuda

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.pushing.closing import Ends, close_disk
from palmar.models.shipped import open_case
from palmar.worlds.planar.free import FreeWorld, free_world
from palmar.worlds.planar.on_gpu import free_ends, refuse_without_gpu, table_ends
from palmar.worlds.planar.table import TableWorld, table_world

THREADS = os.cpu_count() or 1
SAME, OUTCOMES_APART, ENDS_APART = 1e-9, 1e-4, 0.02
Carry = Callable[[np.ndarray], Ends]


def on_table(name: str) -> tuple[Carry, Carry]:
    """What carries starts (N, 5) of a shipped case: processors, device."""
    world: TableWorld = table_world(open_case(name)[1])
    return (
        lambda starts: close_disk(world.hand, world.surface, starts[:, :2], world.tables, threads=THREADS),
        lambda starts: table_ends(world, starts[:, :2]),
    )


def in_free_space(name: str, restitution: float) -> tuple[Carry, Carry]:
    """The same of a case in free space."""
    world: FreeWorld = replace(free_world(open_case(name)[1]), restitution=restitution)

    def here(starts: np.ndarray) -> Ends:
        found = capture_all(
            world.hand, starts[:, :2], starts[:, 3:], restitution, law=world.law, threads=THREADS
        )  # fmt: skip
        return Ends(found.codes, np.column_stack([found.ends[:, :2], starts[:, 2]]), found.ends[:, 7:9])

    return here, lambda starts: free_ends(world, starts)


QUESTIONS = {
    "table": (on_table("testbed_table"), 4_000_000),
    "table, thick fingers": (on_table("testbed_table_thick"), 4_000_000),
    "free, restitution 1": (in_free_space("testbed_free", 1.0), 1_000_000),
    "free, restitution 0.7": (in_free_space("testbed_free", 0.7), 1_000_000),
    "free, restitution 0": (in_free_space("testbed_free", 0.0), 200_000),
    "free, thick fingers, restitution 0": (in_free_space("testbed_free_thick", 0.0), 200_000),
}


def timed(carry: Carry, starts: np.ndarray) -> tuple[Ends, float, float]:
    """Ends, starts a second, and the seconds that a first small batch took."""
    began = time.perf_counter()
    carry(starts[:1000])
    first = time.perf_counter() - began
    began = time.perf_counter()
    ends = carry(starts)
    return ends, len(starts) / (time.perf_counter() - began), first


def main() -> int:
    """Status 1 if the device ends otherwise than the processors."""
    try:
        refuse_without_gpu()
    except NotCoveredError as refusal:
        print(f"bench gpu: left out, {refusal}")
        return 0
    print(f"{cuda.current_context().device} and {THREADS} threads, starts a second", flush=True)
    random, wrong = np.random.default_rng(11), False
    for name, ((here, there), number) in QUESTIONS.items():
        starts = np.zeros((number, 5))
        starts[:, :2] = random.uniform([-0.3, 0.0], [0.3, 0.35], (number, 2))
        starts[:, 3:] = random.normal(0.0, 0.02, (number, 2))
        known, rate, _ = timed(here, starts)
        found, fast, first = timed(there, starts)
        apart = np.abs(np.column_stack([known.poses - found.poses, known.fingers - found.fingers])).max(axis=1)
        otherwise, off = float(np.mean(known.codes != found.codes)), float(np.mean(apart > SAME))
        wrong |= otherwise > OUTCOMES_APART or off > ENDS_APART
        print(
            f"{name:36} processors {rate:10.3g}, device {fast:10.3g}, {fast / rate:6.1f} times; first batch {first:.1f} s;"
            f" outcomes apart {otherwise:.2g}, ends apart {off:.2g}",
            flush=True,
        )
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
