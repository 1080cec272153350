"""What an integrator asks of a region: chance of a catch, smallest opening, where the object ends, what it takes."""

from __future__ import annotations

from dataclasses import dataclass

from shapely import affinity
from shapely.geometry.base import BaseGeometry

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.regions.exact import settle
from palmar.regions.region import Model, Region
from palmar.studies.capture import Capture, Pair, PoseError
from palmar.studies.final_angles import FinalAngles, final_angles
from palmar.studies.final_poses import FinalPoses
from palmar.studies.pre_opening import PreOpening
from palmar.studies.pressure_offset import OffsetEffect
from palmar.studies.validity import Validity, validity
from palmar.studies.velocity_tolerance import VelocityTolerance, velocity_tolerance


@dataclass(frozen=True)
class Questions:
    """What is asked: a pose error, a set of errors (m) about the nominal place, the ends, and a pressure offset (m).

    ``at`` (m, hand frame) is the nominal place; None takes the case's start. ``velocities``: which it may have there.
    """

    error: PoseError | None = None
    uncertainty: BaseGeometry | None = None
    ends: bool = False
    offset: float | None = None
    at: Pair | None = None
    velocities: bool = False


@dataclass(frozen=True)
class Answers:
    """None for what was not asked or has no answer; ``validity`` says what is not known."""

    asked: Questions
    validity: Validity
    capture: Capture | None = None
    pre_opening: PreOpening | None = None
    ends: FinalPoses | None = None
    angles: FinalAngles | None = None
    velocity: VelocityTolerance | None = None


def answers(case: Case, region: Region | None, model: Model, closure: Closure, asked: Questions) -> Answers:
    """Answer what is asked; ``region`` is None where none covers the case, then starts are simulated.

    Raises NotCoveredError for what neither answers.
    """
    at = asked.at if asked.at is not None else case.start.at
    plain = settle(case, closure)
    ends = _ends(plain, region, asked, at) if asked.ends else None
    angles = final_angles(plain, ends) if ends is not None and isinstance(case.object, Disk) else None
    opened, unopened = _opened(case, region, model, closure, asked, at)
    offset, refused = _offset(plain, region, asked)
    checked = validity(plain.model_copy(update={"ranges": case.ranges}), region, offset, (*unopened, *refused))
    velocity = velocity_tolerance(case, at) if asked.velocities else None
    return Answers(asked, checked, _capture(plain, region, asked, at), opened, ends, angles, velocity)


def _opened(
    case: Case, region: Region | None, model: Model, closure: Closure, asked: Questions, at: Pair
) -> tuple[PreOpening | None, tuple[str, ...]]:
    """The smallest safe opening, or why it is not known."""
    if asked.uncertainty is None:
        return None, ()
    if region is None or region.guarantee is Guarantee.SAMPLED:
        return None, ("the smallest safe opening: it takes a region in closed form",)
    from palmar.studies.pre_opening import pre_opening

    return pre_opening(case, asked.uncertainty, at, model, closure), ()


def _capture(case: Case, region: Region | None, asked: Questions, at: Pair) -> Capture | None:
    if asked.error is None:
        return None
    turns = asked.error.sigma_theta > 0.0 and not isinstance(case.object, Disk)
    if region is not None and not turns:
        from palmar.studies.capture import capture_from_region

        return capture_from_region(region, asked.error, at)
    from palmar.studies.capture_sampled import capture_from_starts

    return capture_from_starts(case, asked.error, at)


def _ends(case: Case, region: Region | None, asked: Questions, at: Pair) -> FinalPoses | None:
    """Of the uncertain starts where a set is given, else of the whole region."""
    from palmar.studies.final_poses import final_poses

    if asked.uncertainty is not None:
        return final_poses(case, affinity.translate(asked.uncertainty, *at))
    if region is None:
        raise NotCoveredError("where the object ends: no region covers this case, so a set of starts must be given")
    return None if region.centre.is_empty else final_poses(case, region.centre)


def _offset(case: Case, region: Region | None, asked: Questions) -> tuple[OffsetEffect | None, tuple[str, ...]]:
    """The effect of a pressure offset, or why it is not known."""
    if asked.offset is None or region is None or region.allowed_error is None:
        return None, ()
    from palmar.studies.pressure_offset import offset_effect

    try:
        return offset_effect(case, region.allowed_error, asked.offset), ()
    except NotCoveredError as error:
        return None, (f"the effect of a pressure offset: {error}",)
