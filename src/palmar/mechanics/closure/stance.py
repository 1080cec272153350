"""How a hand stands around a disk that it holds: every joint's angle, not only the joints that matter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.chain import Chain, Hold

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Stance:
    """A disk of ``radius`` with its centre at (0, ``height``) (m), both fingers at joint ``angles`` (rad).

    Angles are the base joint's from the outward palm line, and further ones from straight. Link ``last`` (from 1) has the
    highest contact, at ``elevation`` (rad); ``carrier`` is the link that carries the disk, 0 for the palm, None for
    friction at the highest contact.
    """

    radius: float
    height: float
    angles: tuple[float, ...]
    last: int
    elevation: float
    carrier: int | None

    def joints(self, half_palm: float, links: tuple[float, ...]) -> Floats:
        """Joints and tip of the right finger (links + 1, 2), m."""
        turned = np.cumsum(self.angles)
        steps = np.stack([np.cos(turned), np.sin(turned)], axis=1) * np.array(links)[:, None]
        return np.concatenate([[[half_palm, 0.0]], steps]).cumsum(axis=0)


def stance_of(hold: Hold, chain: Chain) -> Stance:
    """The stance of a hold: through its joints, the last link on to its contact, the rest straight on."""
    rho = hold.radius + chain.half_thickness
    contact = rho * np.array([np.cos(hold.elevation), np.sin(hold.elevation)]) + [0.0, hold.height]
    steps = np.diff(np.vstack([hold.joints, contact]), axis=0)
    directions = np.arctan2(steps[:, 1], steps[:, 0])
    directions = np.concatenate([directions, np.full(len(chain.links) - directions.size, directions[-1])])
    angles = tuple(float(each) for each in np.diff(directions, prepend=0.0))
    return Stance(hold.radius, hold.height, angles, hold.last, hold.elevation, hold.carrier)
