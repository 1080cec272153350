"""A case's behaviour run in a world: the trace, the outcome, and what the hand may say of it by itself."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi
from typing import Any

from shapely import Point

from palmar.behaviours.build import case_places, drive_of, reflex_of
from palmar.behaviours.follow_policy import FollowPolicy
from palmar.behaviours.reflex import Reflex
from palmar.behaviours.verdict import Verdict, verdict
from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.studies.plan import plan
from palmar.worlds.planar.bits import Sensing
from palmar.worlds.planar.feedback import TICK, feedback_world
from palmar.worlds.planar.free_feedback import free_feedback_world
from palmar.worlds.planar.tracker import Tracker
from palmar.worlds.run import LONGEST, Trace, run
from palmar.worlds.world import World, WorldMaker

CORNERS = 128
MOST_APPROACHES = 3
TRACKING = {BehaviourName.MATCH_VELOCITY, BehaviourName.MATCHED_RETURN}
"""Behaviours that need a tracker."""
Place = tuple[float, float, float]


@dataclass(frozen=True)
class BehaviourRun:
    """What was run and from where, what happened, and the hand's own verdict."""

    case: Case
    start: Place
    massive: bool
    trace: Trace
    verdict: Verdict


@dataclass(frozen=True)
class Circumstances:
    """Seconds between observations; faults of the sensors (None: as the case says); whether touch moves the object."""

    tick: float = TICK
    sensing: Sensing | None = None
    massive: bool | None = None
    """None: as the behaviour presumes, which is only so for a plan."""
    longest: float = LONGEST
    tracker: Tracker | None = None
    """What tracks a free disk; None: for a behaviour that needs it one without errors, as late as it presumes."""
    make: WorldMaker | None = None
    """Which world, None: the planar one; it has to be picklable where runs are shared out among processes."""


def run_behaviour(
    case: Case, start: Place, circumstances: Circumstances = Circumstances(), reflex: Reflex[Any] | None = None
) -> BehaviourRun:
    """Run the behaviour that a case names, or a given ``reflex``, with the object at ``start`` (m, rad).

    Raises NotCoveredError where hand or object do not allow it.
    """
    asked = circumstances.massive
    massive = case.behaviour.name is BehaviourName.FOLLOW_POLICY if asked is None else asked
    chosen = behaviour_of(case) if reflex is None else reflex
    world = world_of(case, start, circumstances, massive)
    names = tuple(each.name for each in case.sensors.stretches(case.hand))
    trace = run(world, chosen, names, circumstances.longest)
    last = straight_motion(case.hand).last
    said = verdict(trace.rows[-1].seen, case_places(case), last, case.hand.fingers is Fingers.COLLIDING)
    return BehaviourRun(case, start, massive, trace, said)


def world_of(case: Case, start: Place, circumstances: Circumstances, massive: bool) -> World:
    """The world asked for; else the planar one, of an object on a table or of a free disk."""
    tick, sensing, tracker = circumstances.tick, circumstances.sensing, circumstances.tracker
    if tracker is None and case.behaviour.name in TRACKING:
        tracker = Tracker(case.behaviour.delay)
    if circumstances.make is not None:
        if tracker is not None:
            raise NotCoveredError("only the planar world tracks disks")
        return circumstances.make(case, start, tick=tick, sensing=sensing, massive=massive)
    if case.support.kind is SupportKind.FREE:
        if massive:
            raise NotCoveredError("massive: an object in free space does not stay where it is touched")
        return free_feedback_world(case, start, tick=tick, sensing=sensing, tracker=tracker)
    if tracker is not None:
        raise NotCoveredError('support.kind = "table": only free disks are tracked')
    return feedback_world(case, start, tick=tick, sensing=sensing, massive=massive)


def behaviour_of(case: Case) -> Reflex[Any]:
    """The reflex of a case; for FOLLOW_POLICY that of the plan for its uncertainty, a disk about the case's start."""
    if case.behaviour.name is not BehaviourName.FOLLOW_POLICY:
        return reflex_of(case)
    if not isinstance(case.object, Disk):
        raise NotCoveredError('behaviour "follow_policy" needs a plan, and plans are for disks')
    if case.support.kind is SupportKind.FREE:
        raise NotCoveredError('behaviour "follow_policy" needs a plan, and plans are for objects on a table')
    about = Point(0.0, 0.0).buffer(case.behaviour.uncertainty / cos(pi / CORNERS), quad_segs=CORNERS // 4)
    found = plan(case.model_copy(update={"behaviour": Behaviour()}), about, case.start.at, MOST_APPROACHES)
    hand = case.hand
    clearance = hand.finger_length + hand.half_thickness + case.object.radius
    last = straight_motion(hand).last
    return FollowPolicy(drive_of(case), found.found.policy, case.behaviour.speed, clearance, last)
