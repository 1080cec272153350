"""The sensory reflex of the 4-jointed hand (section 5.2.3), for each finger by itself.

The base joint closes, the finger straight, until a sensor fires. If that is on the finger's proximal link or on the palm,
the distal joint closes until its link feels the object too, then the base joint goes on. If it is on the distal link,
the base joint stops, the distal joint curls to the preshape angle, then the base joint goes on.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from palmar.behaviours.reflex import INSTANT, Drive
from palmar.behaviours.sensor_places import SensorPlaces
from palmar.models.motion import Command, Joints, Observation

PROXIMAL, DISTAL = 0, 1


class Phase(Enum):
    """What one finger does."""

    CLOSE = "close until a sensor fires"
    WRAP = "felt near the palm: the distal joint closes to contact"
    CURL = "felt by the distal link: curl to the preshape angle"
    HOLD = "close the base joint"


@dataclass(frozen=True)
class JointedReflex:
    """Fingers of two joints; ``preshape`` (rad) is the distal angle to curl to. The state is both fingers' phases."""

    drive: Drive
    places: SensorPlaces
    preshape: float

    def begin(self, seen: Observation) -> tuple[Phase, Phase]:
        """Both close."""
        return Phase.CLOSE, Phase.CLOSE

    def step(self, state: tuple[Phase, Phase], seen: Observation) -> tuple[tuple[Phase, Phase], Command]:
        """Each finger's next phase and motion; over when both are held up in their last."""
        phases = self._next(0, state[0], seen), self._next(1, state[1], seen)
        why = "; ".join(
            f"{side}: {each.value}" for side, each in zip(("right", "left"), phases, strict=True)
        )  # fmt: skip
        over = all(
            stalled and before is after and after in (Phase.CLOSE, Phase.HOLD)
            for stalled, before, after in zip(seen.stalled, state, phases, strict=True)
        )
        if over:
            return phases, self.drive.end("both fingers are held up")
        left = [self._curl_left(joints) for phase, joints in zip(phases, (seen.right, seen.left), strict=True)
                if phase is Phase.CURL]  # fmt: skip
        return phases, Command(
            self._rates(phases[0]), self._rates(phases[1]), longest=min(left, default=None), why=why
        )  # fmt: skip

    def _next(self, finger: int, phase: Phase, seen: Observation) -> Phase:
        joints = (seen.right, seen.left)[finger]
        if phase is Phase.CLOSE:
            if self.places.palm_feels(seen) or self.places.link_feels(finger, PROXIMAL, seen):
                phase = Phase.WRAP
            elif self.places.link_feels(finger, DISTAL, seen):
                phase = Phase.CURL
            else:
                return phase
            held = False
        else:
            held = seen.stalled[finger]
        if phase is Phase.WRAP and (held or self.places.link_feels(finger, DISTAL, seen)):
            return Phase.HOLD
        if phase is Phase.CURL and (held or self._curl_left(joints) <= INSTANT):
            return Phase.HOLD
        return phase

    def _curl_left(self, joints: Joints) -> float:
        """Time (s) until the distal joint is at the preshape angle."""
        return (self.preshape - joints[DISTAL]) / self.drive.rate

    def _rates(self, phase: Phase) -> Joints:
        if phase in (Phase.WRAP, Phase.CURL):
            return 0.0, self.drive.rate
        return self.drive.rate, 0.0
