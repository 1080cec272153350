"""What the hand does, as a case names it: a behaviour and its parameters."""

from __future__ import annotations

from enum import Enum
from math import pi
from typing import Annotated, Self

from pydantic import Field, model_validator

from palmar.models.quantity import LARGEST_LENGTH, Point, Real, Unit, Value

Way = Annotated[Real, Field(ge=0.0, le=LARGEST_LENGTH), Unit.MILLIMETRE]
Duration = Annotated[Real, Field(ge=0.0, le=1000.0), Unit.SECOND]


class BehaviourName(Enum):
    """The reflexes and motions that a case can name."""

    CLOSE = "close"
    """Both fingers close from the open angle at the same rate, kept straight; the hand stands still."""
    MOVE_AND_GRAB = "move_and_grab"
    """Forward with open fingers for a given time, then close (section 3.3.3)."""
    MOVE_WHILE_CLOSING = "move_while_closing"
    """Forward while the fingers close, at first with open fingers if wanted (section 3.3.3)."""
    SCOOP = "scoop"
    """Forward with open fingers until the palm feels something or the way is over, then close."""
    PALM_REFLEX = "palm_reflex"
    """Wait, or advance, until the palm feels something; then close (sections 4.3 and 7.3)."""
    JOINTED = "jointed"
    """The reflex of the 4-jointed hand: which link feels the object first decides how a finger closes (section 5.2.3)."""
    CURL_AND_CLOSE = "curl_and_close"
    """Curl the distal joints to the preshape angle, then close the base joints (sections 5.2.2 and 5.3.1)."""
    CLOSE_COUPLED = "close_coupled"
    """Close base and distal joints together, at a fixed ratio of rates (section 5.3.1)."""
    TOUCH_DOWN = "touch_down"
    """Turn fast, slow down to touch a standing object at a low rate, and close on at that rate (section 4.3.2)."""
    LET_GO = "let_go"
    """Close; a finger on which the force passes a trigger is let go for a while, then closes on (section 4.3.2)."""
    FORCE_FEEDBACK = "force_feedback"
    """Close to the touch, then feed the contact's moment back to the motor: the naive way (section 4.3.2)."""
    MATCH_VELOCITY = "match_velocity"
    """Fly along with a tracked free disk, bring it to its place in the hand, and close on it (section 4.3.1)."""
    MATCHED_RETURN = "matched_return"
    """Yield to a tracked free disk that comes to the palm, so that the impact stops it, and close on it (section 4.3.2)."""
    FOLLOW_POLICY = "follow_policy"
    """Carry out the plan of ``palmar plan``: approach until a sensor fires, again if need be, then close (section 3.4)."""


class Behaviour(Value):
    """What the hand does; parameters that a behaviour does not have are ignored by it."""

    name: BehaviourName = BehaviourName.CLOSE
    advance: Way = 0.1
    """How far the arm goes, at most."""
    speed: Annotated[Real, Field(gt=0.0, le=1000.0), Unit.MILLIMETRE_PER_SECOND] = 0.1
    """Of the arm."""
    direction: Annotated[Real, Field(ge=-2.0 * pi, le=2.0 * pi), Unit.DEGREE] = 0.5 * pi
    """In which it goes, from the palm line; 90 is straight ahead."""
    first: Way = 0.0
    """The part of the advance with open fingers, where the rest is with closing ones."""
    delay: Duration = 0.0
    """Between the palm's bit and closing; of what a tracker tells, the age that is made up for."""
    patience: Duration = 10.0
    """How long a hand waits that does not advance, or follows an object before it closes."""
    preshape: Annotated[Real, Field(ge=0.0, lt=pi), Unit.DEGREE] = Unit.DEGREE.to_si(20.0)
    """Distal angle to curl to: before closing, or where the distal link felt the object."""
    ratio: Annotated[Real, Field(ge=-100.0, le=100.0)] = 1.0
    """Rate of the distal joints over that of the base joints, where they close together; negative: they turn back."""
    bend: Annotated[Real, Field(gt=-pi, lt=pi), Unit.DEGREE] = 0.0
    """Distal angle of the open hand whose joints close together; in every other motion it is straight."""
    uncertainty: Annotated[Real, Field(gt=0.0, le=LARGEST_LENGTH), Unit.MILLIMETRE] = 0.02
    """Radius of the disk about the case's start in which a plan, or a touch-down, takes the object's centre to be."""
    touch_rate: Annotated[Real, Field(gt=0.0, le=1000.0), Unit.DEGREE_PER_SECOND] = Unit.DEGREE_PER_SECOND.to_si(5.0)
    """At which a finger that touches down reaches the object."""
    finger_acceleration: Annotated[Real | None, Field(gt=0.0, le=1e6), Unit.DEGREE_PER_SECOND_SQUARED] = None
    """Of a finger that touches down; absent = the motor's torque over the finger's inertia."""
    trigger: Annotated[Real, Field(gt=0.0, le=1e9), Unit.NEWTON] = 1.0
    """Force on a finger that lets it go."""
    limp: Duration = 0.2
    """How long it is let go."""
    grip: Annotated[Real, Field(gt=0.0, le=1e6), Unit.NEWTON_METRE] = 0.1
    """Moment of the contact about the base joint that force feedback wants."""
    gain: Annotated[Real, Field(ge=0.0, le=1e6)] = 1.0
    """Of that feedback."""
    reach: Way = 1.0
    """How far the hand that follows an object may go from where it started."""
    acceleration: Annotated[Real, Field(gt=0.0, le=1e6), Unit.MILLIMETRE_PER_SECOND_SQUARED] = 2.0
    """Of the arm, where that counts: when it follows an object."""
    place: Annotated[Point | None, Unit.MILLIMETRE] = None
    """Where in the hand an object is brought that is followed; absent = the middle of the largest circle of the region."""

    @model_validator(mode="after")
    def _first_within_advance(self) -> Self:
        if self.first > self.advance:
            raise ValueError("first_mm is a part of advance_mm and cannot be more")
        return self
