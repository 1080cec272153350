"""Soundness of the regions of free disks: random starts inside, carried by the capture kernel at several restitutions.

    python3 dev.py validate free [STARTS [SEED]]

For chapter 4's hand and ten random ones: STARTS (1 000 000) in all for each restitution and model, half of them anywhere
in the region, half within a fiftieth of a finger's length of its boundary. ``exact`` is asked for each restitution by
itself, and as the region that claims every restitution from 0.4 to 1, then also at restitutions drawn from there for each
start; ``corrected`` claims none, and is counted at each. The hands are the same for every seed.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator

import numpy as np
import shapely

from palmar.mechanics.closure.disk_2_2 import structural_radii
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of
from palmar.models.case import Case, Range
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.outcome import Outcome
from palmar.models.support import Support, SupportKind
from palmar.regions.build import build_region
from palmar.regions.region import Model

RESTITUTIONS = (1.0, 0.9, 0.7, 0.4, 0.0)
HANDS_SEED, SEED = 20, 21
CLAIMED = (0.4, 1.0)
HANDS = 11
NEAR = 1.0 / 50.0


def cases(rng: np.random.Generator) -> list[Case]:
    """Chapter 4's hand and random ones whose disk is held without friction, finger 1 m."""
    found = [case_of(6.0 / 24.4, 3.8 / 24.4)]
    while len(found) < HANDS:
        half_palm = float(np.exp(rng.uniform(np.log(0.05), np.log(1.2))))
        radius = float(rng.uniform(0.1, 0.9)) * half_palm
        if structural_radii(half_palm, 1.0).holds(radius):
            found.append(case_of(half_palm, radius))
    return found


def case_of(half_palm: float, radius: float) -> Case:
    """Lengths in units of the finger."""
    hand = Hand(palm_width=2.0 * half_palm, finger_links=(1.0,))
    return Case(
        hand=hand, object=Disk(radius=radius), contact=Contact(friction=0.0), support=Support(kind=SupportKind.FREE)
    )


def starts_in(region: shapely.Geometry, number: int, rng: np.random.Generator) -> np.ndarray:
    """Half of them anywhere, half near the boundary."""
    left, low, right, high = region.bounds
    shapely.prepare(region)
    found: list[np.ndarray] = []
    edge = region.boundary
    while sum(map(len, found)) < number:
        some = np.column_stack([rng.uniform(left, right, number), rng.uniform(low, high, number)])
        along = shapely.line_interpolate_point(edge, rng.uniform(0.0, edge.length, number // 2))
        near = shapely.get_coordinates(along) + rng.uniform(-NEAR, NEAR, (number // 2, 2))
        for points in (
            some[shapely.contains_xy(region, *some.T)][: number // 2],
            near[shapely.contains_xy(region, *near.T)],
        ):
            found.append(points[: number // 2])
    return np.concatenate(found)[:number]


def lost(case: Case, starts: np.ndarray, e: float | np.ndarray) -> np.ndarray:
    """Which starts are not caught."""
    return capture_all(capture_hand_of(case), starts, restitution=e).codes > Outcome.CAGED.code


def asked(case: Case) -> Iterator[tuple[str, str, shapely.Geometry, float | None]]:
    """Name, restitution as told, region, and the restitution; None: drawn from those claimed."""
    low, high = CLAIMED
    ranged = case.model_copy(update={"ranges": (Range(place=("contact", "restitution"), low=low, high=high),)})
    corrected, whole = build_region(case, Model.CORRECTED).centre, build_region(ranged).centre
    name = f"exact, e {low:g} to {high:g}"
    for e in RESTITUTIONS:
        yield "corrected", f"{e:g}", corrected, e
        yield name, f"{e:g}", whole, e
        own = case.model_copy(update={"contact": Contact(friction=0.0, restitution=e)})
        yield "exact, this e", f"{e:g}", build_region(own).centre, e
    yield name, "drawn", whole, None


def main(number: int, seed: int) -> None:
    """Hunt with so many starts, and print a table."""
    rng, begun = np.random.default_rng(seed), time.process_time()
    carried, gone = Counter[tuple[str, str]](), Counter[tuple[str, str]]()
    hands = cases(np.random.default_rng(HANDS_SEED))
    each = number // len(hands)
    for k, case in enumerate(hands):
        print(f"hand {k + 1} of {len(hands)}, {time.process_time() - begun:.0f} s", file=sys.stderr, flush=True)
        for name, told, region, e in asked(case):
            if region.is_empty:
                continue
            starts = starts_in(region, each, rng)
            away = lost(case, starts, rng.uniform(*CLAIMED, len(starts)) if e is None else e)
            carried[name, told] += len(starts)
            gone[name, told] += int(away.sum())
            for x, y in starts[away][:3] if name != "corrected" and told != "0" else ():
                print(f"    {name}, e {told}: lost from ({x:.6g}, {y:.6g})", file=sys.stderr, flush=True)
    print(f"{len(hands)} hands, seed {seed}, {time.process_time() - begun:.0f} s of processor time")
    for name, told in carried:
        print(f"| {name} | {told} | {carried[name, told]} | {gone[name, told]} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000, int(sys.argv[2]) if len(sys.argv) > 2 else SEED)
