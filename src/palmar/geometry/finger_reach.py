"""How far ahead of the palm a finger reaches."""

from __future__ import annotations

from collections.abc import Sequence
from math import sin


def finger_reach(links: Sequence[float], joints: Sequence[float], half_thickness: float) -> float:
    """Largest y (m) of the surface of links (m) at ``joints`` (rad), base angle first, straight where none is given."""
    height, reach, angle = 0.0, 0.0, 0.0
    for k, length in enumerate(links):
        angle += joints[k] if k < len(joints) else 0.0
        height += length * sin(angle)
        reach = max(reach, height)
    return reach + half_thickness
