"""Three fingertips from above: the plan for an uncertain place, its trial, the largest uncertainty for some approaches."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray
from shapely import Point
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.descending import fewest_descents
from palmar.behaviours.descent import (
    NOTHING,
    PALM,
    Closing,
    Descending,
    Descent,
    Reach,
    Stand,
    Stuck,
    descents,
    is_certain,
)
from palmar.behaviours.placing import target
from palmar.geometry.planar_set import areal
from palmar.mechanics.pushing.three_tips import drift, ends
from palmar.models.outcome import Outcome
from palmar.models.support import Pressure
from palmar.models.three_tips import ThreeTips
from palmar.regions.region import Region
from palmar.regions.three_tips import beside_tips, tips_drag, tips_region

Floats = NDArray[np.float64]
CAUGHT = tuple(each.code for each in Outcome if each.caught)
CORNERS = 96
"""Of the polygon around an uncertain disk."""


@dataclass(frozen=True)
class Task:
    """Three tips over a standing cylinder of ``radius`` (m).

    ``displacement`` (m): how far a touch may shift it; ``pose_error`` (m): how far the hand may be from where it should be.
    """

    tips: ThreeTips
    radius: float
    friction: float
    pressure: Pressure = Pressure.UNIFORM
    displacement: float = 0.0
    pose_error: float = 0.0

    @property
    def region(self) -> Region:
        """From where the wide open tips catch it."""
        return tips_region(self.tips, self.radius, self.friction, self.pressure)

    @property
    def reach(self) -> Reach:
        """What the search for a plan needs."""
        goal = target(self.region.centre)
        borders = beside_tips(self.tips, self.radius, self.friction, self.pressure)
        standing = areal(self.region.centre | borders)
        return Reach(self.tips, self.radius, goal, standing, self.displacement, self.pose_error)


@dataclass(frozen=True)
class Trial:
    """Cylinders carried through a plan: caught, lost in closing, left by the plan; the most descents, and their mean."""

    caught: int
    lost: int
    given_up: int
    most: int
    mean: float


def uncertain_disk(radius: float) -> BaseGeometry:
    """A polygon around the disk of places at most ``radius`` (m) from the thought one."""
    return Point(0.0, 0.0).buffer(radius / cos(pi / CORNERS), quad_segs=CORNERS // 4)


def plan_descents(task: Task, uncertainty: BaseGeometry, most: int, opening: float | None = None) -> Descending:
    """The plan for a cylinder with such a set of position errors (m); ``opening``: the only circle tried for touching."""
    openings = None if opening is None else (opening, task.tips.open_radius)
    return fewest_descents(task.reach, uncertainty, most, openings)


def largest_uncertainty(task: Task, most: int, opening: float | None = None, step: float = 1e-2) -> float:
    """Radius (m) of the largest uncertain disk with a plan of so many approaches, to ``step`` of R + r_t; a lower bound."""
    reach = task.reach
    openings = None if opening is None else (opening, task.tips.open_radius)
    low, high = 0.0, (1.5 + most) * reach.rho
    while high - low > step * reach.rho:
        middle = 0.5 * (low + high)
        if is_certain(fewest_descents(reach, uncertain_disk(middle), most, openings)):
            low = middle
        else:
            high = middle
    return low


def try_descents(task: Task, plan: Descending, centres: Floats, seed: int = 0) -> Trial:
    """Carry cylinders at ``centres`` (N, 2) through a plan, with touches from distances and closings from the kernel."""
    run = _Run(task, np.random.default_rng(seed))
    run.follow(plan, np.asarray(centres, dtype=float), 0)
    total = max(run.caught + run.lost + run.given_up, 1)
    return Trial(run.caught, run.lost, run.given_up, run.most, run.sum / total)


class _Run:
    def __init__(self, task: Task, rng: np.random.Generator) -> None:
        self.task, self.rng = task, rng
        self.table = drift(
            tips_drag(task.radius, task.pressure) if task.friction > 0.0 else None,
            task.friction,
        )
        self.caught = self.lost = self.given_up = self.most = self.sum = 0

    def follow(self, plan: Descending, places: Floats, before: int) -> None:
        if len(places) == 0:
            return
        if isinstance(plan, Descent):
            self._come_down(plan, places, before + 1)
            return
        number = before + (1 if isinstance(plan, Closing) and not plan.there else 0)
        self.most, self.sum = max(self.most, number), self.sum + number * len(places)
        if isinstance(plan, Stuck):
            self.given_up += len(places)
            return
        tips = self.task.tips
        radii = (self.task.radius, tips.tip_radius, tips.open_radius, tips.closed_radius)
        codes = ends(radii, self.task.friction, self.table, self._seen(plan.stand, places))
        held = np.isin(codes, CAUGHT)
        self.caught += int(held.sum())
        self.lost += int((~held).sum())

    def _come_down(self, plan: Descent, places: Floats, number: int) -> None:
        task, tips = self.task, self.task.tips
        shift = self._shifts(task.pose_error, len(places))
        off = places[:, None, :] - np.array(plan.stand.tips) - shift[:, None, :]
        touched = np.hypot(off[..., 0], off[..., 1]) < task.radius + tips.tip_radius
        away = np.hypot(*(places - (plan.stand.x, plan.stand.y) - shift).T)
        palm = (away < task.radius + (tips.palm_radius or 0.0)) & (tips.palm_radius is not None) & ~touched.any(axis=1)
        felt = np.where(palm, 8, touched @ np.array([1, 2, 4]))
        moved = places + np.where((felt > 0)[:, None], self._shifts(task.displacement, len(places)), 0.0)
        known = np.zeros(len(places), dtype=np.bool_)
        for branch in plan.branches:
            here = felt == _code(branch.felt)
            known |= here
            self.follow(branch.then, moved[here], number)
        self.given_up += int((~known).sum())

    def _seen(self, stand: Stand, places: Floats) -> Floats:
        off = places - (stand.x, stand.y) - self._shifts(self.task.pose_error, len(places))
        c, s = cos(stand.turn), sin(stand.turn)
        found: Floats = off @ np.array([[c, -s], [s, c]])
        return found

    def _shifts(self, most: float, number: int) -> Floats:
        angle, share = self.rng.uniform(0.0, 2.0 * pi, number), np.sqrt(self.rng.uniform(size=number))
        found: Floats = most * share[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return found


def _code(felt: tuple[str, ...]) -> int:
    if felt in (PALM, NOTHING):
        return 8 if felt == PALM else 0
    return sum(1 << (int(each[-1]) - 1) for each in felt)


def approaches_needed(plan: Descending) -> int | None:
    """Approaches in the worst case; None where the plan is not certain."""
    return descents(plan) if is_certain(plan) else None
