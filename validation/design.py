"""The shipped briefs: the answer, 100 000 random cases of each, the best hand of a coarse grid, and MuJoCo's verdict.

    python3 dev.py validate design [NAME...] [CASES [SEED]]

For the grid, palm and fingers run over all hands shorter than the answer and up to a twentieth longer; where the answer
curls its fingers, over lengths from 0.85 of it on, palms, links and preshape angles. Each is judged as the search
judges hands, where only the hold counts by the closure kernels: a hand that the search passed over shows as one of the grid
that is shorter than the answer.

MuJoCo: starts and circumstances drawn as in the trial, in a world that shares no code with the kernels.

    python3 dev.py validate design random BRIEFS [CASES [SEED]]

Random briefs for disks on a table: thick and thin fingers, crossing and colliding, with limits on the palm or without;
MuJoCo is not asked.

Every row is kept in build/ as it is done, for these sources, and not computed again when the hunt is started anew.
"""

from __future__ import annotations

import hashlib
import json
import sys
import time
from itertools import product
from pathlib import Path

import numpy as np

from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.mechanics.closure.disk_2_2 import frictional_radii
from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.models.design_brief import DesignBrief
from palmar.models.design_brief_file import open_brief, parse_brief, shipped_briefs
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.support import SupportKind
from palmar.studies.design.bounds import least_reach
from palmar.studies.design.circumstances import STRAIGHT, case_of
from palmar.studies.design.curled import curling
from palmar.studies.design.design import Design, design, slack
from palmar.studies.design.search import half_palms
from palmar.studies.trials_in_world import outcomes
from palmar.worlds.mujoco.world import mujoco_world

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ("mechanics", "models", "regions", "behaviours", "worlds", "studies/design")
FINE, COARSE, FELT = 24, 16, 6
"""Palms and fingers of the grid: for regions in closed form, simulated ones, and plans by touch."""
LENGTHS = (0.85, 0.9, 0.95, 0.975, 1.0, 1.025, 1.05)
"""Of the grid of fingers that curl, in that of the answer."""
PALMS, PROXIMAL, ANGLES = (0.0, 0.2, 0.5, 1.0), (0.4, 0.6, 0.75, 0.9), (20.0, 30.0, 40.0, 55.0)
"""Of that grid: the palm's share of what the reach leaves, the proximal link's of the finger, preshape angles (deg)."""
DOES = -1e-9
"""A slack that is no more need not be worked out."""
GROUPS, STARTS, RATE = 10, 20, np.radians(8.0)
"""Circumstances and starts of each in MuJoCo, and how fast (rad/s) fingers close there on a table."""
LONGER = 1.05
SHARES = {1: 2001, 2: 201, 3: 12}
"""Steps of a link's share of half the hand, by links a finger."""


class Log:
    """Rows by name in a file of build/, for these sources and arguments."""

    def __init__(self, *words: object) -> None:
        files = [Path(__file__), *(f for each in SOURCES for f in sorted((ROOT / "src/palmar" / each).rglob("*.py")))]
        files += sorted((ROOT / "src/palmar/cases/briefs").glob("*.toml"))
        digest = hashlib.sha256(b"".join(each.read_bytes() for each in files)).hexdigest()[:12]
        self.file = ROOT / "build" / f"design-{'-'.join(map(str, words))}-{digest}.jsonl"
        self.file.parent.mkdir(exist_ok=True)
        lines = self.file.read_text().splitlines() if self.file.exists() else []
        self.rows: dict[str, list[str]] = dict(json.loads(each) for each in lines)

    def keep(self, name: str, row: list[str]) -> None:
        """Write a row down."""
        self.rows[name] = row
        with self.file.open("a") as file:
            file.write(json.dumps([name, row]) + "\n")


def best_of_grid(brief: DesignBrief, answer: Design) -> float | None:
    """Length (m) of the shortest hand of the grid that does; None where none up to a twentieth longer does."""
    assert answer.chosen is not None and answer.chosen.hand is not None and answer.chosen.size is not None
    if brief.error == 0.0 and brief.targets.radii is not None:
        return best_share(brief, answer.chosen.links)
    if len(answer.chosen.hand.finger_links) == 2:
        return best_curled(brief, answer.chosen.size)
    half = 0.5 * LONGER * answer.chosen.size
    quick = brief.targets.radii is not None and brief.targets.support.value == "table"
    count = FELT if brief.targets.sensors else FINE if quick else COARSE
    (palm, palm_most), (finger, finger_most) = brief.limits.palm_width, brief.limits.finger_length
    palms = np.linspace(max(0.5 * palm, 0.02 * half), min(0.5 * palm_most, half), count)
    fingers = np.linspace(max(finger, 0.1 * half), min(finger_most, half), count)
    hands = sorted((float(d + length), float(d), float(length)) for d, length in product(palms, fingers))
    for total, d, length in hands:
        if total <= half and slack(brief, d, (length,), STRAIGHT, DOES) >= 0.0:
            return 2.0 * total
    return None


def best_curled(brief: DesignBrief, size: float) -> float | None:
    """The same of fingers of two links that curl: lengths about that of the answer (m), palms, links, preshape angles."""
    for half in 0.5 * size * np.array(LENGTHS):
        least, most = half_palms(2.0 * half, brief.limits, least_reach(brief))
        for share, proximal, angle in product(PALMS, PROXIMAL, ANGLES):
            d = least + share * (most - least)
            links = (proximal * (half - d), (1.0 - proximal) * (half - d))
            if least <= most and slack(brief, d, links, curling(np.radians(angle)), DOES) >= 0.0:
                return float(2.0 * half)
    return None


def in_mujoco(brief: DesignBrief, answer: Design, seed: int) -> str:
    """How many of the starts drawn are not caught by MuJoCo; "-" where nothing is caught by closing."""
    chosen, targets = answer.chosen, brief.targets
    if chosen is None or chosen.hand is None or chosen.place is None or targets.sensors is not None:
        return "-"
    rng, lost = np.random.default_rng(seed), 0
    free = targets.support is SupportKind.FREE
    hand: Hand = chosen.hand if free else chosen.hand.model_copy(update={"finger_rate": float(RATE)})
    for _ in range(GROUPS):
        friction, e = float(rng.uniform(*targets.friction)), float(rng.uniform(*targets.restitution))
        thing = (
            ConvexPolygon(shape="polygon", vertices=targets.vertices)
            if targets.vertices is not None
            else Disk(radius=float(rng.uniform(*(targets.radii or (0.0, 0.0)))))
        )
        far, angle = targets.error * np.sqrt(rng.uniform(size=STARTS)), rng.uniform(0.0, 2.0 * np.pi, STARTS)
        turns = rng.uniform(0.0, 2.0 * np.pi, STARTS) if targets.vertices is not None else np.zeros(STARTS)
        starts = np.column_stack([far * np.cos(angle), chosen.place[1] + far * np.sin(angle), turns])
        case = case_of(brief, hand, thing, friction, e, chosen.does)
        lost += sum(not each.caught for each in outcomes(case, starts, mujoco_world))
    return f"{lost} of {GROUPS * STARTS}"


def best_share(brief: DesignBrief, links: int) -> float:
    """Of line fingers without further limits, by scale: 2 R over the largest radius of hands of half length 1."""
    alpha, steps = brief.least_friction.friction_angle, SHARES[links]
    share = np.linspace(0.0, 1.0, steps + 1)[1:-1]
    if links == 1:
        most = float(np.nanmax(frictional_radii(share, 1.0 - share, alpha).max))
    elif links == 2:
        palm, proximal = (each.ravel() for each in np.meshgrid(share, share))
        some = palm + proximal < 1.0 - 1e-9
        palm, proximal = palm[some], proximal[some]
        most = float(np.nanmax(largest_with_friction(palm, proximal, 1.0 - palm - proximal, alpha)))
    else:
        found = [
            largest_hold(Chain(w, (p, q, 1.0 - w - p - q), alpha))
            for w, p, q in product(share, repeat=3)
            if 1e-9 < 1.0 - w - p - q < 0.26 and w < 0.26 and min(p, q) > 0.2
        ]
        most = max(each.radius for each in found if each is not None)
    return 2.0 * brief.held[1] / most


def row_of(name: str, brief: DesignBrief, cases: int, seed: int, second: bool) -> list[str]:
    """One line of the table; ``second``: with a second opinion."""
    begin = time.process_time()
    found = design(brief, cases, seed)
    took = time.process_time() - begin
    if found.chosen is None:
        return [name, "impossible" if found.proven else "none found", found.because or "", f"{took:.1f}"]
    chosen, tried = found.chosen, found.verification
    assert chosen.hand is not None and chosen.size is not None and tried is not None and found.guarantee is not None
    grid = best_of_grid(brief, found)
    checked = in_mujoco(brief, found, seed) if second else "-"
    links = " + ".join(f"{1e3 * each:.2f}" for each in chosen.hand.finger_links)
    curl = f", curl {np.degrees(chosen.does.preshape):.1f}°" if chosen.does.name.value != "close" else ""
    return [
        name, f"palm {1e3 * chosen.hand.palm_width:.2f}, fingers {links}{curl}", f"{1e3 * chosen.size:.2f}",
        "-" if found.least is None else f"{1e3 * found.least:.2f}",
        "-" if grid is None else f"{1e3 * grid:.2f} ({100.0 * (chosen.size / grid - 1.0):+.2f} %)",
        "-" if found.error is None else f"{1e3 * found.error:.2f}", ", ".join(found.binds), found.guarantee.value,
        f"{tried.violations} of {tried.cases}", checked, f"{took:.1f}",
    ]  # fmt: skip


def random_brief(rng: np.random.Generator) -> str:
    """A brief for disks on a table, as a file."""
    low = rng.uniform(15.0, 50.0)
    high = low * rng.choice([1.0, rng.uniform(1.0, 1.8)])
    friction = rng.choice([0.0, rng.uniform(0.0, 0.9)])
    thick = rng.choice([0.0, rng.uniform(2.0, 0.8 * low)])
    palm = f'palm_width_mm = "0..{rng.uniform(1.0, 3.0) * high:.3f}"\n' if rng.uniform() < 0.3 else ""
    return (
        f'[targets]\nradii_mm = "{low:.3f}..{high:.3f}"\nfriction = "{friction:.3f}..{friction + 0.3:.3f}"\n'
        f"error_mm = {rng.uniform(0.05, 1.5) * low:.3f}\n[limits]\nlinks = [1]\n{palm}finger_thickness_mm = {thick:.3f}\n"
        f'fingers = "{rng.choice(["crossing", "colliding"])}"\n'
    )


def main(words: list[str]) -> None:
    """The shipped briefs, or random ones."""
    numbers = [int(each) for each in words if each.isdigit()]
    briefs = {name: open_brief(name)[1] for name in shipped_briefs()}
    if "random" in words:
        count, cases, seed = (*numbers, *(100, 20_000, 20261127)[len(numbers) :])
        rng = np.random.default_rng(seed)
        briefs = {f"random {k}": parse_brief(random_brief(rng)) for k in range(count)}
    else:
        cases, seed = (*numbers, *(100_000, 20261127)[len(numbers) :])
    wanted = [each for each in words if each in briefs]
    briefs = {name: briefs[name] for name in wanted or briefs}
    log = Log("random" if "random" in words else "shipped", *(numbers or [cases]))
    for k, (name, brief) in enumerate(briefs.items()):
        if name not in log.rows:
            log.keep(name, row_of(name, brief, cases, seed + k, "random" not in words))
        print("| " + " | ".join(log.rows[name]) + " |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
