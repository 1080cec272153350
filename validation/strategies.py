"""Closing strategies of the test bed's hand side by side, and random starts in and about each of their regions.

    python3 dev.py validate strategies [WORD...] [STARTS [SEED]]

The hand of chapter 6 (half palm 60, links 137 and 107, disk 38 mm) on a table and in free space, with lines and with thick
fingers of one plane: the areas of all strategies, and of STARTS (100 000) random starts inside each region how many are
lost, and of as many outside, within a disk's radius, how many are caught. RUNS starts inside each are run by the behaviour's
reflex under feedback too.

    python3 dev.py validate strategies disc [WORD...] [STARTS [SEED]]

The source's pre-image of curling and closing on a table (section 5.2), a disc about each base joint, beside the true region.
"""

from __future__ import annotations

import sys
import time

import numpy as np
import shapely
from numpy.typing import NDArray

from palmar.geometry.planar_set import areal, uniform_places
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of, impact_law_of
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import SupportKind
from palmar.regions.build import build_region
from palmar.regions.jointed_closing import Carried
from palmar.studies.preshape import preshapes
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.studies.simulate import simulate_starts
from palmar.studies.strategies import strategies

Floats = NDArray[np.float64]
HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\n"
THICK = HAND + 'finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK = "[object]\nradius_mm = 38\n"
FREE = '[support]\nkind = "free"\n'
CASES = {
    "table, line fingers, friction 0.7": HAND + DISK + "[contact]\nfriction = 0.7\n",
    "table, thick fingers of one plane, friction 0.7": THICK + DISK + "[contact]\nfriction = 0.7\n",
    "free, line fingers, restitution 1": HAND + DISK + "[contact]\nfriction = 0\n" + FREE,
    "free, line fingers, restitution 0.5": HAND + DISK + "[contact]\nfriction = 0\nrestitution = 0.5\n" + FREE,
    "free, thick fingers of one plane, restitution 1": THICK + DISK + "[contact]\nfriction = 0\n" + FREE,
}
RUNS = 20


def caught(case: Case, starts: Floats) -> NDArray[np.bool_]:
    """Which starts (N, 2) end in a grasp."""
    if case.support.kind is SupportKind.FREE:
        given = capture_hand_of(case), starts, case.start.velocity, case.contact.restitution
        codes = capture_all(*given, law=impact_law_of(case)).codes
    elif case.behaviour.name is BehaviourName.CLOSE:
        codes = simulate_starts(case, starts).codes
    else:
        codes = Carried(case).outcomes(np.column_stack([starts, np.zeros(len(starts))]))
    return codes <= Outcome.CAGED.code


def lost_under_feedback(case: Case, starts: Floats) -> int:
    """How many of the starts the behaviour's reflex does not catch."""
    runs = [run_behaviour(case, (float(x), float(y), 0.0), Circumstances(tick=0.05)) for x, y in starts]
    return sum(not each.trace.outcome.caught for each in runs)


def compare(name: str, count: int, seed: int) -> None:
    """One case: its strategies, one line each."""
    case, rng = parse_case(CASES[name], name), np.random.default_rng(seed)
    begin = time.process_time()
    found = strategies(case)
    print(f"{name} ({time.process_time() - begin:.1f} s of processor time)", flush=True)
    straight = found[0].region.area
    assert isinstance(case.object, Disk)
    radius = case.object.radius
    for each in found:
        there = case.model_copy(update={"behaviour": each.behaviour})
        outer = each.region.centre if each.region.outer is None else each.region.outer
        open_hand = shapely.box(-1.0, radius + case.hand.half_thickness + 1e-9, 1.0, 1.0)
        outside = outer.buffer(radius).difference(outer).intersection(open_hand)
        lost = int((~caught(there, uniform_places(each.region.centre, count, rng))).sum())
        more = int(caught(there, uniform_places(outside, count, rng)).sum())
        runs = lost_under_feedback(there, uniform_places(each.region.centre, RUNS, rng))
        value = "" if each.value is None else f" {np.degrees(each.value):.2f} deg,"
        if each.behaviour.name is BehaviourName.CLOSE_COUPLED:
            value = f" ratio {each.value:.3g},"
        if each.step is not None and each.spacing is not None:
            value += f" searched to {each.step:.3g} (rad) at {1e3 * each.spacing:.3g} mm,"
        size = f"{1e4 * each.region.area:.1f} cm2 ({100 * each.region.area / straight:.1f} % of straight)"
        hunted = f"of {count} inside {lost} lost, of {count} outside {more} caught"
        print(f"    {each.name}:{value} {size}; {hunted}; {runs} of {RUNS} runs under feedback lost", flush=True)


def disc(name: str, count: int, seed: int) -> None:
    """The source's disc of contacts as one of centres: a finger's inner side touches disks up to ``arm`` from its base."""
    case, rng = parse_case(CASES[name], name), np.random.default_rng(seed)
    tip = preshapes(case).tip
    assert tip is not None and isinstance(case.object, Disk)
    does = Behaviour(name=BehaviourName.CURL_AND_CLOSE, preshape=tip.angle)
    there, w, h = case.model_copy(update={"behaviour": does}), case.hand.half_palm, case.hand.half_thickness
    both = shapely.union_all([shapely.Point(side * w, 0.0).buffer(tip.arm, quad_segs=256) for side in (1.0, -1.0)])
    promised = areal(both.intersection(shapely.box(-1.0, case.object.radius + h, 1.0, 1.0)))
    true = build_region(there).centre
    beyond, missed = promised.difference(true), true.difference(promised)
    lost = int((~caught(there, uniform_places(promised, count, rng))).sum())
    outside, left_out = 100.0 * beyond.area / promised.area, 100.0 * missed.area / true.area
    print(f"{name}, curled by {np.degrees(tip.angle):.2f} deg: true region {1e4 * true.area:.1f} cm2")
    print(
        f"    disc {1e4 * promised.area:.1f} cm2, radius {1e3 * tip.arm:.1f} mm, {outside:.2f} % of it outside the region"
    )
    print(f"    of the region {left_out:.2f} % missed; of {count} starts in the disc {lost} lost", flush=True)


def main(words: list[str]) -> None:
    """Every case with a given word in its name; with the word disc only those on a table."""
    numbers = [int(each) for each in words if each.isdigit()]
    wanted = [each for each in words if not each.isdigit() and each != "disc"]
    count, seed = (*numbers, *(100_000, 20261126)[len(numbers) :])
    for name in CASES:
        if not all(each in name for each in wanted):
            continue
        if "disc" not in words:
            compare(name, count, seed)
        elif name.startswith("table"):
            disc(name, count, seed)


if __name__ == "__main__":
    main(sys.argv[1:])
