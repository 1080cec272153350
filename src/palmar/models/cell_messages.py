"""What the parts of the 3-D cell tell each other: sightings, observations, orders. Only what a real cell has."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import pi
from typing import Annotated, Any, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import PlainSerializer, PlainValidator

from palmar.models.salisbury_hand import TIP_PREHENSION, Curl

Floats = NDArray[np.float64]
RIGID, FARTHEST = 1e-6, 10.0
"""How far a rotation may be from one; how far (m) from the arm's base anything may be."""


def _rigid(value: Any) -> Floats:
    """A pose (4, 4) from nested lists; raises ValueError unless it is a finite rigid motion within ``FARTHEST``."""
    try:
        pose: Floats = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError("a pose is 4 rows of 4 numbers") from None
    if pose.shape != (4, 4) or not np.isfinite(pose).all():
        raise ValueError("a pose is 4 rows of 4 finite numbers")
    turn = pose[:3, :3]
    square = np.abs(turn @ turn.T - np.eye(3)).max() < RIGID and np.linalg.det(turn) > 0.0
    if not square or np.abs(pose[3] - (0.0, 0.0, 0.0, 1.0)).max() > 0.0 or np.abs(pose[:3, 3]).max() > FARTHEST:
        raise ValueError("a pose is a rotation and a place within reach of the cell")
    return pose


Pose = Annotated[Floats, PlainValidator(_rigid), PlainSerializer(lambda pose: pose.tolist())]
"""Of the hand frame (4, 4); checked where it comes off a wire."""


@dataclass(frozen=True)
class Sighting:
    """What vision saw: when the frame was taken (s), the axis' place and the radius (m), standard deviation (m)."""

    stamp_s: float
    x_m: float
    y_m: float
    radius_m: float
    sigma_m: float


class Eye(Protocol):
    """Vision, seen from the controller: a simulated camera, or the mailbox of a vision process."""

    def look(self, now_s: float) -> Sighting | None:
        """The latest sighting that has arrived by now (s), the same one again until a newer comes; None before any."""
        ...


class EyeKind(Enum):
    """How the cell sees in lock-step trials."""

    CAMERA = "camera"
    """Frames are rendered and the cylinder is found in them."""
    POSE = "pose"
    """Sightings are made of the true pose, with noise."""


class HandMode(Enum):
    """What the hand is told to do."""

    SHAPE = "shape"
    """Move every finger's curl to a place and stay."""
    CLOSE = "close"
    """Curl until every finger presses with the grip torque; then stay with that."""


class Owner(Enum):
    """Which reflex owns the hand, highest priority first."""

    SAFE_STOP = "safe stop"
    SENSOR_FAULT = "sensor fault"
    OVERLOAD = "overload"
    GRIP = "grip"
    PALM = "palm"
    BEHAVIOUR = "behaviour"


NEVER = pi
"""Curl (rad) that no finger reaches."""


@dataclass(frozen=True)
class HandOrder:
    """To the reflex layer: mode, the shape of the curls, target curls (rad), rate (rad/s), grip torque (N m) of joint 2.

    ``close_on_palm``: the palm reflex is armed; any palm bit closes the hand at once, without asking the behaviour.
    ``soft_from`` (rad): from this curl on a finger may meet the object and closes no faster than ``soft_rate`` (rad/s).
    """

    mode: HandMode
    target: tuple[float, float, float]
    curl: Curl = TIP_PREHENSION
    rate: float = 1.5
    grip: float = 0.6
    close_on_palm: bool = False
    soft_from: float = NEVER
    soft_rate: float = 1.0


@dataclass(frozen=True)
class HandFelt:
    """At one servo tick: time (s), which fingers are touched, torque (N m) at joint 2 beyond what motion needs, palm bits.

    ``overload``: a tendon at its limit; ``dead``: a tendon that reads slack, which a working one never is.
    """

    time: float
    touched: tuple[bool, bool, bool]
    press: tuple[float, float, float]
    palm: tuple[bool, bool]
    overload: bool = False
    dead: bool = False


@dataclass(frozen=True)
class CellSeen:
    """To a behaviour, at each set-point of the arm: what the cell's sensors say.

    ``palm_pose`` (4, 4): of the hand frame, from the arm's joint angles; ``curls`` (rad) measured; ``touched``,
    ``palm``: now or at any tick since the last step; ``gripped``: all fingers press with the grip torque; ``at_end``: the
    fingers can move no further; ``owner``: of the hand; ``stopped``: the arm's link was interrupted or the hand failed.
    """

    time: float
    palm_pose: Pose
    curls: tuple[float, float, float]
    touched: tuple[bool, bool, bool]
    palm: tuple[bool, bool]
    gripped: bool
    at_end: bool
    owner: Owner
    stopped: str | None
    sighting: Sighting | None


class CellEnd(Enum):
    """How a behaviour ends by its own account."""

    HOLDS = "holds"
    NOTHING_FELT = "nothing felt"
    NOTHING_GRIPPED = "nothing gripped"
    LOST_GRIP = "lost grip"
    OUT_OF_APPROACHES = "out of approaches"
    NO_FRESH_SIGHTING = "no fresh sighting"
    SENSOR_FAULT = "sensor fault"
    STOPPED = "stopped"
    OUT_OF_REACH = "out of reach"
    WOULD_TOPPLE = "would topple"


@dataclass(frozen=True)
class CellOrder:
    """From a behaviour: the arm's next set-point for the hand frame (4, 4), the hand's order, what for; or its end."""

    palm_pose: Pose
    hand: HandOrder
    why: str
    end: CellEnd | None = None
    guided: bool = False
    """Whether the arm moves by what vision says, so that a fresh sighting is needed."""
