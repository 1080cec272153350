"""What each behaviour does, in steps, and which parameters and sensors it has."""

from __future__ import annotations

from dataclasses import dataclass

from palmar.models.behaviour import BehaviourName


@dataclass(frozen=True)
class Description:
    """One line, the steps in order, the fields of ``Behaviour`` that count, what it needs, and its section."""

    summary: str
    steps: tuple[str, ...]
    parameters: tuple[str, ...]
    needs: str
    section: str


DESCRIPTIONS: dict[BehaviourName, Description] = {
    BehaviourName.CLOSE: Description(
        "The hand stands still and closes.",
        ("Both base joints close at the finger rate, the fingers straight.", "End when both are held up."),
        (), "nothing", "3.3.1",
    ),
    BehaviourName.MOVE_AND_GRAB: Description(
        "Advance with open fingers, then close.",
        ("The arm goes for the time advance / speed, fingers open.", "Close."),
        ("advance", "speed", "direction"), "an arm", "3.3.3",
    ),
    BehaviourName.MOVE_WHILE_CLOSING: Description(
        "Advance while the fingers close, at first with open fingers if wanted.",
        ("The arm goes over the first stretch, fingers open.", "It goes on to the end of the advance while they close.",
         "Close."),
        ("advance", "speed", "direction", "first"), "an arm", "3.3.3",
    ),
    BehaviourName.SCOOP: Description(
        "Advance with open fingers until the palm feels something or the way is over, then close.",
        ("The arm goes, fingers open, until the palm's bit or the end of the advance.", "Close."),
        ("advance", "speed", "direction"), "an arm and a sensor on the palm", "3.3.3 and 3.4",
    ),
    BehaviourName.PALM_REFLEX: Description(
        "Close once the palm feels something; without that, do not.",
        ("Wait, or advance, until the palm's bit; end if the patience or the advance is over.",
         "Wait for the delay.", "Close."),
        ("advance", "speed", "direction", "patience", "delay"), "a sensor on the palm", "4.3 and 7.3",
    ),
    BehaviourName.JOINTED: Description(
        "Each finger closes as the link that feels the object first tells it to.",
        ("Both base joints close, the fingers straight, until a sensor fires.",
         "If that is on a finger's proximal link or on the palm: its distal joint closes to contact, then its base joint.",
         "If it is on a finger's distal link: its base joint stops, its distal joint curls to the preshape angle,"
         " then its base joint closes.",
         "End when both fingers are held up."),
        ("preshape",), "fingers of two links with sensors", "5.2.3",
    ),
    BehaviourName.CURL_AND_CLOSE: Description(
        "Curl the distal links, then close.",
        ("The distal joints curl to the preshape angle, the base joints still.", "The base joints close.",
         "End when both fingers are held up."),
        ("preshape",), "fingers of two links", "5.2.2 and 5.3.1",
    ),
    BehaviourName.CLOSE_COUPLED: Description(
        "Close base and distal joints together.",
        ("The base joints close at the finger rate, the distal joints from their bend at the ratio times that.",
         "End when both fingers are held up."),
        ("ratio", "bend"), "fingers of two links", "5.3.1",
    ),
    BehaviourName.TOUCH_DOWN: Description(
        "Turn fast, slow down to touch a standing disk at a low rate, and close on at that rate.",
        ("Each finger speeds up to the finger rate at most, and slows down to the touch rate where it may first touch the"
         " disk about the case's start, as far off as the uncertainty.",
         "Close on at the touch rate.", "End when both fingers are held up."),
        ("touch_rate", "finger_acceleration", "uncertainty"), "to know about where the disk stands", "4.3.2",
    ),
    BehaviourName.LET_GO: Description(
        "Close; let a finger go for a while, once, when the force on it passes a trigger.",
        ("Both base joints close.", "A finger on which the force passes the trigger is let go, after the delay.",
         "After the limp time it closes on.", "End when both fingers are held up."),
        ("trigger", "delay", "limp"), "force sensors and fingers of a mass: --world soft", "4.3.2",
    ),
    BehaviourName.FORCE_FEEDBACK: Description(
        "Close to the touch, then feed the contact's moment back to the motor: the naive way; a drive that lags hammers.",
        ("Each base joint closes until its finger feels the disk.",
         "Its motor is asked for the grip and the gain times what is missing of it.",
         "End when the patience after the first touch is over."),
        ("grip", "gain", "patience"), "force sensors and fingers of a mass: --world soft", "4.3.2",
    ),
    BehaviourName.MATCH_VELOCITY: Description(
        "Fly along with a tracked free disk, bring it to its place in the hand, and close on it.",
        ("Look: end, and say why, if speed, reach or patience do not allow what follows.",
         "Follow until the disk is at the place and the velocities are equal.",
         "Close at that velocity until the hand is shut about the disk, then brake, closing on."),
        ("speed", "acceleration", "reach", "place", "delay", "patience"),
        "an arm and a tracker (--track; else a perfect one, as late as delay says); a free disk", "4.3.1",
    ),
    BehaviourName.MATCHED_RETURN: Description(
        "Yield to a tracked free disk that comes to the palm, so that the impact stops it, then close on it.",
        ("Look: end, and say why, if the disk does not come, or speed, reach or patience do not allow what follows.",
         "Go back at e / (1 + e) of the disk's speed, the palm its mirror; along the palm at its speed.",
         "Once the tracker or the palm tells of the impact: stop going back, close, then brake."),
        ("speed", "acceleration", "reach", "delay", "patience"),
        "an arm and a tracker (--track; else a perfect one, as late as delay says); a free disk", "4.3.2",
    ),
    BehaviourName.FOLLOW_POLICY: Description(
        "Carry out the plan that palmar plan finds for a disk of uncertainty about the case's start.",
        ("For each move: straight back, sideways, fingers to the opening, forward.",
         "Approach until a sensor fires, and take the branch of what was felt.", "Close where it is certain to catch."),
        ("uncertainty", "speed"), "an arm and sensors without dead zones; a disk", "3.4",
    ),
}  # fmt: skip
"""By name, in the order in which they are listed."""
