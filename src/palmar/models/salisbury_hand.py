"""The Salisbury (Stanford/JPL) hand: three fingers of three joints around a palm, four tendons to a finger.

Topology and tendon law are those of the patent (US 4921293). It prints no lengths, radii or limits: every number here is
our assumption, and this is the only place where the hand's numbers stand.

Hand frame: origin in the middle of the palm's face, z out of the palm, finger k's base at angle ``bases[k]`` from x.
A finger's joint 1 turns about the outward radial line (sideways swing), joints 2 and 3 about parallel tangential lines;
angles are 0 when the finger stands up along z, joints 2 and 3 are positive inward, over the palm.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from palmar.errors import InputError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Curl:
    """Moves a finger in its plane with one motion c (rad): joints (0, c, bend + ratio c); open at ``opened``."""

    bend: float
    ratio: float
    opened: float

    def joints(self, curls: Floats) -> Floats:
        """Joint angles (…, 3) of curls (…) in rad."""
        angles = np.asarray(curls, float)[..., None] * (0.0, 1.0, self.ratio)
        angles[..., 2] += self.bend
        return angles


TIP_PREHENSION = Curl(bend=0.60, ratio=0.30, opened=-0.40)
"""Tips ahead of the links, moving inward along almost a straight line."""
CYLINDRIC = Curl(bend=1.90, ratio=1.00, opened=-0.70)
"""Fingers like hooks, which press a cylinder of 60 to 70 mm diameter on the palm from both sides and do not meet over it."""


@dataclass(frozen=True)
class SalisburyHand:
    """Lengths in m, masses in kg, angles in rad, tensions in N; all of them declared assumptions.

    ``base_circle``: radius of the circle of the joints 2; ``links``: proximal, distal up to the tip's centre;
    ``radii``: R1, R2, R3 of the tendons' pulleys (the patent's drawing has R3 > R1 > R2); ``mount``: from frame 6
    of the arm to the palm's face along their common z axis; ``pads``: half sizes of one of the palm's two contact
    sensors, which lie side by side along x at plus and minus ``pad_offset``, shifted by ``grasp_line`` along y: the
    middle between finger 0 and the bases of the others, where a cylinder lies across the palm.
    """

    bases: tuple[float, float, float] = (pi / 2, pi / 2 + 2 * pi / 3, pi / 2 - 2 * pi / 3)
    base_circle: float = 0.060
    links: tuple[float, float] = (0.060, 0.050)
    link_radius: float = 0.008
    tip_radius: float = 0.009
    finger_masses: tuple[float, float] = (0.06, 0.04)
    palm_mass: float = 1.0
    palm_radius: float = 0.050
    pads: tuple[float, float, float] = (0.0155, 0.024, 0.003)
    pad_offset: float = 0.0165
    mount: float = 0.13
    radii: tuple[float, float, float] = (0.010, 0.008, 0.012)
    tension_least: float = 5.0
    tension_most: float = 200.0
    joint_inertias: tuple[float, float, float] = (2e-3, 2e-3, 1e-3)
    joint_limits: tuple[tuple[float, float], ...] = ((-0.5, 0.5), (-0.8, 1.4), (-0.3, 2.2))

    def __post_init__(self) -> None:
        lengths = (self.base_circle, *self.links, self.link_radius, self.tip_radius, self.palm_radius, self.mount)
        if min(*lengths, *self.radii, *self.finger_masses, self.palm_mass, *self.joint_inertias) <= 0.0:
            raise InputError("hand", None, "lengths, radii, masses and inertias must be positive")
        if not 0.0 < self.tension_least < self.tension_most:
            raise InputError(
                "hand",
                f"tensions {self.tension_least:g} to {self.tension_most:g} N",
                "must be positive and in this order",
            )

    @property
    def tendon_matrix(self) -> Floats:
        """(3, 4): joint torques are this times tensions; the patent's law."""
        one, two, three = self.radii
        return np.array([[-one, two, two, -one], [three, two, -two, -three], [0.0, two, -two, 0.0]])

    @property
    def grasp_line(self) -> float:
        """y (m) in the hand frame of the middle between the base of finger 0 and those of fingers 1 and 2."""
        return 0.25 * self.base_circle

    @property
    def width(self) -> float:
        """Across the bases of the fingers (m)."""
        return 2.0 * (self.base_circle + self.link_radius)
