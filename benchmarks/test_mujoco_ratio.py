"""One question put to MuJoCo's rollouts and to palmar's kernels: from which of these starts is the disk caught?

MuJoCo's disk is a sphere on planar joints, pressed to the floor by its weight, with one contact of torsional friction:
the ellipsoidal limit surface. The fingers are thin capsules driven at a slow rate with a bounded torque. What is caught
is read off the fingers: something keeps both from closing all the way, or lies in the pocket behind narrower tips.
"""

from __future__ import annotations

import os
import time
from math import pi, radians

import numpy as np
import pytest

from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_end import in_pocket, opening
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, hand_motion, place_links
from palmar.mechanics.pushing.limit_surface import ellipsoid_surface
from palmar.mechanics.pushing.polygon_contacts import disk_body
from palmar.models.outcome import Outcome

mujoco = pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

HALF_PALM, LENGTH, RADIUS, THIN, FLOOR = 0.06, 0.244, 0.038, 0.0005, 0.4
RATE = radians(20.0)
STEP = 0.004
"""Largest that still answers as shorter ones do (1, 2, 4 ms tried)."""
STARTS = 96
MOTION = hand_motion(HALF_PALM, [LENGTH], THIN)


def model_of(friction: float, step: float) -> mujoco.MjModel:
    """The hand, the disk and the floor; only the pairs named here touch."""
    slip = f"{friction} {friction} 0 0 0" if friction else "0 0 0 0 0"
    turn = 2.0 / 3.0 * FLOOR * RADIUS
    pairs = "".join(
        f'<pair geom1="{each}" geom2="disk" condim="{3 if friction else 1}" friction="{slip}"/>'
        for each in ("palm", "right", "left")
    )
    fingers = "".join(
        f'<body pos="{side * HALF_PALM} 0 {RADIUS}"><joint name="{name}" axis="0 0 {side}" range="0 3.1416"'
        f' limited="true" armature="0.02" damping="0.001"/><geom name="{name}" type="capsule" size="{THIN}" mass="0.05"'
        f' fromto="0 0 0 {side * LENGTH} 0 0"/></body>'
        for name, side in (("right", 1), ("left", -1))
    )
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><compiler angle="radian"/>
        <option timestep="{step}" cone="elliptic" impratio="10" integrator="implicitfast"/>
        <default><geom contype="0" conaffinity="0"/><pair solref="0.006 1"/></default>
        <worldbody><geom name="floor" type="plane" size="1 1 0.1"/>
        <geom name="palm" type="capsule" size="{THIN}" fromto="{-HALF_PALM} {-THIN} {RADIUS} {HALF_PALM} {-THIN} {RADIUS}"/>
        {fingers}
        <body pos="0 0 {RADIUS}"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
        <joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 0 1"/>
        <geom name="disk" type="sphere" size="{RADIUS}" mass="0.2"/></body></worldbody>
        <contact><pair geom1="floor" geom2="disk" condim="4" friction="{FLOOR} {FLOOR} {turn} 0 0"/>{pairs}</contact>
        <actuator><velocity joint="right" kv="10" forcerange="-1 1"/><velocity joint="left" kv="10" forcerange="-1 1"/>
        </actuator></mujoco>"""
    )


def rollouts(friction: float, starts: np.ndarray, step: float) -> np.ndarray:
    """Whether MuJoCo catches the disk from each start."""
    from mujoco import rollout

    model = model_of(friction, step)
    data = [mujoco.MjData(model) for _ in range(os.cpu_count() or 1)]
    full = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.zeros((len(starts), mujoco.mj_stateSize(model, full)))
    state[:, 3:5] = starts  # time, then two fingers, then the disk's x and y
    steps = int(1.02 * pi / RATE / step)
    control = np.full((len(starts), steps, 2), RATE)
    states, _ = rollout.rollout(model, data, initial_state=state, control=control, nstep=steps)
    last = states[:, -1]
    rows = np.zeros((3, LINK_WIDTH))
    caught = np.zeros(len(starts), dtype=bool)
    for k, (right, left, x, y) in enumerate(last[:, 1:5]):
        place_links(MOTION, right, right, left, rows)
        behind = in_pocket(rows, 1, x, y) and opening(rows, 1) < 2.0 * RADIUS
        caught[k] = behind or max(right, left) < pi - 0.1
    return caught


def is_caught(codes: np.ndarray) -> np.ndarray:
    return np.isin(codes, [each.code for each in Outcome if each.caught])


@pytest.mark.parametrize("friction", [0.0, 0.7])
def test_ratio_of_starts_per_second(benchmark, friction):
    starts = np.random.default_rng(3).uniform([-0.3, 0.045], [0.3, 0.28], (STARTS, 2))
    many = np.random.default_rng(4).uniform([-0.3, 0.045], [0.3, 0.28], (200_000, 2))
    surface = ellipsoid_surface(2.0 / 3.0 * RADIUS)
    hand = ClosingHand(HALF_PALM, LENGTH, 0.0, RADIUS, friction, 0.0, pi)
    tables = build_tables(hand, surface)
    body = disk_body(RADIUS, friction, surface)
    close_disk(hand, surface, many[:1000], tables)
    carry_all(MOTION, body, many[:10])

    begin = time.perf_counter()
    simulated = benchmark.pedantic(rollouts, (friction, starts, STEP), rounds=1)
    simulated_rate = STARTS / (time.perf_counter() - begin)
    begin = time.perf_counter()
    close_disk(hand, surface, many, tables)
    disk_rate = len(many) / (time.perf_counter() - begin)
    begin = time.perf_counter()
    carry_all(MOTION, body, many[:4000])
    step_rate = 4000 / (time.perf_counter() - begin)

    codes = carry_all(MOTION, body, np.column_stack([starts, np.zeros(STARTS)]))[0]
    same = float(np.mean(is_caught(codes) == simulated))
    benchmark.extra_info.update(
        mujoco_starts_per_second=round(simulated_rate, 1),
        disk_kernel_starts_per_second=round(disk_rate),
        stepping_kernel_starts_per_second=round(step_rate),
        ratio_disk_kernel=round(disk_rate / simulated_rate),
        ratio_stepping_kernel=round(step_rate / simulated_rate),
        same_outcome=same,
    )
    print(benchmark.extra_info)
    assert same >= 0.95
