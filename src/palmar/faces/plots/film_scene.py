"""What a film of one closing motion shows, without regard to its format: poses over time, contacts, events in words."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, degrees, floor, log, log10

import numpy as np
from numpy.typing import NDArray

from palmar.faces.plots.hand import finger_points
from palmar.faces.plots.sheet import MM, Extent
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.studies.simulate import Simulation, film

Floats = NDArray[np.float64]

FRAMES = 241
"""Poses over the whole closing motion, a motion that ends earlier has fewer."""
SHORTEST, LONGEST, MIDDLE = 3.0, 10.0, 6.0
"""A motion that takes between the first two (s) is shown in real time, any other in about the third."""
SIDES = {"right": 1.0, "left": -1.0}

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
_DONE = {"touch": "touches", "leave": "leaves", "stall": "stalls"}


@dataclass(frozen=True)
class Scene:
    """One motion: times (K,) s, poses (K, 3) in m and rad, base angles (K, 2) right and left in rad.

    ``contacts`` holds for every pose the points (m) where the hand touches; ``events`` times (s) and words; ``pace``
    the seconds of the motion that one second of the film shows.
    """

    case: Case
    outcome: Outcome
    times: Floats
    poses: Floats
    fingers: Floats
    contacts: tuple[tuple[tuple[float, float], ...], ...]
    events: tuple[tuple[float, str], ...]
    pace: float

    @property
    def duration(self) -> float:
        """Length of the motion (s)."""
        return float(self.times[-1])

    @property
    def mark(self) -> float:
        """Length (m) of a line from the object's origin that shows its turn."""
        item = self.case.object
        return item.radius if isinstance(item, Disk) else 0.6 * float(np.linalg.norm(item.vertices, axis=1).min())

    def index(self, time: float) -> int:
        """The last pose that is not later than ``time`` (s)."""
        return int(np.searchsorted(self.times, time, side="right")) - 1

    def at(self, time: float) -> tuple[tuple[float, float, float], tuple[float, float]]:
        """Pose (m, m, rad) and base angles right and left (rad) at any time (s), linear between the poses."""
        x, y, turn, right, left = (
            float(np.interp(time, self.times, column)) for column in (*self.poses.T, *self.fingers.T)
        )
        return (x, y, turn), (right, left)

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
        points = np.concatenate([finger_points(hand, (psi,)) for psi in self.fingers.ravel()])
        points = np.abs(points) + hand.half_thickness
        side, top = points.max(axis=0)
        return Extent(min(-side, low[0]), min(-hand.half_thickness, low[1]), max(side, high[0]), max(top, high[1]))


def scene(case: Case, start: tuple[float, float], result: Simulation) -> Scene:
    """The motion from ``start`` (m) that ``result`` describes, from time 0 to its last event."""
    world, whole = film(case, start, FRAMES)
    first, rate = world.hand.first, case.hand.finger_rate
    end = result.events[-1][1].psi if result.events else first
    kept = whole.psi < end - 1e-9
    theta = result.pose[2] - float(whole.poses[-1, 2])
    poses = np.vstack((whole.poses[kept] + (0.0, 0.0, theta), result.pose))
    fingers = np.vstack((whole.fingers[kept], (result.right[0], result.left[0])))
    if result.outcome is Outcome.INVALID:
        fingers[:] = first
    times = np.append(whole.psi[kept], end) - first
    return Scene(
        case, result.outcome, times / rate, poses, fingers, _contacts(case, times + first, poses, fingers, result),
        tuple((time, _words(event.kind, event.body)) for time, event in result.events), _pace((end - first) / rate),
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


def _pace(duration: float) -> float:
    """1 for motions of a length that is good to watch, else the nearest of 1, 2, 5, 10 ... and their inverses."""
    if duration == 0.0 or SHORTEST <= duration <= LONGEST:
        return 1.0
    rounds = [base * 10.0**power for power in range(10) for base in (1.0, 2.0, 5.0)]
    nice = [*rounds, *(1.0 / each for each in rounds)]
    return min(nice, key=lambda each: abs(log(each * MIDDLE / duration)))


def _contacts(
    case: Case, psi: Floats, poses: Floats, fingers: Floats, result: Simulation
) -> tuple[tuple[tuple[float, float], ...], ...]:
    """Where the hand touches a disk at each pose: the events say which parts do, geometry says where."""
    found: list[list[tuple[float, float]]] = [[] for _ in psi]
    bodies = dict.fromkeys(event.body for _, event in result.events if event.kind == "touch")
    for body in bodies if isinstance(case.object, Disk) else ():
        for k in np.flatnonzero(_touching(body, psi, result)):
            found[k].append(_foot(case, body, poses[k], fingers[k]))
    return tuple(tuple(each) for each in found)


def _touching(body: str, psi: Floats, result: Simulation) -> NDArray[np.bool_]:
    flags = np.zeros(len(psi), dtype=np.bool_)
    for _, event in result.events:
        if event.body == body and event.kind in ("touch", "leave"):
            flags[psi >= event.psi - 1e-6] = event.kind == "touch"
    return flags


def _foot(case: Case, body: str, pose: Floats, fingers: Floats) -> tuple[float, float]:
    """The point of the hand's surface nearest to the disk's centre."""
    hand, (x, y) = case.hand, pose[:2]
    name, _, part = body.partition("_")
    if name not in SIDES:
        return float(np.clip(x, -hand.half_palm, hand.half_palm)), 0.0
    base, *_, tip = finger_points(hand, (fingers[0 if name == "right" else 1],), left=name == "left")
    along = 1.0 if part == "tip" else float(np.clip((pose[:2] - base) @ (tip - base) / hand.finger_length**2, 0.0, 1.0))
    joint = base + along * (tip - base)
    apart = np.hypot(x - joint[0], y - joint[1])
    share = hand.half_thickness / apart if apart > 0.0 else 0.0
    return float(joint[0] + share * (x - joint[0])), float(joint[1] + share * (y - joint[1]))
