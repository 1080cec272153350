"""Plans put to the test: every leaf from many starts, for hands, layouts and uncertainties three times the closing region.

    python3 dev.py validate plans [STARTS_PER_LEAF] [SEED]      (at least 100 000 a plan)

Touches by sphere tracing, grasps by the stepping kernel: no geometry shared with the planner. Corners and edge of the
uncertainty are among the starts; pose errors and displacements are as long as allowed in half of the draws. The fewest
approaches are compared with a search on a grid four times as fine. Then the assumptions are dropped one at a time.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from math import pi, sqrt

from shapely import Point, affinity, box
from shapely.geometry.base import BaseGeometry

from palmar.behaviours.policy import Close, approaches, is_guaranteed, leaves
from palmar.behaviours.recentring import recentring
from palmar.behaviours.search import OFFSETS, Planner
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.sensors import SensorLayout, Sensors, Stretch
from palmar.studies.plan import planner_of
from palmar.studies.plan_trial import Errors, drawn_starts, try_plan, without_assumptions

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


def fewest(planner: Planner, belief: BaseGeometry, most: int) -> str:
    """Fewest approaches on a grid four times as fine: a number, or what is known."""
    finer = replace(planner, offsets=4 * OFFSETS, most_sweeps=3000).plan(belief, most)
    if is_guaranteed(finer.policy):
        return f"{approaches(finer.policy)}{'' if finer.minimal else '?'}"
    return "none" if finer.minimal else "none found"


def ruled(planner: Planner, belief: BaseGeometry, most: int) -> str:
    """Approaches by the source's rule, under the middle of what is known."""
    policy = recentring(planner, belief, most)
    return str(approaches(policy)) if is_guaranteed(policy) else "none"


def main(per_leaf: int = 100_000, seed: int = 20261126) -> None:
    """Print a row a plan, then what each assumption was worth."""
    heads = (
        "hand",
        "sensors",
        "uncertainty",
        "certain",
        "approaches",
        "finer grid",
        "re-centring",
        "leaves",
        "starts",
        "least a leaf",
    )
    print("| " + " | ".join((*heads, "lost", "plan, s")) + " |")
    print("|---" * 12 + "|")
    total = lost = 0
    for hand_name, (hand, radius, friction) in HANDS.items():
        for name in PARTS:
            case = case_of(hand, radius, friction, name)
            planner, stretches = planner_of(case)
            area = max(each.target.region.area for each in planner.openings)
            for shape, uncertainty in uncertainties(hand, area).items():
                belief = _before(uncertainty, hand)
                begin = time.perf_counter()
                found = planner.plan(belief, 3)
                seconds = time.perf_counter() - begin
                sure = is_guaranteed(found.policy)
                ends = [each for each in leaves(found.policy) if isinstance(each, Close)]
                row = [hand_name, name, shape, "yes" if sure else "no", str(approaches(found.policy)) if sure else "-",
                       fewest(planner, belief, 3), ruled(planner, belief, 3), str(len(ends))]  # fmt: skip
                if sure:
                    starts = drawn_starts(belief, max(100_000, per_leaf * len(ends)), seed)
                    errors = Errors(case.sensors.displacement, case.sensors.pose_error)
                    trial = try_plan(case, found.policy, stretches, starts, errors, seed)
                    total, lost = total + trial.starts, lost + trial.starts - trial.caught
                    row += [str(trial.starts), str(min(trial.of_leaves)), str(trial.starts - trial.caught)]
                else:
                    row += ["-", "-", "-"]
                print("| " + " | ".join([*row, f"{seconds:.2f}"]) + " |", flush=True)
    print(f"\n{total} starts, {lost} lost")
    _assumptions(seed)


def _before(uncertainty: BaseGeometry, hand: Hand) -> BaseGeometry:
    """The uncertainty two finger lengths before the palm."""
    return affinity.translate(uncertainty, 0.0, 2.0 * hand.finger_length - uncertainty.bounds[1])


def _assumptions(seed: int) -> None:
    hand, radius, friction = HANDS["test bed"]
    case = case_of(hand, radius, friction, "distributed")
    planner, stretches = planner_of(case)
    area = max(each.target.region.area for each in planner.openings)
    belief = _before(uncertainties(hand, area)["disk"], hand)
    found = planner.plan(belief, 3)
    starts = drawn_starts(belief, 100_000, seed)
    print("\ntest bed, distributed, disk; 100000 starts\n")
    print("| what happens | caught | lost | touched where the plan knows nothing |\n|---|---|---|---|")
    assumed = Errors(case.sensors.displacement, case.sensors.pose_error)
    for name, errors in without_assumptions(assumed).items():
        trial = try_plan(case, found.policy, stretches, starts, errors, seed)
        print(f"| {name} | {trial.caught} | {trial.lost} | {trial.surprised} |", flush=True)


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:]))
