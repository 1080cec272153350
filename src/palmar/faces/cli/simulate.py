"""``palmar simulate``: what becomes of an object that starts here."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.device_option import Processor, device_of
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, numbers, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.cli.world_option import Physics, maker_of
from palmar.faces.records import simulation_record, starts_record
from palmar.models.case import Case
from palmar.models.device import Device
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.mechanics.pushing.closing import Ends
    from palmar.studies.simulate import Simulation

app = App(name="simulate")

Text = Annotated[str | None, Parameter(allow_leading_hyphen=True)]


@app.default
def simulate(
    case: CaseName,
    *,
    start: Annotated[Text, Parameter(help="X_MM,Y_MM[,THETA_DEG]; else the case's start.")] = None,
    velocity: Annotated[Text, Parameter(help="VX,VY in mm/s.")] = None,
    starts: Annotated[Path | None, Parameter(help="A CSV file: x_mm,y_mm[,theta_deg,vx_mm_s,vy_mm_s].")] = None,
    world: Physics = "planar",
    device: Processor = "cpu",
    animate: Annotated[Path | None, Parameter(help="Also write a film: gif, html, or mp4 (needs ffmpeg).")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Carry the object through the closing motion: outcome, final pose, and the events on the way."""
    name, given = open_case(case)
    if starts is not None:
        if start is not None or velocity is not None or animate is not None:
            raise InputError("--starts", None, "cannot be combined with --start, --velocity or --animate")
        from palmar.faces.cli.starts_file import read_starts

        ends = _simulate_starts(given, read_starts(starts), world, device_of(device))
        caught = [Outcome.from_code(int(code)).caught for code in ends.codes]
        show(titled(name, given, _counts(ends.codes)), starts_record(ends), json)
        answer(all(caught), check)
        return
    if device != "cpu":
        raise InputError("--device", device, "is for --starts FILE.csv")
    if animate is not None:
        from palmar.faces.plots.film import known_ending

        known_ending(animate)
        if world != "planar":
            raise InputError("--animate", None, "films are of the world planar")
    begin = _place(given, start, velocity)
    result = _simulate_start(given, begin, world)
    if animate is not None:
        from palmar.faces.plots.film import write_film

        write_film(animate, given, tuple(begin), result)
    rows = [(f"{time:8.3f} s", event.kind, event.body.replace("_", " ")) for time, event in result.events]
    x, y, theta = result.pose
    place = f"({1e3 * x + 0.0:.2f}, {1e3 * y:.2f}) mm, turned {math.degrees(theta):.2f} deg"
    ended = f"{result.outcome.value}: the object ends at {place}"
    show(titled(name, given, ended, *([table(rows)] if rows else [])), simulation_record(result), json)
    answer(result.outcome.caught, check)


def _simulate_start(case: Case, begin: list[float], world: str) -> Simulation:
    from palmar.studies.simulate import simulate_start
    from palmar.studies.simulate_in_world import simulate_start_in

    make = maker_of(world)
    return simulate_start(case, begin) if make is None else simulate_start_in(case, begin, make)


def _simulate_starts(case: Case, starts: np.ndarray, world: str, device: Device) -> Ends:
    from palmar.studies.simulate import simulate_starts
    from palmar.studies.simulate_in_world import simulate_starts_in

    make = maker_of(world)
    if make is None:
        return simulate_starts(case, starts, device)
    if device is not Device.CPU:
        raise InputError("--device", device.value, "is for --world planar")
    return simulate_starts_in(case, starts, make)


def _place(case: Case, start: str | None, velocity: str | None) -> list[float]:
    x, y = case.start.at
    theta, (vx, vy) = case.start.theta, case.start.velocity
    if start is not None:
        values = numbers(start, "--start", (2, 3), "X_MM,Y_MM[,THETA_DEG]")
        x, y = 1e-3 * values[0], 1e-3 * values[1]
        theta = math.radians(values[2]) if len(values) == 3 else theta
    if velocity is not None:
        vx, vy = (1e-3 * each for each in numbers(velocity, "--velocity", (2,), "VX,VY"))
    return [x, y, theta, vx, vy]


def _counts(codes: np.ndarray) -> str:
    found, amounts = np.unique(codes, return_counts=True)
    rows = [(Outcome.from_code(int(code)).value, str(count)) for code, count in zip(found, amounts, strict=True)]
    return table([*rows, ("starts", str(len(codes)))])
