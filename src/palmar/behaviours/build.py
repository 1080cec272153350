"""From the behaviour that a case names to its reflex, with what it needs of the hand checked."""

from __future__ import annotations

from typing import Any

from palmar.behaviours.close import Closing
from palmar.behaviours.close_coupled import CoupledClosing
from palmar.behaviours.curl_and_close import CurlAndClose
from palmar.behaviours.force_feedback import ForceFeedback
from palmar.behaviours.jointed import JointedReflex
from palmar.behaviours.let_go import LettingGo
from palmar.behaviours.match_velocity import ArmLimits, MatchVelocity
from palmar.behaviours.matched_return import MatchedReturn
from palmar.behaviours.move_and_grab import MoveAndGrab
from palmar.behaviours.move_while_closing import MoveWhileClosing
from palmar.behaviours.palm_reflex import PalmReflex
from palmar.behaviours.reflex import Advance, Drive, Reflex
from palmar.behaviours.scoop import Scoop
from palmar.behaviours.sensor_places import SensorPlaces, places_of
from palmar.behaviours.touch_down import TouchDown
from palmar.errors import NotCoveredError
from palmar.mechanics.impact.touch_down_case import touch_down_programme
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.closure import Closure
from palmar.models.jointed_motion import check_two_links, coupled_limit, curl_of


def drive_of(case: Case) -> Drive:
    """The fingers of a case's hand."""
    return Drive(len(case.hand.finger_links), case.hand.finger_rate)


def case_places(case: Case) -> SensorPlaces:
    """Where the sensors of a case are."""
    return places_of(case.sensors.stretches(case.hand), len(case.hand.finger_links))


def reflex_of(case: Case) -> Reflex[Any]:
    """The reflex of any behaviour but FOLLOW_POLICY, which needs a plan.

    Raises NotCoveredError where the hand lacks a joint or a sensor that it needs.
    """
    name, given, drive = case.behaviour.name, case.behaviour, drive_of(case)
    move = Advance(given.advance, given.speed, given.direction)
    if name is BehaviourName.CLOSE:
        return Closing(drive)
    if name is BehaviourName.MOVE_AND_GRAB:
        return MoveAndGrab(drive, move)
    if name is BehaviourName.MOVE_WHILE_CLOSING:
        return MoveWhileClosing(drive, move, given.first)
    if name is BehaviourName.CURL_AND_CLOSE:
        return CurlAndClose(drive, curl_of(case))
    if name is BehaviourName.CLOSE_COUPLED:
        return CoupledClosing(drive, given.ratio, coupled_limit(case))
    if name is BehaviourName.TOUCH_DOWN:
        return TouchDown(drive, tuple(touch_down_programme(case)))
    if name is BehaviourName.LET_GO:
        return LettingGo(drive, given.trigger, given.delay, given.limp)
    if name is BehaviourName.FORCE_FEEDBACK:
        return ForceFeedback(drive, given.grip, given.gain, given.patience)
    if name is BehaviourName.MATCH_VELOCITY:
        return _matching(case, drive)
    if name is BehaviourName.MATCHED_RETURN:
        return _returning(case, drive)
    places = case_places(case)
    if name is BehaviourName.JOINTED:
        check_two_links(case)
        return _jointed(drive, places, given.preshape)
    if not places.palm:
        raise NotCoveredError(f'behaviour "{name.value}" needs a sensor on the palm: sensors.layout = "palm", say')
    if name is BehaviourName.SCOOP:
        return Scoop(drive, move, places)
    if name is BehaviourName.PALM_REFLEX:
        return PalmReflex(drive, places, move if given.advance > 0.0 else None, given.patience, given.delay)
    raise NotCoveredError(f'behaviour "{name.value}" needs a plan')


def _matching(case: Case, drive: Drive) -> MatchVelocity:
    """Closing counts until the hand is shut about the disk for good; the place is for a disk that then rests in the hand."""
    from palmar.mechanics.impact.capture_case import capture_hand_of
    from palmar.regions.captured import captured_region

    given, hand = case.behaviour, capture_hand_of(case)
    if len(hand.closures) == 0:
        raise NotCoveredError('behaviour "match_velocity": this hand never shuts about the disk')
    arm, place = ArmLimits(given.speed, given.acceleration, given.reach), given.place
    if place is None:
        still = case.model_copy(update={"start": case.start.model_copy(update={"velocity": (0.0, 0.0)})})
        circle = captured_region(still, Closure.FRICTIONAL, None).allowed_error
        if circle is None:
            raise NotCoveredError('behaviour "match_velocity": this hand catches no disk at rest, state place_mm')
        place = circle.centre
    return MatchVelocity(drive, arm, place, float(hand.closures[:, 0].min()), given.delay, given.patience)


def _returning(case: Case, drive: Drive) -> MatchedReturn:
    """The disk strikes the palm, a line, with its centre a radius before it."""
    from palmar.mechanics.impact.capture_case import capture_hand_of

    given, hand, e = case.behaviour, capture_hand_of(case), case.contact.restitution
    if len(hand.closures) == 0:
        raise NotCoveredError('behaviour "matched_return": this hand never shuts about the disk')
    arm, places = ArmLimits(given.speed, given.acceleration, given.reach), case_places(case)
    hold = float(hand.closures[:, 0].min())
    return MatchedReturn(drive, places, arm, e / (1.0 + e), hand.radius, hold, given.delay, given.patience)


def _jointed(drive: Drive, places: SensorPlaces, preshape: float) -> JointedReflex:
    if not any((*places.right, *places.left)):
        raise NotCoveredError('behaviour "jointed" needs sensors on the links: sensors.layout = "distributed", say')
    return JointedReflex(drive, places, preshape)
