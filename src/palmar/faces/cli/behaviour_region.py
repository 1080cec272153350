"""``palmar behaviours region``: from where a behaviour under feedback catches the object."""

from __future__ import annotations

import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import cpu_count, get_context
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from palmar.errors import InputError
from palmar.faces.cli.behaviour_options import (
    Layout,
    Massive,
    Named,
    Number,
    Track,
    Velocity,
    tracker_of,
    with_behaviour,
    with_velocity,
    within,
)
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, show
from palmar.faces.cli.region_options import fineness
from palmar.faces.cli.texts import region_text, titled
from palmar.faces.cli.world_option import Physics, maker_of
from palmar.faces.records import region_record
from palmar.mechanics.batch import allot
from palmar.models.shipped import open_case

MOST_DRAWS = 1000


def region(
    case: CaseName,
    *,
    behaviour: Named = None,
    velocity: Velocity = None,
    sensors: Layout = None,
    track: Track = None,
    seed: Annotated[int, Parameter(help="Of the tracker's errors: of the first of their draws.")] = 0,
    draws: Annotated[
        int, Parameter(help="Of the tracker's errors, with each of which a start has to be caught; the same for all.")
    ] = 1,
    massive: Massive = None,
    world: Physics = "planar",
    tick: Annotated[Number, Parameter(help="Time between two observations in ms.")] = "20",
    tolerance: Annotated[str | None, Parameter(help="In mm: how far starts may be apart at the boundary.")] = None,
    out: Annotated[Path | None, Parameter(help="Also write a file: svg, pdf, png, dxf, geojson, csv or json.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """From where a behaviour catches the object, by running it in a world from a grid of starts."""
    from palmar.studies.behaviour_region import behaviour_region
    from palmar.studies.run_behaviour import Circumstances

    if out is not None:
        from palmar.faces.exports.region_file import known_ending

        known_ending(out)
    name, given = open_case(case)
    given = with_velocity(with_behaviour(given, behaviour, sensors), velocity)
    if not 0 <= seed < 2**32:
        raise InputError("--seed", str(seed), f"must be from 0 to {2**32 - 1}")
    tracker = tracker_of(track, seed)
    if not 1 <= draws <= MOST_DRAWS:
        raise InputError("--draws", str(draws), f"must be from 1 to {MOST_DRAWS}")
    seconds = 1e-3 * within("--tick", tick, 1.0, 1000.0)
    circumstances = Circumstances(tick=seconds, massive=massive, tracker=tracker, make=maker_of(world))
    finely = fineness(tolerance, given)
    shows = sys.stderr.isatty()

    def report(done: int) -> None:
        print(f"\rpalmar: {done} runs", end="", file=sys.stderr, flush=True)

    # A fresh interpreter for each process: one forked from threads may wait forever.
    pool = ProcessPoolExecutor(cpu_count(), mp_context=get_context("spawn"), initializer=allot, initargs=(1,))
    try:
        result = behaviour_region(given, pool, finely, circumstances, report if shows else None, draws)
    finally:
        pool.shutdown(cancel_futures=True)
        if shows:
            print(file=sys.stderr)
    record = region_record(result)
    if out is not None:
        from palmar.faces.exports.region_file import write_region

        write_region(out, given, result, from_object=False, record=record)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, given, region_text(result), *written), record, json)
    answer(not result.centre.is_empty, check)
