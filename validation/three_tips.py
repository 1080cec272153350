"""Three closing tips: closed forms against small steps and a general pusher, plans against trials, and a tilted hand.

python3 dev.py validate three_tips [STARTS [SEED]]
"""

from __future__ import annotations

import sys
import time
from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from palmar.behaviours.descent import descents, is_certain
from palmar.mechanics.pushing.push import Pusher, push
from palmar.mechanics.pushing.slider import disk_slider
from palmar.mechanics.pushing.three_tips import AXES, CAGE, drift, ends, first_touches, leans, ways
from palmar.models.outcome import Outcome
from palmar.models.support import Pressure
from palmar.models.three_tips import ThreeTips
from palmar.regions.three_tips import tips_drag
from palmar.studies.plan_trial import drawn_starts
from palmar.studies.three_tips import Task, largest_uncertainty, plan_descents, try_descents, uncertain_disk
from reference.slow_tips import DIRECTIONS, frictionless_ends

RADIUS, TIP = 0.03, 0.01
RHO = RADIUS + TIP
THRICE = 2.0, None, 0.5
"""Where three approaches, whose search takes minutes, are tried as well."""
CAUGHT = [each.code for each in Outcome if each.caught]


def against_steps(starts: int, rng: np.random.Generator) -> None:
    """Without friction: the verdict of every start, and where the caught ones end."""
    for opened, closed in ((0.08, 0.02), (0.05, 0.03), (0.06, 0.042), (0.12, 0.02)):
        centres = rng.uniform(-opened, opened, (starts, 2))
        codes = ends((RADIUS, TIP, opened, closed), 0.0, drift(None, 0.0), centres)
        valid = codes != Outcome.INVALID.code
        inside, last = frictionless_ends(RHO, opened, closed, centres[valid], 3000)
        caught = np.isin(codes[valid], CAUGHT)
        off = np.abs(last[caught & inside]).max() if closed <= RHO else float("nan")
        print(
            f"  open {1e3 * opened:g}, closed {1e3 * closed:g} mm: {valid.sum()} starts, {caught.sum()} caught,"
            f" {(caught != inside).sum()} differ; three contacts within {1e3 * off:.3f} mm of the middle"
        )


def against_pusher(starts: int, rng: np.random.Generator) -> None:
    """With friction: beta as the general pusher leaves it at the caging radius."""
    opened = 0.08
    for friction in (0.05, 0.3, 1.0):
        table = drift(tips_drag(RADIUS, Pressure.UNIFORM), friction)
        centres = rng.uniform(-0.05, 0.05, (starts, 2))
        at, beta = first_touches(centres, RHO, opened)
        first = at.argmax(axis=1)
        touch, lean = at.max(axis=1), beta[np.arange(starts), first]
        ours = leans(table, ways(table, lean) - (touch - CAGE * RHO) / RHO)
        use = (touch > CAGE * RHO) & (
            np.hypot(*(centres[:, None] - opened * AXES).transpose(2, 0, 1)).min(axis=1) > RHO
        )
        use &= ours < 0.5 * pi
        axes = AXES[first[use]]
        paths = np.concatenate([opened * axes, CAGE * RHO * axes], axis=1)
        poses = np.column_stack([centres[use], np.zeros(use.sum())])
        done = push(disk_slider(RADIUS), Pusher(TIP, friction), poses, paths)
        off = done.poses[:, :2] - CAGE * RHO * axes
        theirs = np.arctan2(np.abs(off[:, 0] * axes[:, 1] - off[:, 1] * axes[:, 0]), -(off * axes).sum(axis=1))
        print(f"  friction {friction:g}: {use.sum()} pushes, beta within {np.abs(theirs - ours[use]).max():.1e} rad")


def plans(trials: int, seed: int) -> None:
    """The largest uncertain disks for one, two and three approaches, over rho, each with a trial."""
    for opened, palm, friction in (
        (1.4, None, 0.5),
        (1.6, None, 0.5),
        (2.0, None, 0.5),
        (3.0, None, 0.5),
        (2.0, 0.02, 0.5),
        (2.0, None, 0.0),
    ):
        tips = ThreeTips(tip_radius=TIP, open_radius=opened * RHO, closed_radius=0.02, palm_radius=palm)
        task = Task(tips, RADIUS, friction)
        words = []
        for most in (1, 2, 3) if (opened, palm, friction) == THRICE else (1, 2):
            begin = time.perf_counter()
            error = largest_uncertainty(task, most, step=0.01 if most < 3 else 0.1)
            plan = plan_descents(task, uncertain_disk(error), most)
            tried = try_descents(task, plan, drawn_starts(uncertain_disk(error), trials, seed), seed)
            assert is_certain(plan)
            words.append(
                f"{descents(plan)}: {error / RHO:.2f} ({tried.lost + tried.given_up} lost,"
                f" {time.perf_counter() - begin:.0f} s)"
            )
        print(f"  open {opened:g} rho, palm {palm}, friction {friction:g}: " + ", ".join(words), flush=True)


def fixed_openings() -> None:
    """Two approaches when the first comes down with the tips on a given circle."""
    for opened in (2.0, 3.0):
        task = Task(ThreeTips(tip_radius=TIP, open_radius=opened * RHO, closed_radius=0.02), RADIUS, 0.5)
        felt = Task(
            ThreeTips(tip_radius=TIP, open_radius=opened * RHO, closed_radius=0.02, palm_radius=0.02), RADIUS, 0.5
        )
        row = [
            f"{each:g}: {largest_uncertainty(task, 2, each * RHO) / RHO:.2f}/"
            f"{largest_uncertainty(felt, 2, each * RHO) / RHO:.2f}"
            for each in (0.5, 0.8, 1.0, 1.15, 1.3, 1.6, 1.9)
        ]
        print(
            f"  open {opened:g} rho, touching circle over rho: without/with palm of 20 mm: " + ", ".join(row),
            flush=True,
        )


def touched(trials: int, seed: int) -> None:
    """What displaced cylinders and a hand that is off cost, of two approaches opened to 2 rho."""
    tips = ThreeTips(tip_radius=TIP, open_radius=2.0 * RHO, closed_radius=0.02)
    for moved, off in ((0.002, 0.0), (0.005, 0.0), (0.01, 0.0), (0.0, 0.002), (0.0, 0.005), (0.005, 0.002)):
        task = Task(tips, RADIUS, 0.5, displacement=moved, pose_error=off)
        error = largest_uncertainty(task, 2)
        plan = plan_descents(task, uncertain_disk(error), 2)
        tried = try_descents(task, plan, drawn_starts(uncertain_disk(error), trials, seed), seed)
        print(
            f"  touch moves it {1e3 * moved:g} mm, hand off {1e3 * off:g} mm: {error / RHO:.2f},"
            f" {tried.lost + tried.given_up} lost",
            flush=True,
        )


def tilted(starts: int, rng: np.random.Generator) -> None:
    """A hand tilted by a about the x axis: the tips seen along the cylinder's axis move on an ellipse."""
    opened, closed = 0.08, 0.02
    centres = rng.uniform(-0.07, 0.07, (starts, 2))
    straight = np.zeros(0)
    for tilt in (0.0, 5.0, 10.0, 20.0, 30.0):
        seen = DIRECTIONS * [1.0, cos(radians(tilt))]
        free = (np.hypot(*(centres[:, None] - opened * seen).transpose(2, 0, 1)) >= RHO).all(axis=1)
        inside, _ = frictionless_ends(RHO, opened, max(closed, 0.0), centres, 1200, seen)
        caught = inside & free
        straight = caught if tilt == 0.0 else straight
        apart = 1e3 * 1.5 * opened * sin(radians(tilt))
        print(
            f"  tilt {tilt:g} deg: area {caught.mean() * 0.14**2 * 1e4:.2f} cm2, of the level hand's"
            f" {(caught & straight).sum() / straight.sum():.3f};"
            f" tips {apart:.0f} mm apart in height"
        )


def main() -> None:
    """All of it."""
    starts = int(sys.argv[1]) if len(sys.argv) > 1 else 4000
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    rng = np.random.default_rng(seed)
    print("small steps, no friction:")
    against_steps(starts, rng)
    print("the general pusher, with friction:")
    against_pusher(starts, rng)
    print("tilted hand:")
    tilted(2 * starts, rng)
    print("largest uncertain disk over rho, by approaches:")
    plans(100_000, seed)
    print("two approaches, the first on a given circle:")
    fixed_openings()
    print("two approaches, opened to 2 rho:")
    touched(100_000, seed)


if __name__ == "__main__":
    main()
