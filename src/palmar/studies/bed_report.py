"""The measurements of chapter 6, repeated: limits on the table, limits in free space, and the preshape that circles.

Candidate causes of the gaps to the source's theory are varied one at a time. Each limit is searched as the source did
(``limits``) and known to the tolerance. Nothing is tuned to match; where several causes fit none is claimed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from math import radians
from typing import Any

import numpy as np

from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Fingers, Hand
from palmar.models.outcome import Outcome
from palmar.models.support import Pressure, Support, SupportKind
from palmar.regions.build import build_region
from palmar.regions.region import Model, Region
from palmar.studies.limits import Rules, limits, reach
from palmar.studies.preshape_trial import circling_curl
from palmar.studies.simulate import simulate_starts
from palmar.worlds.planar.feedback import feedback_world
from palmar.worlds.world import WorldMaker

ANGLES = tuple(radians(each) for each in (15.0, 30.0, 45.0, 67.5, 90.0))
"""On the table: of the object's centre from the palm's middle, from its outward line."""
FREE_ANGLES = tuple(radians(each) for each in (15.0, 30.0, 45.0, 60.0, 75.0, 90.0))
"""In free space: of the first contact from the right joint."""
COARSE = 4e-3
"""Spacing (m) of starts for fingers that impacts slow: these are slow to simulate."""
TOLERANCE, THICKNESS, BED_RATE = 5e-4, 0.025, radians(15.0)
RATES = (10.0, 20.0, 40.0, 80.0)
"""Closing rates (deg/s) tried."""
TURNS = 400
"""Random starts whose final turn is looked at."""


@dataclass(frozen=True)
class Row:
    """Limits (m) in the directions ``ANGLES`` or ``FREE_ANGLES``, None where nothing is caught; how they were found."""

    name: str
    physics: str
    limits: tuple[float | None, ...]


@dataclass(frozen=True)
class Turn:
    """Median and largest final turn (rad) of caught starts in the region."""

    name: str
    median: float
    largest: float


@dataclass(frozen=True)
class Preshape:
    """The curl (rad) with which the disk keeps to a circle, by the kernels and in the other world."""

    name: str
    kernels: float
    other: float


@dataclass(frozen=True)
class BedReport:
    """Table, final turns, free space and preshapes; the first rows of table and free space are the source's theory."""

    table: tuple[Row, ...]
    turns: tuple[Turn, ...]
    free: tuple[Row, ...]
    preshapes: tuple[Preshape, ...]


@dataclass(frozen=True)
class Worlds:
    """Makers of the two MuJoCo worlds, ideal servos and the bed's."""

    ideal: WorldMaker
    bed: WorldMaker


def bed_report(case: Case, worlds: Worlds, executor: Executor, tell: Callable[[str], None]) -> BedReport:
    """Of a case with line fingers that may cross, on a table; ``tell`` hears what is being done."""
    space = _changed(case, support=case.support.model_copy(update={"kind": SupportKind.FREE}))
    joint = case.hand.half_palm, 0.0
    published = build_region(case, Model.PUBLISHED).centre
    table: tuple[Row, ...] = (
        Row("published theory", "construction", tuple(reach(published, (0.0, 0.0), each) for each in ANGLES)),
    )
    free = tuple(
        _contacts(f"{model.value} theory", "construction", build_region(space, model), joint)
        for model in (Model.PUBLISHED, Model.CORRECTED)
    )
    for name, physics, varied, make in (*_on_the_table(case), *_in_mujoco(case, worlds)):
        tell(f"table: {name}, {physics}")
        table += (Row(name, physics, _limits(varied, (0.0, 0.0), make, executor)),)
    for name, varied in _in_space(space):
        tell(f"free: {name}")
        slowed = varied.hand.finger_mass is not None
        region = build_region(varied, tolerance=COARSE if slowed else None)
        free += (_contacts(name, "kernels", region, joint),)
    tell("final turns and preshapes")
    turns = tuple(_turn(name, varied) for name, _, varied, _ in _on_the_table(case))
    return BedReport(table, turns, free, tuple(_preshapes(case, worlds)))


def _changed(case: Case, **changes: Any) -> Case:
    return case.model_copy(update=changes)


def _hand(case: Case, **changes: Any) -> Case:
    return _changed(case, hand=Hand.model_validate(case.hand.model_dump() | changes))


def _bed_hand(case: Case) -> Case:
    return _hand(case, finger_thickness=THICKNESS, fingers=Fingers.COLLIDING)


Varied = tuple[str, str, Case, WorldMaker | None]


def _on_the_table(case: Case) -> Iterator[Varied]:
    """One change at a time, by the kernels."""

    def support(**changes: Any) -> Case:
        return _changed(case, support=Support.model_validate(case.support.model_dump() | changes))

    rows = {
        "line fingers": case,
        "fingers 25 mm thick": _hand(case, finger_thickness=THICKNESS),
        "fingers 25 mm thick, colliding": _bed_hand(case),
        "finger friction 0.2": _changed(case, contact=Contact(friction=0.2)),
        "finger friction 1.2": _changed(case, contact=Contact(friction=1.2)),
        "pressure on the rim": support(pressure=Pressure.RIM),
        "pressure in the middle": support(pressure=Pressure.CENTRE),
        "pressure 4 mm aside": support(pressure_centre=(0.004, 0.0)),
        "pressure 4 mm ahead": support(pressure_centre=(0.0, 0.004)),
    }
    for name, varied in rows.items():
        yield name, "kernels", varied, None


def _in_mujoco(case: Case, worlds: Worlds) -> Iterator[Varied]:
    """Closing rates with line fingers, and the bed as it was."""
    for rate in RATES:
        yield f"line fingers at {rate:g} deg/s", "MuJoCo", _hand(case, finger_rate=radians(rate)), worlds.ideal
    bed = _hand(_bed_hand(case), finger_rate=BED_RATE)
    yield "the bed at 15 deg/s", "MuJoCo, servos", bed, worlds.bed


def _in_space(case: Case) -> Iterator[tuple[str, Case]]:
    yield "restitution 1", _changed(case, contact=case.contact.model_copy(update={"restitution": 1.0}))
    for restitution in (0.8, 0.5, 0.2):
        yield f"restitution {restitution:g}", _changed(case, contact=Contact(restitution=restitution))
    yield "fingers of four puck masses", _hand(case, finger_mass=4.0 * case.object.mass)


def _contacts(name: str, physics: str, region: Region, joint: tuple[float, float]) -> Row:
    """How far from the right joint, in each direction, a first contact may be."""
    return Row(name, physics, tuple(reach(region.contact, joint, each) for each in FREE_ANGLES))


def _limits(
    case: Case, about: tuple[float, float], make: WorldMaker | None, executor: Executor
) -> tuple[float | None, ...]:
    rules = Rules(about, ANGLES, TOLERANCE)
    return tuple(each.distance for each in limits(case, rules, None, make, executor))


def _turn(name: str, case: Case) -> Turn:
    """Over starts of the rectangle about hand and fingers' reach."""
    length, radius = case.hand.finger_length, 0.1 * case.hand.finger_length
    low, high = [-length - case.hand.half_palm, radius, 0.0], [length + case.hand.half_palm, 1.2 * length, 0.0]
    ends = simulate_starts(case, np.random.default_rng(1).uniform(low, high, (TURNS, 3)))
    caught = [Outcome.from_code(int(code)).caught for code in ends.codes]
    turned = np.abs(ends.poses[caught, 2])
    return Turn(name, float(np.median(turned)), float(turned.max()))


def _preshapes(case: Case, worlds: Worlds) -> Iterator[Preshape]:
    shapes = {
        "line fingers": case,
        "fingers 25 mm thick": _hand(case, finger_thickness=THICKNESS),
        "surface 25 mm off": _hand(case, finger_thickness=2.0 * THICKNESS),
        "line fingers, pressure on the rim": _changed(
            case, support=case.support.model_copy(update={"pressure": Pressure.RIM})
        ),
    }
    for name, varied in shapes.items():
        yield Preshape(name, circling_curl(varied, feedback_world), circling_curl(varied, worlds.ideal))
