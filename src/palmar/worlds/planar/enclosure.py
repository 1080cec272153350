"""Whether the hand, as it stands, shuts a free disk in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from palmar.mechanics.impact.capture_case import capture_hand_of
from palmar.mechanics.impact.enclosed import enclosed_now
from palmar.mechanics.impact.finger_motion import ANGLE, FINGER_WIDTH, CaptureHand
from palmar.models.behaviour import Behaviour
from palmar.models.case import Case
from palmar.models.motion import Joints


@dataclass(frozen=True)
class Enclosure:
    """Asks of joint angles, right and left, and the centre (m) in the hand frame."""

    hand: CaptureHand

    def shut(self, angles: tuple[Joints, Joints], x: float, y: float) -> bool:
        """Whether the centre is in a loop of the hand that no gap of the disk's size leaves."""
        count = len(self.hand.lengths)
        fingers, chain = np.zeros((2, FINGER_WIDTH)), np.zeros((2 * count + 2, 2))
        fingers[:, ANGLE : ANGLE + count] = np.cumsum(angles, axis=1)
        return bool(enclosed_now(self.hand, fingers, 0.0, x, y, chain))


def enclosure_of(case: Case) -> Enclosure:
    """Of a case's hand and free disk, whatever it does; raises NotCoveredError for other objects."""
    links = np.array(case.hand.finger_links)
    still = np.zeros((1, 2, len(links)))
    hand = capture_hand_of(case.model_copy(update={"behaviour": Behaviour()}))
    return Enclosure(hand._replace(lengths=links, angles=still, rates=still))
