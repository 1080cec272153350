"""Plans put to the test: every leaf from many starts, for hands, layouts and uncertainties three times the closing region.

    python3 dev.py validate plans [STARTS_PER_LEAF] [SEED]

Touches by sphere tracing, grasps by the stepping kernel: no geometry shared with the planner. Corners and edge of the
uncertainty are among the starts; pose errors and displacements are as long as allowed in half of the draws. Where the
search finds no plan, strips are tried. Then policies of other kinds, and the assumptions dropped one at a time.

Every row is kept in build/ as it is done, for these sources, and not computed again when the hunt is started anew.
"""

from __future__ import annotations

import hashlib
import json
import sys
import time
from collections.abc import Callable
from math import pi, radians, sqrt
from pathlib import Path

import shapely
from shapely import Point, affinity, box
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.planner import Planner
from palmar.behaviours.policy import Policy, approaches, is_guaranteed
from palmar.behaviours.recentring import recentring
from palmar.behaviours.search import Found, fewest_approaches
from palmar.behaviours.superposed import closings_only, strips
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.sensors import SensorLayout, Sensors, Stretch
from palmar.studies.leaf_trial import try_leaves
from palmar.studies.plan import planner_of
from palmar.studies.plan_trial import Errors, drawn_starts, try_plan, without_assumptions

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ("behaviours", "geometry", "mechanics", "models", "regions", "worlds/planar", "studies")
MOST = 3
Row = list[str]
HANDS = {
    "test bed": (Hand(palm_width=0.12, finger_links=(0.137, 0.107)), 0.038, 0.7),
    "thick": (Hand(palm_width=0.12, finger_links=(0.137, 0.107), finger_thickness=0.025), 0.045, 0.3),
    "wide palm": (Hand(palm_width=0.3, finger_links=(0.12, 0.08), finger_thickness=0.01), 0.045, 0.5),
    "small": (Hand(palm_width=0.06, finger_links=(0.1,), finger_thickness=0.012), 0.018, 0.0),
    "chapter 3": (Hand(palm_width=2.0, finger_links=(2.0,)), 0.5, 0.7),
}
PARTS = ("palm", "tips", "distributed", "full", "one bit a link")


def layout(name: str, hand: Hand) -> SensorLayout | tuple[Stretch, ...]:
    """Four presets, and one sensor on every link and the palm."""
    if name != "one bit a link":
        return SensorLayout(name)
    links = [f"{side}_{k + 1}" for side in ("right", "left") for k in range(len(hand.finger_links))]
    return tuple(Stretch(body=each) for each in ("palm", *links))


def uncertainties(hand: Hand, area: float) -> dict[str, BaseGeometry]:
    """Three times the closing region: round, and as deep as a belief that only a palm can feel must be narrow."""
    width = 0.7 * hand.palm_width
    deep = box(-0.5 * width, 0.0, 0.5 * width, 3.0 * area / width)
    return {"disk": Point(0.0, 0.0).buffer(sqrt(3.0 * area / pi)), "deep box": deep}


def case_of(hand: Hand, radius: float, friction: float, name: str) -> Case:
    """With pose errors and displacements of a hundredth of the finger."""
    small = 0.01 * hand.finger_length
    sensors = Sensors(layout=layout(name, hand), displacement=small, pose_error=0.5 * small)
    return Case(hand=hand, object=Disk(radius=radius), contact=Contact(friction=friction), sensors=sensors)


class Kept:
    """Rows done before, by name, in a file that belongs to these sources, this number of starts and this seed."""

    def __init__(self, per_leaf: int, seed: int) -> None:
        files = [
            Path(__file__),
            *(each for part in SOURCES for each in sorted((ROOT / "src/palmar" / part).rglob("*.py"))),
        ]
        print_of = hashlib.sha256(b"".join(each.read_bytes() for each in files)).hexdigest()[:12]
        self.file = ROOT / "build" / f"plans-{per_leaf}-{seed}-{print_of}.jsonl"
        self.file.parent.mkdir(exist_ok=True)
        lines = self.file.read_text().splitlines() if self.file.exists() else []
        self.rows: dict[str, Row] = dict(json.loads(each) for each in lines)
        self.begin = time.process_time()

    def row(self, name: str, make: Callable[[], Row]) -> Row:
        """A row, from the file or made now; printed, with progress on stderr."""
        if name not in self.rows:
            self.rows[name] = make()
            with self.file.open("a") as file:
                file.write(json.dumps([name, self.rows[name]]) + "\n")
        spent = (time.process_time() - self.begin) / 60.0
        print(f"{len(self.rows)} rows, {spent:.1f} min of processor time: {name}", file=sys.stderr, flush=True)
        print("| " + " | ".join(self.rows[name]) + " |", flush=True)
        return self.rows[name]


def heading(*names: str) -> None:
    """Of a table."""
    print("\n| " + " | ".join(names) + " |\n" + "|---" * len(names) + "|")


def tried(
    case: Case, policy: Policy, stretches: tuple[Stretch, ...], belief: BaseGeometry, per_leaf: int, seed: int
) -> Row:
    """Leaves, starts, the fewest at a leaf, the most approaches taken, and what was lost."""
    errors = Errors(case.sensors.displacement, case.sensors.pose_error)
    trial = try_leaves(case, policy, stretches, belief, errors, per_leaf, seed)
    number, lost = len(trial.of_leaves), trial.starts - trial.caught
    return [str(each) for each in (number, trial.starts, min(trial.of_leaves), trial.most_approaches, lost)]


def planned(hand_name: str, name: str, shape: str, per_leaf: int, seed: int) -> Row:
    """The row of one hand, layout and uncertainty."""
    hand, radius, friction = HANDS[hand_name]
    case = case_of(hand, radius, friction, name)
    planner, stretches = planner_of(case)
    belief = before(uncertainties(hand, largest(planner))[shape], hand)
    begin = time.process_time()
    found = fewest_approaches(planner, belief, MOST)
    seconds = time.process_time() - begin
    sure, how = is_guaranteed(found.policy), "search"
    least = f"none in {MOST}" if found.least > MOST else str(found.least)
    ruled = recentring(planner, belief, MOST)
    policy = found.policy
    if not sure:
        how, policy = "strips", strips(planner, belief, 2).policy
    certain = is_guaranteed(policy)
    row = [hand_name, name, shape, how if certain else "none", str(approaches(policy)) if certain else "-", least,
           str(approaches(ruled)) if is_guaranteed(ruled) else "none"]  # fmt: skip
    row += tried(case, policy, stretches, belief, per_leaf, seed) if certain else ["-"] * 5
    return [*row, f"{seconds:.2f}"]


def largest(planner: Planner) -> float:
    """Area (m^2) of the largest closing region."""
    return max(each.target.region.area for each in planner.openings)


def before(uncertainty: BaseGeometry, hand: Hand) -> BaseGeometry:
    """The uncertainty two finger lengths before the palm."""
    return affinity.translate(uncertainty, 0.0, 2.0 * hand.finger_length - uncertainty.bounds[1])


def other_policies() -> dict[
    str, tuple[str, BaseGeometry, tuple[float, ...], Callable[[Planner, BaseGeometry], Found]]
]:
    """Layout, uncertainty, directions and planner of policies that are no plain search, for the test bed."""

    def search(planner: Planner, belief: BaseGeometry) -> Found:
        return fewest_approaches(planner, belief, MOST)

    def in_strips(planner: Planner, belief: BaseGeometry) -> Found:
        return strips(planner, belief, 2)

    two = shapely.union_all([box(-0.045, 0.5, 0.045, 0.6), box(0.15, 1.1, 0.25, 1.2)])
    islands = shapely.union_all([Point(x, y).buffer(0.05) for x, y in ((0, 0.7), (0.9, 0.7), (-1.3, 1.7), (0, 1.7))])
    ahead, around = (0.0,), (0.0, radians(90.0))
    return {
        "an approach that stops before a finger would touch": ("palm", two, ahead, search),
        "the hand turned by 90 degrees": ("tips", box(-0.5, 0.7, 0.5, 0.8), around, search),
        "the same, more sensors": ("distributed", box(-0.6, 0.7, 0.6, 0.9), around, search),
        "strips over 2 m by 1.2 m": ("distributed", box(-1.0, 0.7, 1.0, 1.9), ahead, in_strips),
        "the same, tips only": ("tips", box(-1.0, 0.7, 1.0, 1.9), ahead, in_strips),
        "closings at four islands": ("palm", islands, ahead, closings_only),
    }


def other(name: str, per_leaf: int, seed: int) -> Row:
    """The row of one of these."""
    layout_name, belief, directions, planned_by = other_policies()[name]
    case = case_of(*HANDS["test bed"], layout_name)
    planner, stretches = planner_of(case, directions=directions)
    found = planned_by(planner, belief)
    certain = is_guaranteed(found.policy)
    row = [name, layout_name, str(approaches(found.policy)) if certain else "none", str(found.least)]
    return [*row, *(tried(case, found.policy, stretches, belief, per_leaf, seed) if certain else ["-"] * 5)]


def assumption(name: str, seed: int) -> Row:
    """What is left of a plan for the test bed, distributed sensors and the disk, without one of its assumptions."""
    hand, radius, friction = HANDS["test bed"]
    case = case_of(hand, radius, friction, "distributed")
    planner, stretches = planner_of(case)
    belief = before(uncertainties(hand, largest(planner))["disk"], hand)
    errors = without_assumptions(Errors(case.sensors.displacement, case.sensors.pose_error))[name]
    policy = fewest_approaches(planner, belief, MOST).policy
    trial = try_plan(case, policy, stretches, drawn_starts(belief, 100_000, seed), errors, seed)
    return [name, str(trial.caught), str(trial.lost), str(trial.surprised)]


def main(per_leaf: int = 100_000, seed: int = 20261126) -> None:
    """Print a row a plan, then the other policies, then what each assumption was worth."""
    kept, rows = Kept(per_leaf, seed), []
    counts = ("leaves", "starts", "least a leaf", "approaches taken", "lost")
    heading("hand", "sensors", "uncertainty", "plan", "approaches", "proved least", "re-centring", *counts, "search, s")
    for hand in HANDS:
        for name in PARTS:
            for shape in ("disk", "deep box"):
                make = lambda h=hand, n=name, s=shape: planned(h, n, s, per_leaf, seed)  # noqa: E731
                rows.append(kept.row(f"{hand}, {name}, {shape}", make)[8:12])
    heading("policy", "sensors", "approaches", "proved least", *counts)
    for name in other_policies():
        rows.append(kept.row(name, lambda n=name: other(n, per_leaf, seed))[5:9])
    print(f"\n{sum(int(each[0]) for each in rows if each[0] != '-')} starts, ", end="")
    print(f"{sum(int(each[3]) for each in rows if each[3] != '-')} lost")
    heading("what happens", "caught", "lost", "touched where the plan knows nothing")
    for name in without_assumptions(Errors()):
        kept.row(name, lambda n=name: assumption(n, seed))


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:]))
