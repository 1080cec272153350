"""What a sweep varies: numbers of a case file on grids or drawn at random, and the command that answers for each row.

Row i is the combination i // samples of the grids (the last axis runs fastest), and draw i of the drawn numbers. A drawn
number depends on the seed, its key and i alone, so that rows are the same however they are shared out.
"""

from __future__ import annotations

import copy
import hashlib
import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.models.case import Case
from palmar.models.case_file import build_case
from palmar.models.device import Device

Floats = NDArray[np.float64]


class SweepCommand(Enum):
    """The command that maps a case to a record."""

    CLOSURE = "closure"
    REGION = "region"
    SIMULATE = "simulate"
    PLAN = "plan"
    TESTBED = "testbed"


class Spread(Enum):
    """How a number varies."""

    GRID = "values"
    UNIFORM = "uniform"
    LOG_UNIFORM = "log_uniform"
    NORMAL = "normal"


@dataclass(frozen=True)
class Axis:
    """One number that varies, in the unit of its key: grid values; lower and upper end; or mean and standard deviation."""

    key: str
    spread: Spread
    numbers: tuple[float, ...]

    @property
    def place(self) -> tuple[str | int, ...]:
        """Section, key, and indices."""
        return tuple(int(part) if part.isdigit() else part for part in self.key.split("."))


@dataclass(frozen=True)
class Sweep:
    """``base``: the case as TOML text, every key in it; ``samples``: draws for each combination of the grids.

    ``uncertainty`` (m), ``approaches``: of the command plan. ``device``: of the command simulate.
    """

    command: SweepCommand
    base: str
    axes: tuple[Axis, ...]
    samples: int = 1
    seed: int = 0
    uncertainty: float = 0.010
    approaches: int = 3
    device: Device = Device.CPU

    @cached_property
    def grids(self) -> tuple[Axis, ...]:
        """Axes with values of a grid."""
        return tuple(each for each in self.axes if each.spread is Spread.GRID)

    @property
    def rows(self) -> int:
        """How many there are."""
        return prod((len(each.numbers) for each in self.grids), start=self.samples)

    @property
    def digest(self) -> str:
        """Of everything that the rows depend on (sha256, hexadecimal)."""
        axes = [(each.key, each.spread.value, each.numbers) for each in self.axes]
        whole = [self.command.value, self.base, axes, self.samples, self.seed, self.uncertainty, self.approaches]
        whole += [self.device.value] if self.device is not Device.CPU else []
        return hashlib.sha256(json.dumps(whole).encode()).hexdigest()

    @cached_property
    def _tables(self) -> dict[str, Any]:
        return tomllib.loads(self.base)

    def case_at(self, values: Mapping[str, float]) -> Case:
        """The case with numbers put in at their keys, in the file's units; raises InputError if not allowed."""
        tables = copy.deepcopy(self._tables)
        for axis in self.axes:
            if axis.key in values:
                put(tables, axis.place, values[axis.key])
        return build_case(tables, "row")


def put(tables: dict[str, Any], place: tuple[str | int, ...], value: float) -> None:
    """Set the number at a place of nested tables and lists; raises KeyError or IndexError where there is no such place."""
    *way, last = place
    inner: Any = tables
    for step in way:
        inner = inner.setdefault(step, {}) if isinstance(inner, dict) else inner[_index(step)]
    if isinstance(inner, dict):
        inner[last] = value
    else:
        inner[_index(last)] = value


def _index(step: str | int) -> int:
    if not isinstance(step, int):
        raise KeyError(step)
    return step
