"""What has become of the object, and what touches it, by the planar world's own code from the poses that MuJoCo reached.

On a table a gap of up to ``NEAR`` finger lengths counts as a touch, and friction cones as wider by what the motors' limit
leaves open. In free space the object is caught once its centre is in a loop of the hand that no gap of its size leaves.
"""

from __future__ import annotations

from dataclasses import dataclass

from palmar.mechanics.pushing.closing_motion import TOUCHED, bench
from palmar.mechanics.pushing.closing_steps import TOLERANCE
from palmar.mechanics.pushing.polygon_contacts import scale_of
from palmar.mechanics.pushing.slider import slider_body
from palmar.models.motion import Joints
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.worlds.mujoco.scene import STRENGTH, Scene
from palmar.worlds.planar.carriage import NEAR as NEAR_IN_TOUCHES
from palmar.worlds.planar.carriage import Carriage, Touch
from palmar.worlds.planar.enclosure import Enclosure, enclosure_of

Both = tuple[Joints, Joints]
Place = tuple[float, float, float]
NEAR = 1e-3
"""In finger lengths."""
CONE_SLACK = 1.0 / STRENGTH + 0.01
"""A motor that is held up has pushed with STRENGTH table frictions, which lean a cone by about the inverse."""


@dataclass
class Judge:
    """Of objects on a table: by the final contacts (``closing_end``)."""

    carriage: Carriage

    def see(self, place: Place, arm: tuple[float, float]) -> None:
        """Look at the object at (x, y, theta) and the arm, in the frame where the hand started, from now on."""
        self.carriage.place, self.carriage.arm = place, arm

    def touches(self, angles: Both) -> list[Touch]:
        """Where the object touches the hand."""
        return self.carriage.touches(angles)

    def overlaps(self, angles: Both) -> bool:
        """Whether the object overlaps the hand by more than a start may."""
        return self.carriage.overlaps(angles)

    def decided(self, angles: Both) -> bool:
        """Whether the outcome is known for good: never, a hand may let go."""
        return False

    def outcome(self, angles: Both, gripped: tuple[bool, bool], touched: bool) -> Outcome:
        """What has become of the object, were this the end; ``gripped``: fingers that it stops."""
        self.carriage.at.state[TOUCHED] = 1.0 if touched else 0.0
        return Outcome.from_code(self.carriage.judged(angles, gripped))


@dataclass
class FreeJudge(Judge):
    """Of free disks: by whether the hand encloses them."""

    enclosure: Enclosure

    def decided(self, angles: Both) -> bool:
        """Whether the centre is in a loop of the hand; fingers that go on closing do not open it again."""
        x, y, _ = self.carriage.place
        ax, ay = self.carriage.arm
        return self.enclosure.shut(angles, x - ax, y - ay)

    def outcome(self, angles: Both, gripped: tuple[bool, bool], touched: bool) -> Outcome:
        """Enclosed, struck, or neither."""
        if self.decided(angles):
            return Outcome.CAGED
        return Outcome.ESCAPED if touched else Outcome.MISSED


def judge_of(scene: Scene, place: Place) -> Judge:
    """The judge of a scene's case."""
    length, free = scene.case.hand.finger_length, scene.case.support.kind is SupportKind.FREE
    body = slider_body(scene.slider, scene.case.contact.friction + (0.0 if free else CONE_SLACK))
    deepest = 0.1 * body.width
    scale = scale_of(length, body, TOLERANCE)._replace(touch=NEAR * length / NEAR_IN_TOUCHES, cut=deepest, deep=deepest)
    carriage = Carriage(scene.case.hand, body, bench(0), scale, place)
    if not free:
        return Judge(carriage)
    return FreeJudge(carriage, enclosure_of(scene.case))
