"""Candidate causes of the gaps between chapter 6 and its theory, each as one change of the test bed's case.

The source names thickness, pressure and stiction on the table, and in free space fingers that slow down, restitution and a
puck that tilts. Friction, closing rate, motors, hose and what counts as a success are candidates beside them. Nothing is
tuned to match: the values are round ones, and where several causes fit none is claimed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import radians
from typing import Any

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import Pressure, Support, SupportKind

KERNELS, MUJOCO, SERVOS = "kernels", "MuJoCo", "MuJoCo, servos"
THICKNESS, BED_RATE, SLOW_RATE = 0.025, radians(15.0), 10.0
"""Of the bed's fingers (m); rates (rad/s; deg/s)."""
RATES = (20.0, 40.0, 80.0)
"""Closing rates (deg/s) tried."""
RESTITUTIONS = (0.8, 0.5, 0.2)
LINES, BED, SLOWLY, ELASTIC = (
    "line fingers",
    "fingers 25 mm thick, colliding",
    "line fingers at 10 deg/s",
    "restitution 1",
)
ELASTIC_HERE = "restitution 1, MuJoCo"
STICTION = {"stiction": 1.5, "stiction_speed": 2e-3}


@dataclass(frozen=True)
class Variation:
    """One change: its name, of which cause, the case with it, by which physics, and the row it is a change of.

    ``wanted``: outcomes that count as a success, None as usual.
    """

    name: str
    cause: str
    case: Case
    physics: str
    against: str
    wanted: tuple[Outcome, ...] | None = None


def line_bed(case: Case) -> Case:
    """The case's hand with line fingers that pass each other, on a table; raises NotCoveredError where it is no disk."""
    if not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": the report of the test bed is for disks')
    if case.ranges:
        raise NotCoveredError("the report of the test bed takes plain numbers, not ranges")
    return _support(_hand(case, finger_thickness=0.0, fingers=Fingers.CROSSING), kind=SupportKind.TABLE)


def on_the_table(case: Case) -> Iterator[Variation]:
    """Of ``line_bed``: by the kernels, then in MuJoCo."""
    thick = _bed_hand(case)
    yield Variation(LINES, "the construction itself", case, KERNELS, "published theory")
    yield Variation("fingers 25 mm thick", "finger thickness", _hand(case, finger_thickness=THICKNESS), KERNELS, LINES)
    yield Variation(BED, "finger thickness", thick, KERNELS, LINES)
    for friction in (0.2, 1.2):
        name = f"finger friction {friction:g}"
        yield Variation(name, "finger friction", _changed(case, contact=Contact(friction=friction)), KERNELS, LINES)
    pressures: dict[str, dict[str, Any]] = {
        "pressure on the rim": {"pressure": Pressure.RIM},
        "pressure in the middle": {"pressure": Pressure.CENTRE},
        "pressure 4 mm aside": {"pressure_centre": (0.004, 0.0)},
        "pressure 4 mm ahead": {"pressure_centre": (0.0, 0.004)},
    }
    for name, changes in pressures.items():
        yield Variation(name, "pressure distribution", _support(case, **changes), KERNELS, LINES)
    held = Outcome.STRUCTURAL, Outcome.FRICTIONAL
    yield Variation("thick, only a hold counts", "what success means", thick, KERNELS, BED, held)
    yield Variation("thick, only without friction", "what success means", thick, KERNELS, BED, held[:1])
    slow = _rate(case, SLOW_RATE)
    yield Variation(SLOWLY, "the other physics", slow, MUJOCO, LINES)
    for rate in RATES:
        yield Variation(f"line fingers at {rate:g} deg/s", "closing rate", _rate(case, rate), MUJOCO, SLOWLY)
    yield Variation("stiction 1.5 below 2 mm/s", "stiction", _bed(slow, **STICTION), MUJOCO, SLOWLY)
    bed = _hand(thick, finger_rate=BED_RATE)
    yield Variation("the bed at 15 deg/s", "motors and closing rate", bed, SERVOS, BED)


def in_free_space(case: Case) -> Iterator[Variation]:
    """Of ``line_bed``, its disk floating: by the kernels, then in MuJoCo."""
    case = _support(case, kind=SupportKind.FREE)
    elastic = _changed(case, contact=case.contact.model_copy(update={"restitution": 1.0}))
    yield Variation(ELASTIC, "the construction itself", elastic, KERNELS, "published theory")
    for restitution in RESTITUTIONS:
        softer = _changed(case, contact=case.contact.model_copy(update={"restitution": restitution}))
        yield Variation(f"restitution {restitution:g}", "restitution", softer, KERNELS, ELASTIC)
    heavy = _hand(elastic, finger_mass=4.0 * case.object.mass)
    yield Variation("fingers of four puck masses", "finger inertia", heavy, KERNELS, ELASTIC)
    thick = _hand(elastic, finger_thickness=THICKNESS)
    yield Variation("fingers 25 mm thick", "finger thickness", thick, KERNELS, ELASTIC)
    yield Variation(ELASTIC_HERE, "the other physics", elastic, MUJOCO, ELASTIC)
    half = _changed(case, contact=case.contact.model_copy(update={"restitution": 0.5}))
    yield Variation("restitution 0.5, MuJoCo", "restitution", half, MUJOCO, ELASTIC_HERE)
    for loss in (0.05, 0.2):
        name = f"tilt takes {loss:g} of an impact"
        yield Variation(name, "puck tilt", _bed(elastic, tilt_loss=loss), MUJOCO, ELASTIC_HERE)
    hose = _bed(elastic, hose_drag=0.5 * case.object.mass, spin_limit=radians(90.0))
    yield Variation("hose of 0.5 N s/m a kg, 90 deg", "hose", hose, MUJOCO, ELASTIC_HERE)
    inert = _hand(elastic, finger_rate=BED_RATE)
    yield Variation("fingers of 0.02 kg m2", "finger inertia", inert, SERVOS, ELASTIC_HERE)


def preshaped(case: Case) -> Iterator[tuple[str, Case, bool]]:
    """Name, case, and whether the kernels have it, of what the circling curl is asked for."""
    yield LINES, case, True
    yield "fingers 25 mm thick", _hand(case, finger_thickness=THICKNESS), True
    yield "surface 25 mm off", _hand(case, finger_thickness=2.0 * THICKNESS), True
    yield (
        "25 mm thick, pressure on the rim",
        _hand(_support(case, pressure=Pressure.RIM), finger_thickness=THICKNESS),
        True,
    )
    yield (
        "25 mm thick, pressure in the middle",
        _hand(_support(case, pressure=Pressure.CENTRE), finger_thickness=THICKNESS),
        True,
    )
    yield "25 mm thick, stiction 1.5 below 2 mm/s", _bed(_hand(case, finger_thickness=THICKNESS), **STICTION), False


def _changed(case: Case, **changes: Any) -> Case:
    return case.model_copy(update=changes)


def _hand(case: Case, **changes: Any) -> Case:
    return _changed(case, hand=Hand.model_validate(case.hand.model_dump() | changes))


def _support(case: Case, **changes: Any) -> Case:
    return _changed(case, support=Support.model_validate(case.support.model_dump() | changes))


def _bed(case: Case, **changes: Any) -> Case:
    return _changed(case, bed=case.bed.model_copy(update=changes))


def _rate(case: Case, rate: float) -> Case:
    return _hand(case, finger_rate=radians(rate))


def _bed_hand(case: Case) -> Case:
    return _hand(case, finger_thickness=THICKNESS, fingers=Fingers.COLLIDING)
