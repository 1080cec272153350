"""A case as a MuJoCo scene: the hand on its arm, the object, and the table under it, all in one plane.

Only named pairs of geoms touch: the object with the hand, and fingers of one plane with each other. Surfaces are where
the case has them: the hand's capsules are thicker than its links by ``rounding`` and the object thinner by as much, so that
line fingers and a line palm have a body too. A disk is a sphere, so that its contacts are closed forms; polygons are prisms.

The table's friction is that of the case's pressure (``table_friction``), or one contact that resists turning too, of a
ball at the centre of pressure: the ellipsoidal limit surface with c = (largest moment) / (largest force). The ball is on a
foot that slides up and down by itself: were it the object, the friction of a fingertip that slides a little up or down
would lift it, and it would hop over the table. In free space there is no table and no weight;
contacts are damped springs of the case's restitution (``impacts``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.mechanics.pushing.hand_pose import MOST_LINKS
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import Slider, slider_body
from palmar.models.case import Case
from palmar.models.hand import Fingers
from palmar.models.objects import Disk
from palmar.models.support import SupportKind
from palmar.worlds.mujoco.bed import bed_motors, puck_joints
from palmar.worlds.mujoco.impacts import CONTACT_TIME, GAP, spring_of
from palmar.worlds.mujoco.table_friction import TableLaw

GRAVITY = 9.81
STEP, FREE_STEP = 1e-3, 1e-4
"""Time steps (s) on a table and in free space; docs/results/mujoco_world.md says what halving them changes."""
HEAVY = 1e4
"""Inertia of a finger that is not slowed by impacts, and of the arm, in units of the object's."""
START_TIME = 0.05
"""In free space a joint's motor brings it to the finger rate in so long (s), if something has stopped it."""
STRENGTH = 20.0
"""The motors push a fingertip with so many times the table's friction, at most."""
LEAST_FRICTION = 0.05
"""The same for tables of less friction than this."""
ROUNDING = 0.002
"""In reaches of the object."""
HARD = 0.9999
"""Impedance of contacts in free space: all but 1e-4 of a spring's push is felt."""
EXACTLY = 1e-13
"""Of the contact solver, which divides by the mean inertia, and the arm's is large: at 1e-8 boxes creep along fingers."""
MEETING = 1e-4
"""Half thickness, in finger lengths, with which line fingers of one plane meet."""
STIFFNESS = 0.2
"""Of a joint's servo, in units of inertia / step^2: explicit steps are stable below 1."""
UPPER = 1e-6
"""Share of the object's mass that is not on its foot."""
COUPLED = 1e-6
"""How far (m) its centre of mass is off its origin, for MuJoCo to see that dampers couple its coordinates."""
MOST_CORNERS, THINNEST = 64, 0.1
"""Corners; least width of a polygon in its reaches."""
SIDES = (("right", 1.0), ("left", -1.0))
PLANE = (("x", "1 0 0"), ("y", "0 1 0"))
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Scene:
    """The case, its object about the centre of pressure, time step (s), the table's law, and whether motors are a bed's."""

    case: Case
    slider: Slider
    step: float
    law: TableLaw = TableLaw.EXACT
    servos: bool = False

    @property
    def on_foot(self) -> bool:
        """Whether the table is a single contact."""
        return not self.free and self.law is TableLaw.ELLIPSOID

    @property
    def free(self) -> bool:
        """Whether the object is in free space."""
        return self.case.support.kind is SupportKind.FREE

    @property
    def reach(self) -> float:
        """Largest distance (m) of a point of the object from its centre of pressure."""
        core = self.slider.core
        return float(np.hypot(core[:, 0], core[:, 1]).max()) + self.slider.rounding

    @property
    def rounding(self) -> float:
        """By how much (m) the hand's links are thicker and the object thinner."""
        return ROUNDING * self.reach

    @property
    def torque(self) -> float:
        """Largest (N m) of a finger's joint."""
        if self.free:
            return self.inertia * self.case.hand.finger_rate / START_TIME
        friction = max(self.case.support.friction, LEAST_FRICTION)
        return STRENGTH * friction * self.case.object.mass * GRAVITY * self.case.hand.finger_length

    @property
    def inertia(self) -> float:
        """Of a joint's motor (kg m^2): that of the object at the fingertip, or much more in free space; or the bed's."""
        if self.servos:
            return self.case.bed.joint_inertia
        return (HEAVY if self.free else 1.0) * self.case.object.mass * self.case.hand.finger_length**2

    def xml(self) -> str:
        """The scene in MuJoCo's language."""
        return f"""<mujoco><compiler angle="radian"/>
        <option timestep="{self.step}" cone="elliptic" impratio="10" integrator="implicitfast" tolerance="{EXACTLY}"
        gravity="0 0 {0.0 if self.free else -GRAVITY}"><flag multiccd="enable"/></option>{self._mesh()}
        <default><geom contype="0" conaffinity="0"/><joint solreflimit="{2.0 * self.step} 1" solimplimit="0.99 0.99 0.001"/>
        <pair solref="{2.0 * self.step} 1" solimp="0.99 0.99 0.001"/></default>
        <worldbody><geom name="floor" type="plane" size="1 1 1"/>{self._hand()}{self._object()}</worldbody>
        <contact>{"".join(self._pairs())}</contact>{self._actuators()}{self._dampers()}</mujoco>"""

    def meeting(self, model: Any) -> list[int]:
        """Numbers of the geoms with which fingers of one plane meet."""
        count = len(self.case.hand.finger_links)
        return [model.geom(f"meets_{name}_{k + 1}").id for name, _ in SIDES for k in range(count)]

    def _hand(self) -> str:
        hand, mass = self.case.hand, HEAVY * self.case.object.mass
        slides = "".join(
            f'<joint name="arm_{name}" type="slide" axis="{axis}" armature="{mass}"/>' for name, axis in PLANE
        )
        width = f"{-hand.half_palm} 0 0 {hand.half_palm} 0 0"
        palm = f'<geom name="palm" type="capsule" size="{self.rounding}" fromto="{width}" mass="0.001"/>'
        fingers = "".join(self._finger(name, side) for name, side in SIDES)
        return f'<body name="arm" pos="0 0 {self.reach}">{slides}{palm}{fingers}</body>'

    def _finger(self, name: str, side: float) -> str:
        """One link in the other, from the base to the tip."""
        hand, inner = self.case.hand, ""
        for k in range(len(hand.finger_links) - 1, -1, -1):
            at = side * (hand.finger_links[k - 1] if k > 0 else hand.half_palm)
            line = f'type="capsule" fromto="0 0 0 {side * hand.finger_links[k]} 0 0" mass="0.001"'
            meets = max(hand.half_thickness, MEETING * hand.finger_length)
            inner = (
                f'<body pos="{at} 0 0"><joint name="{name}_{k + 1}" axis="0 0 {side}" armature="{self.inertia}"'
                ' actuatorfrclimited="true" actuatorfrcrange="-1 1" limited="true" range="-1 1"/>'
                f'<geom name="{name}_{k + 1}" size="{hand.half_thickness + self.rounding}" {line}/>'
                f'<geom name="meets_{name}_{k + 1}" size="{meets}" {line}/>{inner}</body>'
            )
        return inner

    def _object(self) -> str:
        """In the plane. As a single contact with the table its weight is on a foot: no finger's friction lifts that."""
        slide, turn = puck_joints(self.case.bed) if self.free else ("", "")
        slides = "".join(f'<joint name="object_{each}" type="slide" axis="{axis}"{slide}/>' for each, axis in PLANE)
        weight = self._weight(1.0)
        if self.on_foot:
            ball = f'<geom name="ball" type="sphere" size="{self.reach}"/>'
            foot = f'<body><joint type="slide" axis="0 0 1"/>{self._weight(1.0 - UPPER)}{ball}</body>'
            weight = self._weight(UPPER) + foot
        inner = f'{slides}<joint name="object_turn" axis="0 0 1"{turn}/>{weight}{self._outline()}'
        return f'<body name="object" pos="0 0 {self.reach}">{inner}</body>'

    def _weight(self, share: float) -> str:
        mass = share * self.case.object.mass
        around = 0.5 * mass * self.reach**2
        return f'<inertial pos="{COUPLED} 0 0" mass="{mass}" diaginertia="{around} {around} {around}"/>'

    def _dampers(self) -> str:
        """Of ``TableFriction``."""
        if self.free or self.on_foot:
            return ""
        turns = '<joint joint="object_turn" coef="0"/>'
        each = "".join(f'<fixed><joint joint="object_{name}" coef="1"/>{turns}</fixed>' for name, _ in PLANE)
        return f"<tendon>{each}</tendon>"

    def _outline(self) -> str:
        """The object's geom."""
        core = self.slider.core
        if len(core) == 1:
            size = self.slider.rounding - self.rounding
            return f'<geom name="outline" type="sphere" size="{size}" pos="{core[0, 0]} {core[0, 1]} 0"/>'
        return '<geom name="outline" type="mesh" mesh="outline"/>'

    def _mesh(self) -> str:
        """A polygon's prism."""
        if len(self.slider.core) == 1:
            return ""
        corners, height = inset(self.slider.core, self.rounding), 0.5 * self.reach
        points = " ".join(f"{x} {y} {z}" for x, y in corners for z in (-height, height))
        return f'<asset><mesh name="outline" vertex="{points}"/></asset>'

    def _pairs(self) -> Iterator[str]:
        grip, table = self.case.contact.friction, self.case.support.friction
        if self.on_foot:
            turning = table * self.slider.surface.length
            yield f'<pair geom1="floor" geom2="ball" condim="4" friction="{table} {table} {turning} 0 0"/>'
        kind = f'condim="3" friction="{grip} {grip} 0 0 0"' if grip > 0.0 else 'condim="1"'
        count = len(self.case.hand.finger_links)
        links = [f"{name}_{k + 1}" for name, _ in SIDES for k in range(count)]
        for link in ("palm", *links):
            yield f'<pair geom1="{link}" geom2="outline" {kind}{self._bounce()}/>'
        if self.case.hand.fingers is Fingers.COLLIDING:
            for one in links[:count]:
                for other in links[count:]:
                    yield f'<pair geom1="meets_{one}" geom2="meets_{other}" condim="1"/>'

    def _bounce(self) -> str:
        """Of contacts that give the case's restitution."""
        if not self.free:
            return ""
        stiffness, damping = spring_of(self.case.contact.restitution, self.step)
        sticking = f' solreffriction="{0.5 * CONTACT_TIME} 1"'  # an elastic contact's own damping, none, lets it slip
        return f' solref="{-stiffness} {-damping}"{sticking} solimp="{HARD} {HARD} 0.001" gap="{GAP}"'

    def _actuators(self) -> str:
        joints = [f"{name}_{k + 1}" for name, _ in SIDES for k in range(len(self.case.hand.finger_links))]
        arm = "".join(self._servo(each, HEAVY * self.case.object.mass) for each in ("arm_x", "arm_y"))
        if self.servos:
            return bed_motors(self.case.bed, joints, arm)
        return f"<actuator>{''.join(self._servo(each, self.inertia) for each in joints)}{arm}</actuator>"

    def _servo(self, joint: str, inertia: float) -> str:
        """A spring to a set point that moves, and a damper."""
        stiff = STIFFNESS * inertia / self.step**2
        damper = f'<velocity joint="{joint}" kv="{2.0 * (stiff * inertia) ** 0.5}"/>'
        return f'<intvelocity joint="{joint}" kp="{stiff}" actrange="-1e6 1e6"/>{damper}'


def scene_of(case: Case, step: float | None = None, law: TableLaw = TableLaw.EXACT, servos: bool = False) -> Scene:
    """The scene of a case; raises NotCoveredError for what it does not have."""
    hand = case.hand
    if case.ranges:
        raise NotCoveredError("a simulation takes plain numbers, not ranges")
    if len(hand.finger_links) > MOST_LINKS:
        raise NotCoveredError(f"a simulated finger has at most {MOST_LINKS} links, not {len(hand.finger_links)}")
    if case.support.wall is not None:
        raise NotCoveredError("support.wall_mm: the world mujoco has no wall")
    free = case.support.kind is SupportKind.FREE
    if free and not isinstance(case.object, Disk):
        raise NotCoveredError('object.shape = "polygon": in free space only disks are simulated')
    if free and hand.finger_mass is not None:
        raise NotCoveredError("hand.finger_mass_kg: the world mujoco has heavy fingers only")
    scene = Scene(case, slider_of(case.object, case.support), step or (FREE_STEP if free else STEP), law, servos)
    corners = len(scene.slider.core)
    if corners > MOST_CORNERS:
        raise NotCoveredError(f"the world mujoco has polygons of up to {MOST_CORNERS} corners, not {corners}")
    if corners > 1 and slider_body(scene.slider, 0.0).width < THINNEST * scene.reach:
        raise NotCoveredError("the world mujoco has no polygons thinner than a tenth of their reach")
    return scene


def inset(corners: Floats, by: float) -> Floats:
    """The corners (V, 2) of a convex polygon whose edges are moved inwards by so much (m)."""
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.hypot(along[:, 0], along[:, 1])[:, None]
    before = np.roll(along, 1, axis=0)
    inward = np.stack([-along[:, 1], along[:, 0]], axis=1)
    cross = before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0]
    slant = (1.0 - np.einsum("ij,ij->i", before, along)) / cross
    found: Floats = corners + by * (inward + slant[:, None] * along)
    return found
