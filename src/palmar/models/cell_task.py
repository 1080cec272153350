"""The tasks of chapter 7 as numbers: a cylinder on a table, taken from above or from the side, and one that floats."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from palmar.errors import InputError


class TaskKind(Enum):
    """Which task of sections 7.2 and 7.3."""

    TABLE = "table"
    FLOATING = "floating"
    ALIGN = "align"


@dataclass(frozen=True)
class Cylinder:
    """Radius, height (m), mass (kg), and Coulomb friction with the hand and with the table."""

    radius: float
    height: float
    mass: float
    friction_hand: float = 0.7
    friction_table: float = 0.3

    def __post_init__(self) -> None:
        if min(self.radius, self.height, self.mass) <= 0.0 or min(self.friction_hand, self.friction_table) < 0.0:
            raise InputError(
                "cylinder", None, "radius, height and mass must be positive, coefficients of friction not negative"
            )


@dataclass(frozen=True)
class CellTask:
    """A task: its cylinder, and where (m, in the arm's base frame) it is meant to be: axis x, y and height of the centre."""

    kind: TaskKind
    cylinder: Cylinder
    place: tuple[float, float, float]


TABLE_TOP = -0.30
"""Height (m) of the table in the arm's base frame, whose origin is the shoulder."""
STANDING = Cylinder(radius=0.030, height=0.130, mass=0.30)
TALL = Cylinder(radius=0.030, height=0.280, mass=0.60)
HANGING = Cylinder(radius=0.030, height=0.280, mass=0.30)
TABLE_TASK = CellTask(TaskKind.TABLE, STANDING, (0.48, 0.0, TABLE_TOP + 0.5 * STANDING.height))
ALIGN_TASK = CellTask(TaskKind.ALIGN, TALL, (0.76, 0.0, TABLE_TOP + 0.5 * TALL.height))
FLOATING_TASK = CellTask(TaskKind.FLOATING, HANGING, (0.72, 0.0, 0.10))
