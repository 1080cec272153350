"""Random questions put to the closing kernels and to the slow reference alike, and how each of them answers.

Lengths in units of the whole finger. A hand's palm is narrower or wider than its finger; fingers are lines or thick,
pass each other or meet, have one to three links, straight or with joints that turn along with the base; objects are
disks and polygons of 3 to 7 corners; a third of the frictions is 0; some starts touch the open hand, some overlap it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from shapely import LineString, Point, Polygon

from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_steps import carry
from palmar.mechanics.pushing.closing_tables import ClosingHand
from palmar.mechanics.pushing.hand_pose import HandMotion, hand_motion
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.mechanics.pushing.polygon_contacts import Body, disk_body, polygon_body
from palmar.models.outcome import Outcome

from .slow_closing import COARSE, Result, close_hand
from .slow_contacts import placed
from .slow_model import Hand, Numerics, Object
from .slow_verdict import links_at_start

WORDS = {Outcome.JAMMED.value: "escaped", Outcome.STRUCTURAL.value: "caught", Outcome.FRICTIONAL.value: "caught",
         Outcome.CAGED.value: "caught"}  # fmt: skip


@dataclass(frozen=True)
class Question:
    """One hand, one object (a disk if it has no vertices; else about its area centroid), one start."""

    half_palm: float
    links: tuple[float, ...]
    half_thickness: float
    crossing: bool
    first: float
    offsets: tuple[float, ...]
    ratios: tuple[float, ...]
    radius: float
    vertices: tuple[tuple[float, float], ...]
    friction: float
    start: tuple[float, float, float]
    wall: float = math.inf
    speed: float = 0.0

    @property
    def size(self) -> float:
        """The object's reach from its frame's origin."""
        return max((math.hypot(*each) for each in self.vertices), default=self.radius)

    @property
    def hand(self) -> Hand:
        """For the reference: the clock is the base angle."""
        rest = math.pi - self.first
        joints = [[self.first, *self.offsets], [math.pi, *(np.add(self.offsets, np.multiply(self.ratios, rest)))]]
        clock = np.array([self.first, math.pi])
        return Hand(
            self.half_palm, self.links, self.half_thickness, self.crossing, clock=clock, joints=np.array(joints),
            wall=self.wall, speed=self.speed,
        )  # fmt: skip

    @property
    def motion(self) -> HandMotion:
        """For the kernels."""
        return hand_motion(
            self.half_palm, self.links, self.half_thickness, first=self.first, offsets=self.offsets, ratios=self.ratios,
            colliding=not self.crossing,
        )._replace(wall=self.wall, vy=self.speed)  # fmt: skip

    @property
    def thing(self) -> Object:
        """For the reference."""
        return Object(self.radius, np.array(self.vertices).reshape(-1, 2))

    @property
    def body(self) -> Body:
        """For the stepping kernel."""
        return polygon_body(self.vertices, self.friction) if self.vertices else disk_body(self.radius, self.friction)

    @property
    def by_events(self) -> bool:
        """Whether the event-to-event kernel takes it too."""
        straight = not any(self.offsets) and not any(self.ratios)
        thin = self.half_thickness == 0.0 or self.friction == 0.0
        return not self.vertices and straight and thin and self.wall == math.inf and self.speed == 0.0

    def moved(self, x: float, y: float, theta: float) -> Question:
        """The same from a start a little aside."""
        return replace(self, start=tuple(np.add(self.start, (x, y, theta)).tolist()))


@dataclass(frozen=True)
class Answer:
    """Outcome, end pose, base angles right and left, flags of the stepping kernel."""

    outcome: str
    pose: tuple[float, float, float]
    fingers: tuple[float, float]
    flags: int = 0

    @property
    def word(self) -> str:
        """caught, escaped, missed, invalid or undecided."""
        return WORDS.get(self.outcome, self.outcome)


def by_reference(question: Question, numerics: Numerics = COARSE) -> Answer:
    """The slow reference's answer."""
    result: Result = close_hand(question.hand, question.thing, question.friction, question.start, numerics)
    right, left = (float(each) for each in result.joints[:, 0])
    return Answer(result.outcome, tuple(result.pose.tolist()), (right, left))


def by_steps(question: Question, tolerance: float = 1e-7) -> Answer:
    """The stepping kernel's answer."""
    end, _ = carry(question.motion, question.body, *question.start, tolerance=tolerance)
    return Answer(Outcome.from_code(end.code).value, (end.x, end.y, end.theta), (end.right, end.left), end.flags)


def by_events(question: Question) -> Answer:
    """The event-to-event kernel's answer."""
    motion = question.motion
    hand = ClosingHand(
        question.half_palm, sum(question.links), question.half_thickness, question.radius, question.friction,
        question.first, motion.last, motion.alone,
    )  # fmt: skip
    x, y, theta = question.start
    ends = close_disk(hand, disk_surface(question.radius), [(x, y)])
    turned = tuple(np.add(ends.poses[0], (0.0, 0.0, theta)).tolist())
    right, left = ends.fingers[0].tolist()
    return Answer(Outcome.from_code(int(ends.codes[0])).value, turned, (right, left))


def apart(one: Answer, other: Answer, size: float) -> float:
    """How far the end poses differ, in sizes of the object: position, and angle as the way of its farthest point."""
    x, y, theta = np.subtract(one.pose, other.pose)
    turn = abs((theta + math.pi) % (2.0 * math.pi) - math.pi)
    return max(float(math.hypot(x, y)) / size, turn)


def questions(number: int, seed: int) -> list[Question]:
    """So many random questions."""
    rng = np.random.default_rng(seed)
    return [_question(rng) for _ in range(number)]


def before_a_wall(question: Question, rng: np.random.Generator) -> Question:
    """The question with a wall, no nearer than the open fingers reach; in two of three the object rests on it."""
    hand = question.hand
    reach = float(links_at_start(hand)[:, [1, 3]].max()) + question.half_thickness
    top = _top(question)
    wall = max(reach, top) + float(rng.uniform(0.0, 0.5))
    x, y, theta = question.start
    moved = replace(question, wall=wall, start=(x, y + wall - top, theta)) if rng.random() < 2.0 / 3.0 else question
    return replace(moved, wall=wall) if clearance(question, moved.start) > 1e-3 else replace(question, wall=wall)


def _top(question: Question) -> float:
    if not question.vertices:
        return question.start[1] + question.radius
    return float(placed(np.array(question.vertices), np.array(question.start))[:, 1].max())


def _question(rng: np.random.Generator) -> Question:
    count = int(rng.choice([1, 2, 3], p=[0.5, 0.3, 0.2]))
    links = rng.uniform(0.5, 1.5, count)
    bent = count > 1 and rng.random() < 0.6
    rest = count - 1
    outline = _outline(rng) if rng.random() < 0.6 else np.zeros((0, 2))
    question = Question(
        half_palm=float(np.exp(rng.uniform(math.log(0.2), math.log(1.3)))),
        links=tuple((links / links.sum()).tolist()),
        half_thickness=float(rng.choice([0.0, rng.uniform(0.01, 0.08)])),
        crossing=bool(rng.random() < 0.7),
        first=float(rng.choice([0.0, rng.uniform(0.0, 1.0)])),
        offsets=tuple(rng.uniform(-0.2, 0.6, rest).tolist()) if bent else (0.0,) * rest,
        ratios=tuple((rng.random() < 0.6) * rng.uniform(0.0, 0.8, rest)) if bent else (0.0,) * rest,
        radius=float(rng.uniform(0.08, 0.4)) if not len(outline) else 0.0,
        vertices=tuple((float(x), float(y)) for x, y in outline),
        friction=float(rng.choice([0.0, rng.uniform(0.02, 1.0)], p=[0.3, 0.7])),
        start=(0.0, 0.0, 0.0),
    )
    return replace(question, start=_start(rng, question))


def _outline(rng: np.random.Generator) -> np.ndarray:
    """A convex polygon of 3 to 7 corners about its area centroid, counter-clockwise."""
    count = int(rng.integers(3, 8))
    while True:
        angles = np.sort(rng.uniform(0.0, 2.0 * math.pi, count))
        gaps = np.diff(angles, append=angles[0] + 2.0 * math.pi)
        if gaps.min() > 0.3 and gaps.max() < 2.8:
            break
    points = rng.uniform(0.1, 0.4) * np.stack([np.cos(angles), rng.uniform(0.4, 1.0) * np.sin(angles)], axis=1)
    centroid = Polygon(points).centroid
    return points - (centroid.x, centroid.y)


def _start(rng: np.random.Generator, question: Question) -> tuple[float, float, float]:
    """Anywhere in reach and clear of the open hand; one in six just touching it, one in twenty overlapping it."""
    reach, kind = question.half_palm + 0.9, rng.random()
    while True:
        x, theta = rng.uniform(-reach, reach), rng.uniform(0.0, 2.0 * math.pi)
        y = rng.uniform(0.0, 1.1)
        clear = clearance(question, (x, y, theta))
        if kind < 1.0 / 20.0:
            if clear < (-1e-3 if not question.vertices or question.half_thickness else 1e-12):
                return x, y, theta
        elif clear > 1e-3:
            return (x, y, theta) if kind > 0.05 + 1.0 / 6.0 else (x, _lowered(question, x, y, theta), theta)


def clearance(question: Question, pose: tuple[float, float, float]) -> float:
    """Distance of the object from the open hand; negative, and not exact, where they overlap."""
    hand = question.hand
    shape = Polygon(placed(np.array(question.vertices), np.array(pose))) if question.vertices else Point(pose[:2])
    halves = np.r_[0.0, np.full(2 * len(question.links), question.half_thickness)]
    return min(
        shape.distance(LineString(segment.reshape(2, 2))) - half - question.radius
        for segment, half in zip(links_at_start(hand), halves, strict=True)
    )


def _lowered(question: Question, x: float, y: float, theta: float) -> float:
    """The height to which it can be moved down until it touches, or as far as the palm's line."""
    low, high = y, y
    while clearance(question, (x, low, theta)) > 0.0 and low > -1.0:
        high, low = low, low - 0.02
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if clearance(question, (x, middle, theta)) > 0.0 else (middle, high)
    return high
