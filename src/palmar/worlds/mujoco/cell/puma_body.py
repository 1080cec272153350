"""The Puma 560 as MuJoCo bodies: each link's frame is its DH frame, the shapes are plain capsules and cylinders.

Masses, centres of mass and inertias: the robotics toolbox after Armstrong, Khatib and Burdick (1986), who also give the
largest joint torques and the motors' inertias. Link 1 was not identified there; its mass is ours. Link 3's published
inertia about y, 0.086, exceeds the sum of the other two, which no body's does; it is cut to their sum.
"""

from __future__ import annotations

import numpy as np

from palmar.mechanics.arm.puma_560 import ALPHA, LOWER, UPPER, A, D

MASSES = (12.0, 17.4, 4.8, 0.82, 0.34, 0.09)
CENTRES = (
    (0.0, 0.0, 0.0),
    (-0.3638, 0.006, 0.2275),
    (-0.0203, -0.0141, 0.070),
    (0.0, 0.019, 0.0),
    (0.0, 0.0, 0.0),
    (0.0, 0.0, 0.032),
)
INERTIAS = (
    (0.35, 0.35, 0.35),
    (0.13, 0.524, 0.539),
    (0.066, 0.0785, 0.0125),
    (1.8e-3, 1.3e-3, 1.8e-3),
    (3e-4, 4e-4, 3e-4),
    (1.5e-4, 1.5e-4, 4e-5),
)
TORQUES = (97.6, 186.4, 89.4, 24.2, 20.1, 21.3)
"""Largest (N m)."""
MOTORS = (1.14, 4.71, 0.83, 0.20, 0.179, 0.193)
"""Inertias at the joints (kg m^2)."""
WIDTHS = (0.075, 0.065, 0.055, 0.05, 0.04, 0.035)
"""Radii of our capsules (m)."""


def puma_body(inner: str) -> str:
    """The chain of bodies in MuJoCo's language; ``inner``: what is mounted on frame 6."""
    text = inner
    for i in reversed(range(6)):
        frame = f'pos="{A[i]} 0 {D[i]}" euler="{ALPHA[i]:.17g} 0 0"'
        place = "" if i == 0 else f'pos="{A[i - 1]} 0 {D[i - 1]}" euler="{ALPHA[i - 1]:.17g} 0 0"'
        if i == 5:
            nothing = '<inertial pos="0 0 0" mass="1e-6" diaginertia="1e-9 1e-9 1e-9"/>'
            text = f'<body name="flange" {frame}>{nothing}{text}</body>'
        text = f"""<body name="link_{i + 1}" {place}>
        <joint name="arm_{i + 1}" axis="0 0 1" range="{LOWER[i]} {UPPER[i]}" armature="{MOTORS[i]}"/>
        {_inertial(i)}{_shape(i)}{text}</body>"""
    return f"""<geom name="pedestal" type="cylinder" fromto="0 0 -0.6718 0 0 -0.09" size="0.09" class="seen"
    rgba="0.35 0.37 0.4 1"/>{text}"""


def _inertial(i: int) -> str:
    """Given in the link's own DH frame, which lies beyond the joint."""
    cosine, sine = np.cos(ALPHA[i]), np.sin(ALPHA[i])
    x, y, z = CENTRES[i]
    there = (A[i] + x, cosine * y - sine * z, D[i] + sine * y + cosine * z)
    values = " ".join(str(each) for each in INERTIAS[i])
    return (
        f'<inertial pos="{there[0]} {there[1]} {there[2]}" euler="{ALPHA[i]:.17g} 0 0" mass="{MASSES[i]}"'
        f' diaginertia="{values}"/>'
    )


def _shape(i: int) -> str:
    """From one joint to the next; joints 1, 4 and 5 are only a knuckle."""
    ways = {
        0: "0 0 -0.09 0 0 0.05",
        1: f"0 0 {D[2]} {A[1]} 0 {D[2]}",
        2: f"{A[2]} 0 {D[2]} {A[2]} {D[3] - 0.06} {D[2]}",
        5: "0 0 0 0 0 0.06",
    }
    if i not in ways:
        return f'<geom type="sphere" size="{WIDTHS[i]}" class="arm"/>'
    return f'<geom type="capsule" fromto="{ways[i]}" size="{WIDTHS[i]}" class="arm"/>'
