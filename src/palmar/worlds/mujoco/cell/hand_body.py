"""The Salisbury hand as MuJoCo bodies: capsules for links, spheres for tips, two pads with contact sensors in the palm."""

from __future__ import annotations

from math import cos, pi, sin

from palmar.models.salisbury_hand import SalisburyHand


def hand_body(hand: SalisburyHand) -> str:
    """The body ``hand``, to be mounted on frame 6 of the arm; its frame is the hand frame."""
    fingers = "".join(_finger(hand, k) for k in range(3))
    x, y, z = hand.pads
    pads = "".join(
        f'<geom name="pad_{k}" type="box" pos="{sign * hand.pad_offset} {hand.grasp_line} {-z}" size="{x} {y} {z}"'
        f' class="palm"/><site name="pad_{k}" type="box" pos="{sign * hand.pad_offset} {hand.grasp_line} 0"'
        f' size="{x} {y} {2 * z}" rgba="0 0 0 0"/>'
        for k, sign in enumerate((1.0, -1.0))
    )
    back = hand.mount - 0.03
    spokes = "".join(
        f'<geom type="capsule" fromto="0 0 -0.025 {_at(hand, k, hand.base_circle)} -0.018" size="0.01" class="hand"/>'
        for k in range(3)
    )
    return f"""<body name="hand" pos="0 0 {hand.mount}">
    <inertial pos="0 0 -0.03" mass="{hand.palm_mass}" diaginertia="1.5e-3 1.5e-3 1.5e-3"/>
    <geom type="cylinder" fromto="0 0 -0.03 0 0 {-2.0 * z}" size="{0.7 * hand.palm_radius}" class="hand"/>
    <geom type="cylinder" fromto="0 0 {-back} 0 0 -0.03" size="0.03" class="hand"/>{spokes}{pads}{fingers}
    </body>"""


def _at(hand: SalisburyHand, finger: int, radius: float) -> str:
    return f"{radius * cos(hand.bases[finger])} {radius * sin(hand.bases[finger])}"


def _finger(hand: SalisburyHand, k: int) -> str:
    """In a frame whose z is the hand's and whose x points outward; curling inward turns about minus y."""
    near, far = hand.links
    lower, upper = zip(*hand.joint_limits, strict=True)
    names = [f"finger_{k}_{j}" for j in (1, 2, 3)]
    axes = ("1 0 0", "0 -1 0", "0 -1 0")
    joints = [
        f'<joint name="{names[j]}" axis="{axes[j]}" range="{lower[j]} {upper[j]}" armature="{hand.joint_inertias[j]}"'
        f' damping="0.002"/>'
        for j in range(3)
    ]
    link = f'type="capsule" size="{hand.link_radius}"'
    masses = hand.finger_masses
    return f"""<body name="finger_{k}" pos="{_at(hand, k, hand.base_circle)} 0" euler="0 0 {hand.bases[k] % (2 * pi)}">
    {joints[0]}<inertial pos="0 0 0" mass="0.01" diaginertia="1e-6 1e-6 1e-6"/>
    <body name="proximal_{k}">{joints[1]}
    <geom name="proximal_{k}" class="hand" fromto="0 0 0 0 0 {near}" mass="{masses[0]}" {link}/>
    <body name="distal_{k}" pos="0 0 {near}">{joints[2]}
    <geom name="distal_{k}" class="distal" fromto="0 0 0 0 0 {far}" mass="{0.8 * masses[1]}" {link}/>
    <geom name="tip_{k}" type="sphere" pos="0 0 {far}" size="{hand.tip_radius}" mass="{0.2 * masses[1]}" class="tip"/>
    <site name="tip_{k}" pos="0 0 {far}" size="0.001"/></body></body></body>"""
