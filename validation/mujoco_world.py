"""The world mujoco against the planar one: closing from random starts, and every behaviour that needs no plan.

    python3 dev.py validate mujoco_world [STARTS [SEED]]

For each of the hands and objects of CASES, STARTS (200) random starts of the closing motion at RATE, line and thick fingers,
free disks too; each disagreement is told with how far aside the planar kernels answer as MuJoCo did. Then each behaviour
from RUNS starts in both worlds, and a finer step.
"""

from __future__ import annotations

import sys
import time
from functools import partial

import numpy as np

from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.studies.simulate import simulate_starts
from palmar.studies.simulate_in_world import simulate_starts_in
from palmar.worlds.mujoco.world import mujoco_world
from palmar.worlds.planar.feedback import feedback_world

RATE = 8.0
"""Closing rate (deg/s) on a table: slow enough for inertia to matter little."""
BED = f"[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nfinger_rate_deg_s = {RATE}\n"
THICK = BED + 'finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK, GRIP, SLIP = "[object]\nradius_mm = 38\n", "[contact]\nfriction = 0.7\n", "[contact]\nfriction = 0\n"
BOX = '[object]\nshape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
FREE = '[support]\nkind = "free"\n'
FAST = BED.replace(f"finger_rate_deg_s = {RATE}", "finger_rate_deg_s = 30")
CASES = {
    "disk, line fingers": BED + DISK + GRIP,
    "disk, line fingers, no friction": BED + DISK + SLIP,
    "disk, thick colliding fingers": THICK + DISK + GRIP,
    "box, line fingers": BED + BOX + GRIP,
    "free disk, line fingers, restitution 1": FAST + DISK + SLIP + FREE,
    "free disk, line fingers, restitution 0.5": FAST + DISK + "[contact]\nfriction = 0\nrestitution = 0.5\n" + FREE,
}
RUNS = 2
ELSEWHERE = (BehaviourName.FOLLOW_POLICY, BehaviourName.MATCH_VELOCITY, BehaviourName.MATCHED_RETURN)
"""They need a plan, and a free disk that is tracked."""
AWAY = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nopen_deg = 40\nfinger_rate_deg_s = {rate}\n" + DISK
JOINTED = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_rate_deg_s = 10\n"
SENSORS = '[sensors]\nlayout = "distributed"\n'
MOVE = "[behaviour]\nadvance_mm = 150\nspeed_mm_s = 50\n"
ASIDE = (1e-3, 3e-3, 1e-2, 3e-2, 1e-1)
"""Distances (finger lengths) at which starts about one that is told differently are tried."""


def starts_for(case: Case, number: int, seed: int) -> np.ndarray:
    """(N, 3): x, y, theta; disks do not overlap the open hand."""
    length = case.hand.finger_length
    low, high = [-1.1 * length, 0.19 * length, -3.0], [1.1 * length, 1.1 * length, 3.0]
    return np.random.default_rng(seed).uniform(low, high, (number, 3))


def closing(name: str, number: int, seed: int) -> None:
    """Outcomes of random starts in both worlds."""
    case = parse_case(CASES[name], name)
    starts = starts_for(case, number, seed)
    planar = simulate_starts(case, starts)
    begin = time.process_time()
    other = simulate_starts_in(case, starts, mujoco_world)
    each = (time.process_time() - begin) / number
    ours, theirs = ([Outcome.from_code(int(code)) for code in ends.codes] for ends in (planar, other))
    same = sum(a is b for a, b in zip(ours, theirs, strict=True))
    valid = sum(a is not Outcome.INVALID for a in ours)
    caught = [k for k in range(number) if ours[k].caught and theirs[k].caught]
    differ = [k for k in range(number) if ours[k].caught != theirs[k].caught]
    apart = np.hypot(*(planar.poses - other.poses)[caught, :2].T) if caught else np.zeros(1)
    print(
        f"{name}: {number} starts ({valid} valid, {len(caught)} caught in both), same outcome {same}, caught or not differs"
        f" {len(differ)}; ends of caught ones apart: median {1e3 * np.median(apart):.2f} mm, 90 %"
        f" {1e3 * np.quantile(apart, 0.9):.2f} mm; {each:.3f} s of processor time a run",
        flush=True,
    )
    for k in differ:
        print(
            f"    {np.round(starts[k], 4)} planar {ours[k].value}, mujoco {theirs[k].value}: {boundary(case, starts[k])}"
        )


def boundary(case: Case, start: np.ndarray) -> str:
    """How near to a start the planar kernels answer otherwise."""
    caught = Outcome.from_code(int(simulate_starts(case, start[None]).codes[0])).caught
    around = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    for aside in ASIDE:
        way = aside * case.hand.finger_length
        about = start + np.column_stack([way * np.cos(around), way * np.sin(around), np.zeros(24)])
        codes = simulate_starts(case, about).codes
        if any(Outcome.from_code(int(code)).caught != caught for code in codes):
            return f"the planar answer changes {1e3 * way:.2f} mm aside"
    return "far from the planar boundary"


def behaviours(seed: int) -> None:
    """Every behaviour without a plan from RUNS starts in both worlds."""
    for name in BehaviourName:
        if name in ELSEWHERE:
            continue
        case = parse_case(JOINTED + DISK + GRIP + SENSORS + f'{MOVE}name = "{name.value}"\n', name.value)
        starts = np.random.default_rng(seed).uniform([-0.15, 0.06, 0.0], [0.15, 0.28, 0.0], (RUNS, 3))
        for start in starts:
            place = float(start[0]), float(start[1]), 0.0
            ends, spent = [], []
            for make in (feedback_world, mujoco_world):
                begin = time.process_time()
                ends.append(run_behaviour(case, place, Circumstances(make=make)))
                spent.append(time.process_time() - begin)
            one, other = (each.trace for each in ends)
            apart = np.hypot(*(np.array(one.rows[-1].pose) - other.rows[-1].pose)[:2])
            told = [tuple(dict.fromkeys(row.why for row in each.rows)) for each in (one, other)]
            print(
                f"{name.value} from ({1e3 * place[0]:.0f}, {1e3 * place[1]:.0f}) mm: {one.outcome.value},"
                f" {other.outcome.value}; verdicts {ends[0].verdict.value}, {ends[1].verdict.value};"
                f" {1e3 * apart:.2f} mm apart; {'the same' if told[0] == told[1] else 'other'} phases;"
                f" {spent[0]:.2f} s, {spent[1]:.2f} s"
                f"{'' if one.outcome is other.outcome else '  <-- differs'}",
                flush=True,
            )


def ends_at(step: float, case: Case, starts: np.ndarray) -> np.ndarray:
    """(N, 4): outcome code and final pose with a time step (s)."""
    found = simulate_starts_in(case, starts, partial(mujoco_world, step=step))
    return np.column_stack([found.codes, found.poses])


def pushed_away() -> None:
    """A disk that the right tip pushes off, over friction, closing rate and time step: how far it turns and ends apart."""
    for friction in (0.05, 0.2, 0.7, 3.0):
        for rate in (10.0, 5.0, 2.0):
            case = parse_case(AWAY.format(rate=rate) + f"[contact]\nfriction = {friction}\n")
            exact = simulate_starts(case, [(0.25, 0.2, 0.0)]).poses[0]
            told = []
            for step in (1e-3, 5e-4, 2.5e-4):
                world = mujoco_world(case, (0.25, 0.2, 0.0), step=step)
                turning = (case.hand.finger_rate, 0.0)
                while world.time < 10.0 / rate:
                    world.act(Command(turning, turning), 0.01)
                apart = np.array(world.pose) - exact
                told.append(f"{apart[2]:+.4f} rad {1e3 * np.hypot(apart[0], apart[1]):.3f} mm")
            print(
                f"pushed away, friction {friction}, {rate:g} deg/s: planar turn {exact[2]:.4f}; apart at"
                f" 1, 0.5, 0.25 ms: {'; '.join(told)}",
                flush=True,
            )


def steps(number: int, seed: int) -> None:
    """How much ends change with the time step."""
    for name in ("disk, line fingers", "free disk, line fingers, restitution 1"):
        case = parse_case(CASES[name], name)
        starts = starts_for(case, number, seed)
        free = "free" in name

        sizes = (4e-4, 2e-4, 1e-4, 5e-5) if free else (4e-3, 2e-3, 1e-3, 5e-4)
        ends = [ends_at(step, case, starts) for step in sizes]
        caught = [Outcome.from_code(int(code)).caught for code in ends[-1][:, 0]]
        for step, found in zip(sizes[:-1], ends[:-1], strict=True):
            apart = np.hypot(*(found - ends[-1])[caught, 1:3].T)
            print(
                f"{name}: step {1e3 * step:g} ms against {1e3 * sizes[-1]:g} ms: other outcomes"
                f" {int(np.sum(found[:, 0] != ends[-1][:, 0]))} of {number}, ends apart median"
                f" {1e3 * np.median(apart):.3f} mm, largest {1e3 * apart.max():.3f} mm",
                flush=True,
            )


def main(words: list[str]) -> None:
    """A disk pushed away, behaviours, closing, time steps."""
    number, seed = (int(words[0]) if words else 200), (int(words[1]) if len(words) > 1 else 20261126)
    pushed_away()
    behaviours(seed)
    for name in CASES:
        closing(name, number, seed)
    steps(max(4, number // 10), seed)


if __name__ == "__main__":
    main(sys.argv[1:])
