"""Recorded planar pushes: predicted, identified, and how far they repeat.

    python3 dev.py validate pushes [FOLDER]

FOLDER holds abs_10mm_s.csv (default: the environment variable PALMAR_DATA, else ../shared/data/planar_pushes).
"""

from __future__ import annotations

import sys
import time
from math import pi
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from palmar.mechanics.pushing.push import Pusher, PushOutcome, push
from palmar.mechanics.pushing.resting import slider_of
from palmar.models.objects import Disk
from palmar.models.support import Support
from palmar.studies.identify import Identified, identify, split
from palmar.studies.pushes import RecordedPushes, end_errors, predict, read_pushes, wrapped
from palmar.studies.registration import Registration, register, start_gaps
from reference.planar_pushes import OBJECTS, PEER, PUSHER_RADIUS, data_file

Floats = NDArray[np.float64]
FRICTION = 0.2
SEEDS = range(5)


def row(name: str, cells: list[str]) -> None:
    """Print a row of a table."""
    print("| " + " | ".join([name, *cells]) + " |", flush=True)


def table(title: str, names: list[str]) -> None:
    """Print a title and the head of a table."""
    print(f"\n{title}\n\n| | " + " | ".join(names) + " |\n|---" * 1 + "|---" * len(names) + "|")


def both(position: Floats | float, angle: Floats | float) -> str:
    """Means in mm and degrees."""
    return f"{1e3 * float(np.mean(position)):.2f} / {np.degrees(float(np.mean(angle))):.2f}"


def mean_row(name: str, errors: list[tuple[float, float]]) -> None:
    """Print the mean errors per object, and their mean."""
    row(name, [both(*each) for each in errors] + [both(*np.mean(errors, axis=0))])


def unfitted(pushes: RecordedPushes) -> None:
    """Uniform pressure, one friction for all objects."""
    table("Unfitted, mm / deg", [*OBJECTS, "mean"])
    mean_row("peer, fitted on 20 %", [(1e-3 * mm, np.radians(deg)) for mm, deg in PEER.values()])
    for friction in (0.15, 0.2, 0.25, 0.3, 0.35):
        errors, registered = [], []
        for name, thing in OBJECTS.items():
            some, slider, pusher = pushes.of(name), slider_of(thing, Support()), Pusher(PUSHER_RADIUS, friction)
            errors.append(mean_error(predict(slider, pusher, some).poses, some))
            offsets = register(slider, PUSHER_RADIUS, some.starts, some.paths)
            starts, paths = offsets.apply(some.starts, some.paths)
            registered.append(mean_error(offsets.back(push(slider, pusher, starts, paths).poses), some))
        mean_row(f"friction {friction}", errors)
        mean_row(f"friction {friction}, registered", registered)


def mean_error(poses: Floats, pushes: RecordedPushes) -> tuple[float, float]:
    """Mean errors (m, rad)."""
    errors = end_errors(poses, pushes.ends)
    return float(errors.position.mean()), float(errors.angle.mean())


def identified(pushes: RecordedPushes) -> dict[str, Identified]:
    """Fitted on 20 %, tested on the rest; returns the estimates of the first seed."""
    table("Identified on a seeded 20 %, tested on the rest, mm / deg", [*OBJECTS, "mean"])
    mean_row("peer, fitted on 20 %", [(1e-3 * mm, np.radians(deg)) for mm, deg in PEER.values()])
    kept: dict[str, Identified] = {}
    for registered in (True, False):
        every = []
        for seed in SEEDS:
            errors = []
            for name, thing in OBJECTS.items():
                some = pushes.of(name)
                fit, test = split(len(some), 0.2, seed)
                found = identify(thing, PUSHER_RADIUS, some.rows(fit), registered=registered)
                kept.setdefault(name, found)
                rest = some.rows(test)
                errors.append(mean_error(found.predict(rest), rest))
            every.append(errors)
            mean_row(f"seed {seed}" + ("" if registered else ", not registered"), errors)
        mean_row("mean of the seeds" + ("" if registered else ", not registered"), list(np.mean(every, axis=0)))
    return kept


def estimates(kept: dict[str, Identified]) -> None:
    """What was identified."""
    columns = ["pushes", "friction", "length, mm", "centre, mm", "offset of path, mm", "outline: mm, deg"]
    table("Estimates, seed 0, with standard errors", [*columns, "pressure: exponent, tilt, stretch, skew"])
    for name, one in kept.items():
        at = one.registration
        row(name, [
            str(one.pushes), f"{one.friction:.3f} ± {one.friction_error:.3f}",
            f"{1e3 * one.length:.1f} ± {1e3 * one.length_error:.1f}",
            ", ".join(f"{1e3 * c:.1f} ± {1e3 * e:.1f}" for c, e in zip(one.centre, one.centre_error, strict=True)),
            f"{1e3 * at.path[0]:.2f}, {1e3 * at.path[1]:.2f}",
            f"{1e3 * at.outline[0]:.2f}, {1e3 * at.outline[1]:.2f}; {np.degrees(at.turn):.2f}",
            ", ".join(f"{value:.2f}" for value in one.pressure),
        ])  # fmt: skip


def bootstrap(pushes: RecordedPushes, name: str, times: int = 20) -> None:
    """Scatter of the estimates over resampled pushes, to compare the standard errors with."""
    some = pushes.of(name)
    fit, _ = split(len(some), 0.2, 0)
    rng = np.random.default_rng(1)
    draws = [identify(OBJECTS[name], PUSHER_RADIUS, some.rows(rng.choice(fit, len(fit)))) for _ in range(times)]
    spread = np.std([[each.friction, 1e3 * each.length] for each in draws], axis=0, ddof=1)
    print(f"\nBootstrap, {name}, {times} draws: friction ± {spread[0]:.3f}, length ± {spread[1]:.2f} mm")


def canonical(pushes: RecordedPushes, name: str, offsets: Registration, poses: Floats) -> list[Floats]:
    """Rows (pusher's path 4, end 2 and turn, residual 2 and turn) seen from the outline, one array per symmetry."""
    starts, paths = offsets.apply(pushes.starts, pushes.paths)
    ends, guesses = offsets.apply(pushes.ends, paths)[0], offsets.apply(poses, paths)[0]
    centre = slider_of(OBJECTS[name], Support()).centre

    def middle(pose: Floats) -> Floats:
        c, s = np.cos(pose[:, 2]), np.sin(pose[:, 2])
        return pose[:, :2] + np.stack((c * centre[0] - s * centre[1], s * centre[0] + c * centre[1]), axis=1)

    c, s = np.cos(starts[:, 2]), np.sin(starts[:, 2])

    def seen(vector: Floats) -> Floats:
        return np.stack((c * vector[:, 0] + s * vector[:, 1], c * vector[:, 1] - s * vector[:, 0]), axis=1)

    vectors = [seen(each) for each in (paths[:, :2] - middle(starts), paths[:, 2:] - middle(starts),
                                       middle(ends) - middle(starts), middle(ends) - middle(guesses))]  # fmt: skip
    turns = [wrapped(ends[:, 2] - starts[:, 2]), wrapped(ends[:, 2] - guesses[:, 2])]
    return [stacked(vectors, turns, *each) for each in symmetries(name, vectors)]


def stacked(vectors: list[Floats], turns: list[Floats], angle: Floats, mirror: Floats) -> Floats:
    """Every vector mirrored in the x axis where ``mirror`` is -1, then turned by ``angle``."""
    c, s = np.cos(angle), np.sin(angle)
    moved = []
    for each in vectors:
        x, y = each[:, 0], mirror * each[:, 1]
        moved += [c * x - s * y, s * x + c * y]
    return np.stack([*moved[:6], mirror * turns[0], *moved[6:], mirror * turns[1]], axis=1)


def symmetries(name: str, vectors: list[Floats]) -> list[tuple[Floats, Floats]]:
    """(angle, mirror) per push; the disk is turned to one bearing, the others have a finite group."""
    one = np.ones(len(vectors[0]))
    if isinstance(OBJECTS[name], Disk):
        side = np.where(vectors[0][:, 0] * vectors[1][:, 1] < vectors[0][:, 1] * vectors[1][:, 0], -1.0, 1.0)
        return [(-side * np.arctan2(vectors[0][:, 1], vectors[0][:, 0]), side)]
    folds = {"rect1": 4, "rect3": 2, "hex": 6}.get(name)
    if folds is None:  # the triangle is its own image in the line y = x
        return [(0.0 * one, one), (0.5 * pi * one, -one)]
    angles = [2.0 * pi * k / folds * one for k in range(folds)]
    return [(angle, sign * one) for angle in angles for sign in (1.0, -1.0)]


def differences(name: str, pushes: RecordedPushes, one: Identified) -> tuple[Floats, ...]:
    """Over all pairs: distance of their paths (m), difference of the ends (m), of the residuals (m), of the turns."""
    copies = canonical(pushes, name, one.registration, one.predict(pushes))
    first, count = copies[0], len(pushes)
    best = np.full((count, count), np.inf)
    found = np.zeros((3, count, count))
    for other in copies:
        apart = first[:, None, :] - other[None, :, :]
        distance = np.sqrt(0.5 * np.sum(apart[:, :, :4] ** 2, axis=2))
        nearer = distance < best
        best[nearer] = distance[nearer]
        for k, value in enumerate((np.hypot(apart[:, :, 4], apart[:, :, 5]), np.hypot(apart[:, :, 7], apart[:, :, 8]),
                                   np.abs(wrapped(apart[:, :, 6])))):  # fmt: skip
            found[k][nearer] = value[nearer]
    upper = np.triu_indices(count, 1)
    return best[upper], found[0][upper], found[1][upper], found[2][upper]


def repeatability(pushes: RecordedPushes, kept: dict[str, Identified]) -> None:
    """How different the outcomes of nearly equal pushes are."""
    table("Pairs of pushes whose paths, seen from the object, differ by less than 1 mm (extrapolated from 3 mm)", [
        "pairs", "their ends differ by", "extrapolated to equal paths", "so the best mean error is", "in angle",
        "from residuals of the identified model",
    ])  # fmt: skip
    for name in OBJECTS:
        distance, ends, residuals, turns = differences(name, pushes.of(name), kept[name])
        near, close = distance < 1e-3, distance < 3e-3
        limits = [at_zero(distance[close], each[close]) for each in (ends, turns, residuals)]
        row(name, [str(near.sum()), f"{1e3 * ends[near].mean():.2f} mm", f"{1e3 * limits[0]:.2f} mm",
                   f"{1e3 * limits[0] / 2**0.5:.2f} mm", f"{np.degrees(limits[1]) / 2**0.5:.2f} deg",
                   f"{1e3 * limits[2] / 2**0.5:.2f} mm"])  # fmt: skip


def at_zero(distance: Floats, difference: Floats) -> float:
    """Value at distance 0 of the straight line through the differences."""
    return float(np.polynomial.polynomial.polyfit(distance, difference, 1)[0])


def gaps(pushes: RecordedPushes) -> None:
    """Spread of the gap at the start of the pushes, before and after the instruments are brought together."""
    table("Gap at the start: median size, mm", ["as recorded", "registered", "starts used"])
    for name, thing in OBJECTS.items():
        some, slider = pushes.of(name), slider_of(thing, Support())
        offsets = register(slider, PUSHER_RADIUS, some.starts, some.paths)
        before = start_gaps(slider, PUSHER_RADIUS, some.starts, some.paths)
        after = start_gaps(slider, PUSHER_RADIUS, *offsets.apply(some.starts, some.paths))
        sizes = [f"{1e3 * float(np.median(np.abs(each))):.2f}" for each in (before, after)]
        row(name, [*sizes, f"{offsets.starts} of {len(some)}"])


def tolerances(pushes: RecordedPushes) -> None:
    """Error and time of the kernel against its tolerance."""
    table("Largest difference from tolerance 1e-11, over all pushes", ["mm", "deg", "ms per push"])
    exact = {}
    for tolerance in (1e-11, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5):
        worst, turn, seconds = 0.0, 0.0, 0.0
        for name, thing in OBJECTS.items():
            some, begin = pushes.of(name), time.perf_counter()
            done = push(
                slider_of(thing, Support()), Pusher(PUSHER_RADIUS, FRICTION), some.starts, some.paths, tolerance
            )
            seconds += time.perf_counter() - begin
            assert PushOutcome.UNDECIDED not in done.outcomes
            exact.setdefault(name, done.poses)
            errors = end_errors(done.poses, exact[name])
            worst, turn = max(worst, errors.position.max()), max(turn, errors.angle.max())
        row(f"{tolerance:g} m", [f"{1e3 * worst:.2g}", f"{np.degrees(turn):.2g}", f"{1e3 * seconds / len(pushes):.3f}"])


def main(words: list[str]) -> int:
    """All of it."""
    source = data_file(words[0] if words else None)
    if source is None:
        print("the recorded pushes are not here; name their folder", file=sys.stderr)
        return 2
    pushes = read_pushes(source)
    gaps(pushes)
    unfitted(pushes)
    tolerances(pushes)
    kept = identified(pushes)
    estimates(kept)
    bootstrap(pushes, "rect3")
    repeatability(pushes, kept)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
