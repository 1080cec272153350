"""Fingers that squeeze a caught disk neither crush it nor let it creep, and what is called caged cannot be shaken out."""

from __future__ import annotations

from math import acos, pi, sin

import numpy as np
import pytest

from palmar.models.case_file import parse_case
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.studies.simulate import simulate_start

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

from palmar.worlds.mujoco.world import MujocoWorld, bed_world, mujoco_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_rate_deg_s = 40\n"
THICK = 'finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK, SMALL = "[object]\nradius_mm = 38\n", "[object]\nradius_mm = 20\n"
SLIPPERY = "[contact]\nfriction = 0\n[support]\nfriction = 0.02\n"
REST = Command((0.0, 0.0), (0.0, 0.0))


def deepest(world: MujocoWorld) -> float:
    pressed = (world.data.contact.geom == world.model.geom("outline").id).any(axis=1)
    return max(0.0, -float(world.data.contact.dist[pressed].min(initial=0.0)))


@pytest.mark.parametrize(
    ("text", "start", "outcome", "creep"),
    [
        (THICK + "open_deg = 90\n" + SMALL, (0.01, 0.05), Outcome.CAGED, 1e-5),
        ("open_deg = 60\n" + DISK, (0.05, 0.15), Outcome.FRICTIONAL, 2e-4),
        ("open_deg = 70\n" + DISK + "[contact]\nfriction = 0\n", (0.0, 0.12), Outcome.STRUCTURAL, 1e-5),
    ],
    ids=["caged", "pinched", "without friction"],
)
def test_a_hold_of_ten_seconds(text: str, start: tuple[float, float], outcome: Outcome, creep: float) -> None:
    case = parse_case(HAND + text)
    planar, world = simulate_start(case, start), mujoco_world(case, (*start, 0.0))
    rate = case.hand.finger_rate
    closing = Command((rate, 0.0), (rate, 0.0))
    while not all(world.observe().stalled):
        world.act(closing, 0.02)
    assert world.outcome() is planar.outcome is outcome
    world.act(closing, 0.5)
    before, depth = np.array(world.pose), deepest(world)
    world.act(closing, 10.0)
    assert np.abs(np.array(world.pose) - before)[:2].max() < creep
    assert deepest(world) < max(1.5 * depth, 2e-5) and depth < 1e-4
    assert world.outcome() is outcome


@pytest.mark.parametrize("share", [0.93, 1.07])
def test_caged_is_what_cannot_be_shaken_out(share: float) -> None:
    """Between fingers that stand still, their tips ``share`` diameters apart."""
    case = parse_case(HAND + THICK + SMALL + SLIPPERY)
    hand, radius = case.hand, 0.02
    angle = acos((share * radius + hand.half_thickness - hand.half_palm) / hand.finger_length)
    world = mujoco_world(case, (0.0, 0.12, 0.0))
    world.servos.place(((angle, 0.0), (angle, 0.0)))
    world.judge.see(world.pose, (0.0, 0.0))
    caged = world.judge.outcome(world.servos.angles, (False, False), True) is Outcome.CAGED
    assert caged == (share < 1.0)
    rng = np.random.default_rng(3)
    for k in range(20):
        way = rng.uniform(0.0, 2.0 * pi) if k < 8 else 0.5 * pi + rng.uniform(-0.6, 0.6)
        world.data.qfrc_applied[world.first : world.first + 2] = np.cos(way), np.sin(way)
        world.act(REST, 0.1)
    assert (world.pose[1] < hand.finger_length * sin(angle)) == caged


def test_the_beds_servos_cage_as_the_kernels_have_it() -> None:
    case = parse_case(HAND.replace("= 40", "= 20") + THICK + "open_deg = 95\n" + SMALL)
    world = bed_world(case, (0.01, 0.05, 0.0))
    rate = case.hand.finger_rate
    while not all(world.observe().stalled):
        world.act(Command((rate, 0.0), (rate, 0.0)), 0.02)
    assert world.outcome() is simulate_start(case, (0.01, 0.05)).outcome is Outcome.CAGED
