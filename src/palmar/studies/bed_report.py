"""The measurements of chapter 6, repeated: limits on the table, limits in free space, and the preshape that circles.

Each limit is searched as the source did (``limits``) and known to TOLERANCE: it lies by less than that below the edge, so
that a difference of two is known to the same. Candidate causes of the gaps are varied one at a time (``bed_causes``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from math import radians, sqrt

import numpy as np

from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.regions.build import build_region
from palmar.regions.region import Model, Region
from palmar.studies.bed_causes import (
    BED,
    KERNELS,
    LINES,
    MUJOCO,
    Variation,
    in_free_space,
    line_bed,
    on_the_table,
    preshaped,
)
from palmar.studies.limits import Rules, limits, reach
from palmar.studies.preshape_trial import circling_curl
from palmar.studies.simulate import simulate_starts
from palmar.worlds.planar.feedback import feedback_world
from palmar.worlds.world import WorldMaker

ANGLES = tuple(radians(each) for each in (15.0, 30.0, 45.0, 67.5, 90.0))
"""On the table: of the object's centre from the palm's middle, from its outward line."""
FREE_ANGLES = tuple(radians(each) for each in (15.0, 30.0, 45.0, 60.0, 75.0, 90.0))
"""In free space: of the first contact from the right joint."""
TOLERANCE, FREE_TOLERANCE = 5e-4, 1e-3
TURNS = 400
"""Random starts whose final turn is looked at."""
THEORY = "published theory"
Say = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Row:
    """Limits (m) in the directions ``ANGLES`` or ``FREE_ANGLES``, None where nothing is caught; how they were found.

    ``cause``: of what it is a trial; ``against``: the row of which it is a change.
    """

    name: str
    physics: str
    limits: tuple[float | None, ...]
    cause: str = ""
    against: str = ""


@dataclass(frozen=True)
class Effect:
    """What one change does to the limits of the row it changes: least and largest difference (m), known to ``known``."""

    cause: str
    name: str
    physics: str
    least: float
    largest: float
    known: float


@dataclass(frozen=True)
class Meaning:
    """Of a way to take "radially": least and largest share by which a region reaches further than the theory."""

    name: str
    hand: str
    least: float
    largest: float


@dataclass(frozen=True)
class Turn:
    """Median and largest final turn (rad) of caught starts in the region."""

    name: str
    median: float
    largest: float


@dataclass(frozen=True)
class Preshape:
    """The curl (rad) with which the disk keeps to a circle, by the kernels, if they have the case, and in MuJoCo."""

    name: str
    kernels: float | None
    other: float


@dataclass(frozen=True)
class BedReport:
    """The first row of table and free space are the source's theory; no preshapes but for fingers of two links."""

    table: tuple[Row, ...]
    turns: tuple[Turn, ...]
    free: tuple[Row, ...]
    effects: tuple[Effect, ...]
    meanings: tuple[Meaning, ...]
    preshapes: tuple[Preshape, ...]


@dataclass(frozen=True)
class Worlds:
    """Makers of the two MuJoCo worlds, ideal servos and the bed's."""

    ideal: WorldMaker
    bed: WorldMaker

    def of(self, physics: str) -> WorldMaker | None:
        """Which one, None the planar one."""
        return {KERNELS: None, MUJOCO: self.ideal}.get(physics, self.bed)


def bed_report(case: Case, worlds: Worlds, executor: Executor, tell: Say) -> BedReport:
    """Of a case's hand and disk; ``tell`` hears how many rows are done, of how many, and which is next."""
    case = line_bed(case)
    table, free = list(on_the_table(case)), list(in_free_space(case))
    curls = list(preshaped(case)) if len(case.hand.finger_links) == 2 else []
    done, whole = 0, len(table) + len(free) + len(curls)
    rows = _theory(case)
    found: list[list[Row]] = [[rows[0]], list(rows[1:])]
    for k, variations in enumerate((table, free)):
        for each in variations:
            tell(done, whole, f"{each.name}, {each.physics}")
            make = worlds.of(each.physics)
            found[k].append(_row(each, make, executor, free=k == 1))
            done += 1
    preshapes = []
    for name, varied, planar in curls:
        tell(done, whole, f"preshape, {name}")
        curl = circling_curl(varied, feedback_world) if planar else None
        preshapes.append(Preshape(name, curl, circling_curl(varied, worlds.ideal)))
        done += 1
    tell(done, whole, "")
    turns = tuple(_turn(each.name, each.case) for each in table if each.physics == KERNELS and each.wanted is None)
    effects = (*_effects(found[0], TOLERANCE), *_effects(found[1], FREE_TOLERANCE))
    return BedReport(tuple(found[0]), turns, tuple(found[1]), effects, tuple(_meanings(table)), tuple(preshapes))


def _theory(case: Case) -> tuple[Row, ...]:
    """On the table, then printed and corrected in free space."""
    published = build_region(case, Model.PUBLISHED).centre
    space = case.model_copy(update={"support": case.support.model_copy(update={"kind": SupportKind.FREE})})
    joint = case.hand.half_palm, 0.0
    rows = [Row(THEORY, "construction", tuple(reach(published, (0.0, 0.0), each) for each in ANGLES))]
    for model in (Model.PUBLISHED, Model.CORRECTED):
        region = build_region(space, model)
        told = tuple(reach(region.contact, joint, each) for each in FREE_ANGLES)
        rows.append(Row(f"{model.value} theory", "construction", told))
    return tuple(rows)


def _row(each: Variation, make: WorldMaker | None, executor: Executor, *, free: bool) -> Row:
    """Its limits; in free space of the first contact, from the right joint."""
    hand, body = each.case.hand, each.case.object
    rules = Rules((0.0, 0.0), ANGLES, TOLERANCE, wanted=each.wanted)
    if free and isinstance(body, Disk):
        aside = body.radius + hand.half_thickness
        rules = Rules((hand.half_palm, 0.0), FREE_ANGLES, FREE_TOLERANCE, aside=aside)
    found = tuple(one.distance for one in limits(each.case, rules, None, make, executor))
    return Row(each.name, each.physics, found, each.cause, each.against)


def _effects(rows: list[Row], known: float) -> Iterator[Effect]:
    named = {row.name: row for row in rows}
    for row in rows:
        base = named.get(row.against)
        if base is None:
            continue
        apart = [a - b for a, b in zip(row.limits, base.limits, strict=True) if a is not None and b is not None]
        if apart:
            yield Effect(row.cause, row.name, row.physics, min(apart), max(apart), known)


def _meanings(table: list[Variation]) -> Iterator[Meaning]:
    """The exact region on the table against the printed one, radially in four senses."""
    cases = {each.name: each.case for each in table if each.name in (LINES, BED)}
    joint = cases[LINES].hand.half_palm, 0.0
    told = build_region(cases[LINES], Model.PUBLISHED)
    for hand, case in cases.items():
        found = build_region(case)
        senses = {
            "of the centre, from the palm's middle": _shares(found, told, "centre", (0.0, 0.0)),
            "of the centre, from the right joint": _shares(found, told, "centre", joint),
            "of the disk's edge, from the palm's middle": _shares(found, told, "whole", (0.0, 0.0)),
            "of circles of the regions' areas": [sqrt(found.centre.area / told.centre.area) - 1.0],
        }
        for name, shares in senses.items():
            if shares:
                yield Meaning(name, hand, min(shares), max(shares))


def _shares(found: Region, told: Region, of: str, about: tuple[float, float]) -> list[float]:
    pairs = [(reach(getattr(found, of), about, each), reach(getattr(told, of), about, each)) for each in ANGLES]
    return [a / b - 1.0 for a, b in pairs if a is not None and b is not None]


def _turn(name: str, case: Case) -> Turn:
    """Over starts of the rectangle about hand and fingers' reach."""
    length, radius = case.hand.finger_length, 0.1 * case.hand.finger_length
    low, high = [-length - case.hand.half_palm, radius, 0.0], [length + case.hand.half_palm, 1.2 * length, 0.0]
    ends = simulate_starts(case, np.random.default_rng(1).uniform(low, high, (TURNS, 3)))
    caught = [Outcome.from_code(int(code)).caught for code in ends.codes]
    turned = np.abs(ends.poses[caught, 2])
    return Turn(name, float(np.median(turned)), float(turned.max())) if any(caught) else Turn(name, 0.0, 0.0)
