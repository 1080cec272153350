"""How well the cell's camera finds the cylinder: errors against the truth, and whether they keep to what is claimed.

    python3 dev.py validate vision [POSES [SEED]]

POSES (600) of cylinder and hand for each task, drawn so that the hand often hides part of the cylinder: the hand is
anywhere within 60 mm of where it works, its fingers open or half closed, whether or not that could be. A hanging cylinder is
also turned and raised a little, as it is when it sways. Takes a minute for each task; status 1 if fewer than 95 % of the
axes lie within twice the standard deviation.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.arm.puma_560 import nearest
from palmar.models.cell_task import CellTask, TaskKind
from palmar.models.salisbury_hand import CYLINDRIC, TIP_PREHENSION, SalisburyHand
from palmar.studies.cell_trials import TASKS
from palmar.worlds.cell.calibration import Calibration
from palmar.worlds.cell.cylinder_finder import CylinderFinder, Found
from palmar.worlds.cell.upright_outline import Upright
from palmar.worlds.mujoco.cell.cell import ARM, ELBOW_UP, FINGERS
from palmar.worlds.mujoco.cell.rendered_camera import BOB, RenderedCamera
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import start_pose

Floats = NDArray[np.float64]
HAND = SalisburyHand()
AROUND, HAND_AROUND, TILT = 0.04, 0.06, 1e-3
"""The axis is so near (m) to its place, the hand to where it works; a hanging cylinder tilts by so much (rad)."""
ENOUGH = 0.95


@dataclass(frozen=True)
class Case:
    """What was drawn, and what was found: None, nothing."""

    x: float
    y: float
    found: Found | None


def drawn(task: CellTask, random: np.random.Generator) -> Floats:
    """A state (22,) of the scene but for a hanging cylinder's bar, or the first of it: arm, fingers, cylinder's pose."""
    x, y = np.array(task.place[:2]) + AROUND * random.uniform(-1.0, 1.0, 2)
    joints = None
    while joints is None:
        pose = start_pose(HAND, task)
        pose[:3, 3] = x, y, task.place[2]
        pose[:3, 3] -= pose[:3, 2] * (random.uniform(0.0, 0.2) + _half(task)) - HAND_AROUND * random.uniform(-1, 1, 3)
        pose[2, 3] += 0.0 if task.kind is TaskKind.TABLE else HAND_AROUND * random.uniform(-1.0, 1.0)
        unmount = np.eye(4)
        unmount[2, 3] = -HAND.mount
        joints = nearest(pose @ unmount, ELBOW_UP)
    curl = TIP_PREHENSION if task.kind is TaskKind.TABLE else CYLINDRIC
    fingers = curl.joints(random.uniform(curl.opened, 0.5, 3)).ravel()
    hanging = task.kind is TaskKind.FLOATING
    raised, tilt = BOB[task.kind] * random.standard_normal(), TILT * hanging * random.standard_normal(2)
    return np.array([*joints, *fingers, x, y, task.place[2] + raised, 1.0, *(0.5 * tilt), 0.0])


def _half(task: CellTask) -> float:
    return 0.5 * task.cylinder.height if task.kind is TaskKind.TABLE else task.cylinder.radius


def states(camera: RenderedCamera, task: CellTask, number: int, seed: int) -> list[Floats]:
    """Whole states of the camera's scene."""
    random, rest = np.random.default_rng(seed), camera.rest
    return [np.concatenate([state, rest[len(state) :]]) for state in (drawn(task, random) for _ in range(number))]


def tell(task: CellTask, number: int, seed: int) -> float:
    """Print one task's rows; the share of axes within twice the standard deviation."""
    camera = RenderedCamera(HAND, task, CellSettings(seed=seed))
    place = FINGERS.stop
    cases = [Case(q[place], q[place + 1], camera.find(q)) for q in states(camera, task, number, seed)]
    everything = 0.0
    for name, least, most in (("all", 0.0, 1.01), ("seen 90 % or more", 0.9, 1.01), ("less than 70 %", 0.0, 0.7)):
        some = [each for each in cases if each.found is not None and least <= each.found.seen < most]
        share = row(f"{task.kind.value}, {name}", some, number, task.cylinder.radius)
        everything = share if name == "all" else everything
    return everything


def row(name: str, cases: list[Case], number: int, radius: float) -> float:
    """One row; the share within twice the standard deviation."""
    found = [each.found for each in cases if each.found is not None]
    if not found:
        print(f"| {name} | 0/{number} | | | | | | |", flush=True)
        return 1.0
    off = 1e3 * np.array([(each.found.body.x - each.x, each.found.body.y - each.y) for each in cases if each.found])
    sigma, radii = 1e3 * np.array([each.sigma for each in found]), 1e3 * np.array([each.body.radius for each in found])
    far = np.linalg.norm(off, axis=1)
    share = float((far <= 2.0 * sigma).mean())
    bias = ", ".join(f"{value:+.3f}" for value in off.mean(axis=0))
    print(
        f"| {name} | {len(found)}/{number} | {bias} | {np.sqrt((far**2).mean()):.3f} | {far.max():.2f} |"
        f" {np.median(sigma):.3f} ({sigma.min():.3f} to {sigma.max():.2f}) | {100 * share:.1f} % |"
        f" {(radii - 1e3 * radius).mean():+.3f}, {radii.std():.3f} |",
        flush=True,
    )
    return share


def calibrations(task: CellTask, seed: int, number: int = 200) -> None:
    """Errors of axis and radius (mm, rms) that wrong calibrations make, beside what is foretold of them."""
    camera, random = RenderedCamera(HAND, task, CellSettings(seed=seed)), np.random.default_rng(seed)
    state = camera.rest.copy()
    state[ARM] = nearest(start_pose(HAND, task) @ _unmount(), ELBOW_UP)
    picture, finder = camera.picture(state), camera.finder
    right = finder.find(picture)
    assert right is not None
    for name, stated in (
        ("1 mm", Calibration(0.001, 0.0, 0.0)),
        ("1 mrad", Calibration(0.0, 0.001, 0.0)),
        ("0.1 % of the focal length", Calibration(0.0, 0.0, 0.001)),
        ("all three", Calibration()),
    ):
        off = np.array([_off(finder, stated, picture, right.body, random) for _ in range(number)])
        found, told = (
            1e3 * np.sqrt((off**2).mean(axis=0)),
            1e3 * np.sqrt(np.diag(stated.spread(camera.true, right.body))),
        )
        told_so = ", ".join(f"{value:.2f}" for value in told)
        print(f"| {task.kind.value}, {name} | {', '.join(f'{value:.2f}' for value in found)} | {told_so} |", flush=True)


def _unmount() -> Floats:
    unmount = np.eye(4)
    unmount[2, 3] = -HAND.mount
    return unmount


def _off(
    finder: CylinderFinder, stated: Calibration, picture: NDArray[np.uint8], right: Upright, random: np.random.Generator
) -> Floats:
    wrong = replace(finder, camera=stated.wrong(finder.camera, random.standard_normal(7))).find(picture)
    assert wrong is not None
    return np.array([wrong.body.x - right.x, wrong.body.y - right.y, wrong.body.radius - right.radius])


def speed(task: CellTask, frames: int = 100) -> None:
    """Milliseconds per frame."""
    camera = RenderedCamera(HAND, task, CellSettings())
    began = perf_counter()
    pictures = [camera.picture(camera.rest) for _ in range(frames)]
    rendered = perf_counter()
    for each in pictures:
        camera.finder.find(each)
    spent = 1e3 * (rendered - began) / frames, 1e3 * (perf_counter() - rendered) / frames
    print(f"{task.kind.value}: {spent[0]:.1f} ms to render a frame, {spent[1]:.1f} ms to find the cylinder in it")


def main(words: list[str]) -> int:
    """All tables."""
    number, seed = (int(words[k]) if len(words) > k else value for k, value in enumerate((600, 1)))
    print("| task, how much of the outline is seen | found | bias x, y, mm | rms, mm | worst, mm |", end="")
    print(" claimed σ, mm | within 2 σ | radius: bias, sd, mm |\n|---|---|---|---|---|---|---|---|")
    shares = [tell(task, number, seed) for task in TASKS.values()]
    print("\n| task, calibration wrong by | rms x, y, radius, mm | foretold |\n|---|---|---|")
    for task in TASKS.values():
        calibrations(task, seed)
    print()
    for task in TASKS.values():
        speed(task)
    return int(min(shares) < ENOUGH)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
