"""What a film of one closing motion shows, without regard to its format: poses over time, contacts, events in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, degrees, floor, log, log10

import numpy as np
from numpy.typing import NDArray

from palmar.faces.plots.film_contacts import contacts
from palmar.faces.plots.hand import WALL_ROOM, finger_points
from palmar.faces.plots.sheet import MM, Extent
from palmar.geometry.polygon import area_centroid
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.studies.simulate import Simulation, film
from palmar.worlds.planar.table import Trace

Floats = NDArray[np.float64]
Place = tuple[float, float]
Fingers = tuple[tuple[float, ...], tuple[float, ...]]

FRAMES = 241
"""Poses over the whole closing motion, a motion that ends earlier has fewer."""
SHORTEST, LONGEST, MIDDLE = 3.0, 10.0, 6.0
"""A motion that takes between the first two (s) is shown in real time, any other in about the third."""

VERDICTS = {
    Outcome.STRUCTURAL: "Caught: held without friction",
    Outcome.FRICTIONAL: "Caught: held by friction",
    Outcome.CAGED: "Caught: enclosed with play",
    Outcome.ESCAPED: "Not caught: touched, then left",
    Outcome.MISSED: "Not caught: never touched",
    Outcome.JAMMED: "Not caught: the fingers stall on it without a hold",
    Outcome.INVALID: "No start: it overlaps the open hand",
    Outcome.UNDECIDED: "Undecided: the bound on events was reached",
}
_DONE = {
    "touch": "touches",
    "leave": "leaves",
    "stall": "stalls",
    "stick": "sticks",
    "slide": "slides",
    "halt": "halts",
    "impact": "strikes",
    "shut": "shuts about it",
}


@dataclass(frozen=True)
class Scene:
    """One motion: times (K,) s, poses (K, 3) in m and rad, joint angles in rad: right finger's, then left's.

    Of fingers that stay straight they are base angles (K, 2), else those of all joints (K, 2 links).

    ``contacts`` holds for every pose the points (m) where the hand touches; ``events`` times (s) and words; ``pace``
    the seconds of the motion that one second of the film shows.
    """

    case: Case
    outcome: Outcome
    times: Floats
    poses: Floats
    fingers: Floats
    contacts: tuple[tuple[Place, ...], ...]
    events: tuple[tuple[float, str], ...]
    pace: float

    @property
    def duration(self) -> float:
        """Length of the motion (s)."""
        return float(self.times[-1])

    @property
    def place_name(self) -> str:
        """What the poses' x and y are of."""
        return "centre" if isinstance(self.case.object, Disk) else "origin of the outline"

    @property
    def mark(self) -> tuple[Place, float]:
        """Where a line along the object's x axis that shows its turn begins (m, in its frame), and its length (m)."""
        item = self.case.object
        if isinstance(item, Disk):
            return (0.0, 0.0), item.radius
        middle, corners = area_centroid(item.vertices), np.array(item.vertices)
        away, along = corners - middle, np.roll(corners, -1, axis=0) - corners
        heights = np.abs(away[:, 0] * along[:, 1] - away[:, 1] * along[:, 0]) / np.hypot(*along.T)
        return middle, 0.8 * float(heights.min())

    def index(self, time: float) -> int:
        """The last pose that is not later than ``time`` (s)."""
        return int(np.searchsorted(self.times, time, side="right")) - 1

    def at(self, time: float) -> tuple[tuple[float, float, float], Fingers]:
        """Pose (m, m, rad) and joint angles right and left (rad) at any time (s), linear between the poses."""
        x, y, turn, *joints = (
            float(np.interp(time, self.times, column)) for column in (*self.poses.T, *self.fingers.T)
        )
        return (x, y, turn), split(joints)

    @property
    def doing(self) -> str:
        """What the hand does, for a heading."""
        does = self.case.behaviour
        if does.name is BehaviourName.CURL_AND_CLOSE:
            return f"Curling by {degrees(does.preshape):.3g}°, then closing"
        return "Closing both joints" if does.name is BehaviourName.CLOSE_COUPLED else "Closing"

    @property
    def bodies(self) -> tuple[float, ...]:
        """Lengths (m) of a finger's parts that turn each by itself: all links, or the straight finger."""
        links = self.case.hand.finger_links
        return links if self.fingers.shape[1] == 2 * len(links) else (self.case.hand.finger_length,)

    @property
    def verdict(self) -> str:
        """The outcome in words, with where the object ends."""
        if self.outcome is Outcome.INVALID:
            return VERDICTS[self.outcome]
        x, y, turn = self.poses[-1]
        return f"{VERDICTS[self.outcome]}; it ends at {place_words(x, y)}, turned {angle_words(turn)}"

    @property
    def pace_words(self) -> str:
        """How the film's time relates to the motion's."""
        if self.pace == 1.0:
            return "shown in real time"
        return f"shown {self.pace:g} times faster" if self.pace > 1.0 else f"shown {1.0 / self.pace:g} times slower"

    @property
    def extent(self) -> Extent:
        """A rectangle (m) that holds hand and object throughout."""
        case, size = self.case, _size(self.case)
        hand = case.hand
        low, high = self.poses[:, :2].min(axis=0) - size, self.poses[:, :2].max(axis=0) + size
        points = np.concatenate([finger_points(hand, side) for row in self.fingers.tolist() for side in split(row)])
        points = np.abs(points) + hand.half_thickness
        side, top = points.max(axis=0)
        bottom = min(self.palm_at(time) for time in self.times) - hand.half_thickness
        if case.support.wall is not None:
            top = (1.0 + WALL_ROOM) * case.support.wall - WALL_ROOM * bottom
        return Extent(min(-side, low[0]), min(bottom, low[1]), max(side, high[0]), max(top, high[1]))

    def palm_at(self, time: float) -> float:
        """Height (m) of the palm, 0 unless a wall keeps the hand back."""
        right, left = self.at(time)[1]
        return self.case.palm_ahead(right, left)


def split(joints: Sequence[float]) -> Fingers:
    """Joint angles of the right finger and of the left, from both in one row."""
    half = len(joints) // 2
    return tuple(joints[:half]), tuple(joints[half:])


def scene(case: Case, start: tuple[float, ...], result: Simulation, whole: Trace | None = None) -> Scene:
    """The motion from ``start`` (x, y, theta[, vx, vy]) that ``result`` describes, from time 0 to its last event.

    ``whole``: its poses, where it was not carried out by the planar kernels.
    """
    first, rate = case.hand.open, case.hand.finger_rate
    end = result.events[-1][1].psi if result.events else first
    times, poses, fingers = np.array([0.0]), np.array([result.pose]), np.array([[*result.right, *result.left]])
    if result.outcome is not Outcome.INVALID:
        whole = whole or film(case, start, FRAMES)
        kept = whole.psi < end - 1e-9
        poses = np.vstack((whole.poses[kept], result.pose))
        count = whole.fingers.shape[1] // 2
        fingers = np.vstack((whole.fingers[kept], (*result.right[:count], *result.left[:count])))
        times = np.append(whole.psi[kept], end) - first
    return Scene(
        case, result.outcome, times / rate, poses, fingers, contacts(case, times + first, poses, fingers, result),
        tuple((time, _words(event.kind, event.body)) for time, event in result.events), pace_of((end - first) / rate),
    )  # fmt: skip


def ticks(low: float, high: float, extent: Extent) -> list[float]:
    """Round numbers of mm between two lengths (m), at a distance that suits the whole extent in both directions."""
    rough = MM * max(extent.size) / 10.0
    unit = 10.0 ** floor(log10(rough))
    step = next(each for each in (1.0, 2.0, 5.0, 10.0) if each * unit >= rough) * unit
    numbers = np.arange(ceil(MM * low / step - 1e-9), floor(MM * high / step + 1e-9) + 1)
    return [float(each) for each in numbers * step]


def place_words(x: float, y: float) -> str:
    """A place (m) in mm."""
    return f"({_fixed(1e3 * x)}, {_fixed(1e3 * y)}) mm"


def angle_words(turn: float) -> str:
    """An angle (rad) in degrees."""
    return f"{_fixed(degrees(turn))}°"


def _fixed(value: float) -> str:
    return f"{round(value, 1) + 0.0:.1f}".replace("-", "\N{MINUS SIGN}")


def _words(kind: str, body: str) -> str:
    if kind == "end":
        return VERDICTS[Outcome(body)]
    return f"{body.replace('_', ' ')} {_DONE.get(kind, kind)}"


def _size(case: Case) -> float:
    """Distance (m) of the object's farthest point from its frame's origin."""
    item = case.object
    return item.radius if isinstance(item, Disk) else float(np.linalg.norm(item.vertices, axis=1).max())


def pace_of(duration: float) -> float:
    """1 for motions of a length that is good to watch, else the nearest of 1, 2, 5, 10 ... and their inverses."""
    if duration == 0.0 or SHORTEST <= duration <= LONGEST:
        return 1.0
    rounds = [base * 10.0**power for power in range(10) for base in (1.0, 2.0, 5.0)]
    nice = [*rounds, *(1.0 / each for each in rounds)]
    return min(nice, key=lambda each: abs(log(each) + log(MIDDLE) - log(duration)))
