"""The cell as a MuJoCo scene: arm, hand, and a cylinder that stands on a table or hangs from a counterweighted bar.

World frame = the arm's base frame. The hand touches the cylinder and the table, and fingers touch each other. Nothing
is ever attached: what holds the cylinder is friction. The bar hangs in its middle from a ceiling point about which it turns
and tilts; the thread at its end is taut or slack, it only pulls. Its counterweight balances the cylinder.
"""

from __future__ import annotations

from math import atan2, cos, degrees, pi, sin

from palmar.models.cell_task import TABLE_TOP, CellTask, TaskKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.mujoco.cell.hand_body import hand_body
from palmar.worlds.mujoco.cell.puma_body import TORQUES, puma_body

STEP = 1e-3
"""Physics step and servo tick (s)."""
THREAD, BAR = 0.50, 0.40
"""Length (m) of the thread; half length of the bar."""
PADDING = 0.015
"""Time (s) in which the palm's rubber gives way: it softens what the moving arm does to a standing cylinder."""
EYE_DISTANCE, EYE_DOWN, EYE_FIELD = 0.70, 0.55, 0.07
"""Of the camera from the cylinder's place (m); how far down it looks (rad); what it sees around the cylinder (m)."""
EYE_TURN = {TaskKind.TABLE: 0.5 * pi, TaskKind.FLOATING: 0.6, TaskKind.ALIGN: 0.6}
"""Where it stands about the cylinder, from x toward y (rad)."""
OBJECT, TABLE, HAND, FINGER = 1, 2, 4, 8
"""Collision bits."""


def cell_xml(hand: SalisburyHand, task: CellTask) -> str:
    """The whole scene in MuJoCo's language; qpos: 6 arm joints, 9 finger joints, then the cylinder's free joint."""
    floating = task.kind is TaskKind.FLOATING
    motors = "".join(
        f'<motor name="arm_{i + 1}" joint="arm_{i + 1}" ctrlrange="{-most} {most}"/>' for i, most in enumerate(TORQUES)
    ) + "".join(f'<motor name="finger_{k}_{j}" joint="finger_{k}_{j}"/>' for k in range(3) for j in (1, 2, 3))
    x, y, z = task.place
    return f"""<mujoco model="cell"><compiler angle="radian" autolimits="true" eulerseq="XYZ"/>
    <option timestep="{STEP}" cone="elliptic" impratio="20" integrator="implicitfast"><flag multiccd="enable"/></option>
    <visual><global offwidth="960" offheight="720"/><headlight ambient="0.35 0.35 0.35" diffuse="0.45 0.45 0.45"/></visual>
    <default>{_classes(task)}</default>
    <asset><texture type="skybox" builtin="flat" rgb1="0.97 0.97 0.97" width="8" height="8"/></asset>
    <worldbody><light pos="0.6 -1.2 2" dir="-0.1 0.6 -1" diffuse="0.4 0.4 0.4" castshadow="false"/>
    <geom name="floor" type="plane" pos="0 0 -0.6718" size="2 2 0.1" class="seen" rgba="0.86 0.87 0.88 1"/>
    {"" if floating else _table()}{puma_body(hand_body(hand))}{_cylinder(task)}{_bar(task) if floating else ""}
    <camera name="film" pos="{x + 0.66} {y - 1.05} {z + (0.35 if floating else 0.45)}" fovy="{34 if floating else 30}"
    xyaxes="0.80 0.60 0 -0.17 0.23 0.96"/>{_eye(task)}
    </worldbody>{_thread() if floating else ""}<actuator>{motors}</actuator>
    <sensor><touch site="pad_0"/><touch site="pad_1"/></sensor></mujoco>"""


def _classes(task: CellTask) -> str:
    friction = task.cylinder.friction_hand
    rub = f'friction="{friction} 0.005 0.0001" condim="4" solref="0.004 1" solimp="0.95 0.99 0.0005"'
    touch = f'contype="{HAND}" conaffinity="{OBJECT | TABLE}" {rub} priority="1"'
    meet = f'contype="{HAND | FINGER}" conaffinity="{OBJECT | TABLE | FINGER}" {rub} priority="1"'
    return f"""<geom density="0"/>
    <default class="seen"><geom contype="0" conaffinity="0"/></default>
    <default class="arm"><geom {touch} rgba="0.55 0.60 0.68 1"/></default>
    <default class="hand"><geom {touch} rgba="0.30 0.32 0.36 1"/></default>
    <default class="distal"><geom {meet} rgba="0.30 0.32 0.36 1"/></default>
    <default class="tip"><geom {meet} rgba="0.90 0.62 0.0 1"/></default>
    <default class="palm"><geom {touch.replace("0.004 1", f"{PADDING} 1")} rgba="0.0 0.45 0.70 1"/></default>"""


def _table() -> str:
    return f"""<geom name="table" type="plane" pos="0.5 0 {TABLE_TOP}" size="0.35 0.45 0.05" contype="{TABLE}"
    conaffinity="{OBJECT | HAND}" friction="0 0 0" solref="0.004 1" rgba="0.80 0.74 0.64 1"/>"""


def _eye(task: CellTask) -> str:
    """The camera of vision, where neither the open hand nor the arm comes between: it looks down from aside.

    A hand from above has the gap between two fingers toward y; one that comes along x is behind the cylinder, and so is
    the pedestal unless the camera is turned away from it.
    """
    turn = EYE_TURN[task.kind]
    cosine, sine, out, up = cos(turn), sin(turn), cos(EYE_DOWN), sin(EYE_DOWN)
    x, y, z = (
        there + EYE_DISTANCE * way for there, way in zip(task.place, (out * cosine, out * sine, up), strict=True)
    )
    fovy = 2.0 * atan2(EYE_FIELD + 0.5 * task.cylinder.height, EYE_DISTANCE)
    return f"""<camera name="eye" pos="{x} {y} {z}" fovy="{degrees(fovy)}"
    xyaxes="{-sine} {cosine} 0 {-up * cosine} {-up * sine} {out}"/>"""


def _cylinder(task: CellTask) -> str:
    body, (x, y, z) = task.cylinder, task.place
    return f"""<body name="object" pos="{x} {y} {z}"><freejoint name="object"/>
    <geom name="object" type="cylinder" size="{body.radius} {0.5 * body.height}" mass="{body.mass}"
    contype="{OBJECT}" conaffinity="{TABLE | HAND}" friction="{body.friction_table} 0.003 0.0001" condim="4"
    solref="0.004 1" rgba="0.84 0.37 0.0 1"/><site name="thread_low" pos="0 0 {0.5 * body.height}" size="0.003"/></body>"""


def _bar(task: CellTask) -> str:
    x, y, z = task.place
    end = z + 0.5 * task.cylinder.height + THREAD
    weight = task.cylinder.mass
    return f"""<geom type="capsule" fromto="{x} {y + BAR} {end} {x} {y + BAR} {end + 0.25}" size="0.003" class="seen"
    rgba="0.4 0.4 0.4 1"/><body name="bar" pos="{x} {y + BAR} {end}">
    <joint name="bar_turn" axis="0 0 1" damping="0.002"/>
    <joint name="bar_tilt" axis="1 0 0" range="-0.6 0.6" damping="0.004"/>
    <geom type="capsule" fromto="0 {-BAR} 0 0 {BAR} 0" size="0.006" mass="0.1" class="seen" rgba="0.5 0.4 0.3 1"/>
    <geom type="sphere" pos="0 {BAR} -0.02" size="0.03" mass="{weight}" class="seen" rgba="0.2 0.2 0.2 1"/>
    <site name="thread_high" pos="0 {-BAR} 0" size="0.003"/></body>"""


def _thread() -> str:
    return f"""<tendon><spatial name="thread" limited="true" range="0 {THREAD}" width="0.002" solreflimit="0.01 1"
    rgba="0.1 0.1 0.1 1"><site site="thread_low"/><site site="thread_high"/></spatial></tendon>"""
