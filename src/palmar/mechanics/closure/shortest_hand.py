"""The shortest hand that holds a disk of radius R without friction, for n links a finger.

The hand must wrap the lower half of the disk, from equator to equator, outside it. A link that turns by 2a around the
centre is at least 2 R tan a long, the last one, which ends at the equator and may not lean outwards, at least R tan a
for a. tan is convex, so equal angles are best: 4n of them share the half turn. The hand is half of a regular polygon
with 4n sides; its length tends to pi R. Derived in docs/derivations/four_jointed.md (section 5.1.2 has n = 1 and 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, tan


@dataclass(frozen=True)
class ShortestHand:
    """Half palm and link lengths from proximal to distal (m)."""

    half_palm: float
    links: tuple[float, ...]

    @property
    def length(self) -> float:
        """Whole hand: palm and both fingers (m)."""
        return 2.0 * (self.half_palm + sum(self.links))


def shortest_hand(links: int, radius: float) -> ShortestHand:
    """The optimal hand with ``links`` >= 1 links a finger for disks of ``radius`` (m): 4 n R tan(pi / 4n) long."""
    half = radius * tan(pi / (4.0 * links))
    return ShortestHand(half, (2.0 * half,) * (links - 1) + (half,))
