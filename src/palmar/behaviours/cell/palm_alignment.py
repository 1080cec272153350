"""Palm alignment (section 7.2): one palm bit on: turn the hand about that contact until the other comes on too.

The palm's two contact sensors lie side by side along the hand's x axis, and so does the cylinder's axis when the hand is
square to it. The hand turns about its y axis through the sensor that has felt the cylinder, the other side forward.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from palmar.models.salisbury_hand import SalisburyHand

Floats = NDArray[np.float64]


def aligned(pose: Floats, palm: tuple[bool, bool], hand: SalisburyHand, angle: float) -> Floats:
    """The hand's pose (4, 4) turned by ``angle`` (rad) about the sensor that is on; as it is if both are or neither is.

    Sensor 0 is at positive x; turning by a positive angle about y takes the side of negative x forward, along z.
    """
    if palm[0] == palm[1]:
        return pose
    side = 1.0 if palm[0] else -1.0
    cosine, sine = np.cos(angle), side * np.sin(angle)
    turn = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    pivot = np.array([side * hand.pad_offset, hand.grasp_line, 0.0])
    turned = pose.copy()
    turned[:3, :3] = pose[:3, :3] @ turn
    turned[:3, 3] = pose[:3, 3] + pose[:3, :3] @ (pivot - turn @ pivot)
    return turned
