"""The same questions answered by palmar and in the ways a user would do it today, all in one run: rates and their ratios.

    python3 dev.py bench comparison [--write]

Machines differ, ratios hardly: the ratios of this run are compared with those of the last release in benchmarks/history,
and one that has fallen by more than a fifth is reported (status 1). ``--write`` keeps this run's for the present version
and writes docs/results/comparison.md.
"""

from __future__ import annotations

import json
import os
import platform
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from importlib.metadata import version
from math import pi
from pathlib import Path

import numpy as np
import pymunk
from test_mujoco_ratio import STEP, rollouts

from palmar.mechanics.batch import allotted
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_hand import closing_hand
from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.limit_surface import disk_surface, ellipsoid_surface
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.models.sweep_file import open_sweep
from palmar.regions.build import build_region
from palmar.studies.closure_map import grid_map
from palmar.studies.sweep.local import local_engine
from palmar.studies.sweep.run import run_sweep
from palmar.studies.sweep.store import Store

HISTORY = Path(__file__).parent / "history"
PAGE = Path(__file__).parents[1] / "docs" / "results" / "comparison.md"
HALF_PALM, LENGTH, RADIUS = 0.06, 0.244, 0.038
FALLEN = 0.8
"""A ratio below this share of the last release's is reported."""
CAUGHT = [each.code for each in Outcome if each.caught]
Rates = dict[str, float]
"""Of each way, a second."""


def starts_on_table(number: int) -> np.ndarray:
    """Centres (number, 2) in m before the test-bed hand."""
    return np.random.default_rng(4).uniform([-0.3, 0.045], [0.3, 0.28], (number, 2))


def timed(action: Callable[[], object], number: int, rounds: int = 3) -> float:
    """Things a second, the best of a few rounds."""
    took = []
    for _ in range(rounds):
        began = time.perf_counter()
        action()
        took.append(time.perf_counter() - began)
    return number / min(took)


def numpy_loop(starts: np.ndarray, steps: int) -> np.ndarray:
    """Whether frictionless closing catches each disk: all starts in one array, pushed out of the fingers step by step."""
    place, stalled = starts.copy(), np.zeros(len(starts), dtype=bool)
    for psi in np.linspace(0.0, pi, steps):
        for _ in range(3):
            deepest = np.zeros(len(place))
            for side in (1.0, -1.0):
                along = np.array([side * np.cos(psi), np.sin(psi)])
                beside = place - (side * HALF_PALM, 0.0)
                nearest = np.clip(beside @ along, 0.0, LENGTH)[:, None] * along
                away = beside - nearest
                distance = np.maximum(np.linalg.norm(away, axis=1), 1e-12)
                deep = np.maximum(RADIUS - distance, 0.0)
                deepest = np.maximum(deepest, deep)
                place = np.where(stalled[:, None], place, place + (deep / distance)[:, None] * away)
            deepest = np.maximum(deepest, RADIUS - place[:, 1])
            place[:, 1] = np.maximum(place[:, 1], RADIUS)
        stalled |= deepest > 2.0 * RADIUS * pi / steps
    return stalled


def pymunk_loop(places: np.ndarray, steps: int = 3000) -> None:
    """Disks in free space before a closing hand, ten to a space, by an impulse engine."""
    for first in range(0, len(places), 10):
        space = pymunk.Space()
        for side in (1.0, -1.0):
            finger = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
            finger.position, finger.angular_velocity = (side * 6.0, 0.0), side
            shape = pymunk.Segment(finger, (0.0, 0.0), (side * 24.4, 0.0), 0.0)
            shape.elasticity = 1.0
            space.add(finger, shape)
        palm = pymunk.Segment(space.static_body, (-6.0, 0.0), (6.0, 0.0), 0.0)
        palm.elasticity = 1.0
        space.add(palm)
        for x, y in places[first : first + 10]:
            disk = pymunk.Body(1.0, 7.22)
            disk.position = (float(x), float(y))
            circle = pymunk.Circle(disk, 3.8)
            circle.elasticity, circle.filter = 0.9, pymunk.ShapeFilter(group=1)
            space.add(disk, circle)
        for _ in range(steps):
            space.step(1.66 / steps)


def on_the_table() -> Rates:
    """Starts a second: from which of these is the disk caught, friction 0.7 (0 for the numpy loop)?"""
    surface, found = ellipsoid_surface(2.0 / 3.0 * RADIUS), {}
    many, few = starts_on_table(1_000_000), starts_on_table(96)
    hand = ClosingHand(HALF_PALM, LENGTH, 0.0, RADIUS, 0.7, 0.0, pi)
    tables = build_tables(hand, surface)
    close_disk(hand, surface, many[:1000], tables)
    for threads in (1, 2):
        with allotted(threads):
            rate = timed(lambda: close_disk(hand, surface, many, tables), len(many))
        found[f"palmar, {threads} thread{'s'[: threads - 1]}"] = rate
    rollouts(0.7, few[:2], STEP)
    found["MuJoCo rollouts, all processors"] = timed(lambda: rollouts(0.7, few, STEP), len(few), 1)
    found["a numpy loop"] = timed(lambda: numpy_loop(many[:20_000], 1800), 20_000, 1)
    return found


def agreement() -> float:
    """Share of starts for which the numpy loop says what palmar says."""
    surface, starts = disk_surface(RADIUS), starts_on_table(4000)
    hand = ClosingHand(HALF_PALM, LENGTH, 0.0, RADIUS, 0.0, 0.0, pi)
    ends = close_disk(hand, surface, starts, build_tables(hand, surface))
    return float(np.mean(np.isin(ends.codes, CAUGHT) == numpy_loop(starts, 1800)))


def in_free_space() -> Rates:
    """Starts a second: which of these disks does the closing hand capture, restitution 0.9?"""
    random = np.random.default_rng(0)
    places = np.column_stack([random.uniform(0.0, 31.0, 400_000), random.uniform(3.8, 29.0, 400_000)])
    hand, found = closing_hand(6.0, [24.4], 3.8), {}
    capture_all(hand, places[:1000], restitution=0.9)
    for threads in (1, 2):
        with allotted(threads):
            rate = timed(lambda: capture_all(hand, places, restitution=0.9), len(places))
        found[f"palmar, {threads} thread{'s'[: threads - 1]}"] = rate
    found["pymunk"] = timed(lambda: pymunk_loop(places[:400]), 400)
    return found


def whole_answers() -> Rates:
    """Answers a second: exact regions, a closure map's points."""
    _, table = open_case("testbed_table")
    _, free = open_case("zero_g_example")
    build_region(table)
    build_region(free)
    return {
        "region of a disk on the table": timed(lambda: build_region(table), 1, 5),
        "region of a disk in free space": timed(lambda: build_region(free), 1, 2),
        "points of the closure map": timed(lambda: grid_map(200), 200 * 200),
    }


def sweeps() -> Rates:
    """Rows a second of the shipped sweep, eight times as long, from the first shard to the last, written."""
    asked, found = replace(open_sweep("sweep_table"), samples=200_000), {}
    for workers in (1, 2):
        with tempfile.TemporaryDirectory() as folder, local_engine(workers) as engine:
            engine.rate(asked)
            done = run_sweep(asked, Store(f"{folder}/out"), engine)
            found[f"palmar sweep, {workers} process{'es'[: 2 * (workers - 1)]}"] = done.rows / done.seconds
    return found


QUESTIONS = {
    "on the table": (on_the_table, ("MuJoCo rollouts, all processors", "a numpy loop")),
    "in free space": (in_free_space, ("pymunk",)),
    "whole answers": (whole_answers, ()),
    "sweeps": (sweeps, ()),
}


def ratios(rates: dict[str, Rates]) -> Rates:
    """How many times faster palmar is than each other way, and the second processor than the first."""
    found = {}
    for name, (_, others) in QUESTIONS.items():
        mine = [rate for way, rate in rates[name].items() if way.startswith("palmar")]
        found |= {f"{name}: {other}": max(mine) / rates[name][other] for other in others}
        if len(mine) == 2:
            found[f"{name}: two processors to one"] = mine[1] / mine[0]
    return found


def last_release() -> tuple[str, Rates] | None:
    """Version and ratios of the newest release that is kept."""
    kept = sorted(
        HISTORY.glob("*.json"), key=lambda each: [int(part) for part in each.stem.split(".") if part.isdigit()]
    )
    return (kept[-1].stem, json.loads(kept[-1].read_text())["ratios"]) if kept else None


def page(rates: dict[str, Rates], found: Rates, same: float) -> str:
    """The table for the documentation."""
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30
    packages = ", ".join(f"{name} {version(name)}" for name in ("palmar", "numpy", "numba", "mujoco", "pymunk"))
    rows = [f"| {name} | {way} | {rate:,.3g} |" for name, each in rates.items() for way, rate in each.items()]
    more = [f"| {name} | {ratio:,.3g} |" for name, ratio in found.items()]
    return "\n".join(
        [
            "# palmar and other ways to ask", "",
            f"Command: `python3 dev.py bench comparison --write`, {date.today().isoformat()}.",
            f"Machine: {os.cpu_count()} processors, {memory:.0f} GiB; Python {platform.python_version()}, {packages}.", "",
            "| question | way | a second |", "|---|---|---|", *rows, "",
            "| ratio | times |", "|---|---|", *more, "",
            "The numpy loop has no friction and small steps;",
            f"it agrees with palmar's closed form on {same:.1%} of 4000 starts.", "",
        ]
    )  # fmt: skip


def main(words: list[str]) -> int:
    """Status 1 if a ratio has fallen."""
    rates = {}
    for name, (ask, _) in QUESTIONS.items():
        rates[name] = ask()
        print(name, *(f"\n  {way:34} {rate:12,.4g} a second" for way, rate in rates[name].items()), flush=True)
    found, before = ratios(rates), last_release()
    fallen = []
    for name, ratio in found.items():
        was = before[1].get(name) if before is not None else None
        print(f"{name:48} {ratio:10,.4g}" + ("" if was is None or before is None else f"   {before[0]}: {was:,.4g}"))
        if was is not None and ratio < FALLEN * was:
            fallen.append(name)
    for name in fallen:
        print(f"FALLEN by more than a fifth: {name}", file=sys.stderr)
    if "--write" in words:
        HISTORY.mkdir(exist_ok=True)
        kept = json.dumps({"date": date.today().isoformat(), "rates": rates, "ratios": found}, indent=1)
        (HISTORY / f"{version('palmar')}.json").write_text(kept + "\n")
        PAGE.write_text(page(rates, found, agreement()))
    return int(bool(fallen))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
