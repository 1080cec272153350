"""Holds in MuJoCo: fingers that squeeze a caught disk for ten seconds, and shaken disks that the judge calls caged.

    python3 dev.py validate hold [SHAKES [SEED]]

For each hand the disk is caught, and the fingers are told to go on closing for HOLD: how far the disk creeps, how deep a
contact goes, and whether the outcome stays. Then disks lie between fingers that stand still, and are pushed about, at
first in random directions, then outwards: the judge's verdict, caged or not, against whether the disk gets out. The push is
gentle, for a servo is a spring: a disk that is wedged between two fingers pushes them apart with many times that.
"""

from __future__ import annotations

import sys
from math import acos, cos, pi, sin

import numpy as np

from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.motion import Command
from palmar.models.outcome import Outcome
from palmar.worlds.mujoco.world import MujocoWorld, bed_world, mujoco_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\nfinger_rate_deg_s = 15\nopen_deg = 20\n"
THICK = 'finger_thickness_mm = 25\nfingers = "colliding"\n'
DISK, SMALL, SLIP = "[object]\nradius_mm = 38\n", "[object]\nradius_mm = 20\n", "[contact]\nfriction = 0\n"
HOLDS = {
    "disk, line fingers": (HAND + DISK, (0.1, 0.12), False),
    "disk, line fingers, no friction": (HAND + DISK + SLIP, (0.0, 0.12), False),
    "disk, thick fingers": (HAND + THICK + DISK, (0.15, 0.12), False),
    "disk, thick fingers, the bed's servos": (HAND + THICK + DISK, (0.15, 0.12), True),
    "20 mm disk, thick fingers that meet": (HAND + THICK + SMALL, (0.05, 0.08), False),
    "20 mm disk, thick fingers, the bed's servos": (HAND + THICK + SMALL, (0.05, 0.08), True),
    "20 mm disk, line fingers that squeeze": (HAND + SMALL, (0.05, 0.08), False),
}
HOLD, SHAKE, PUSH = 10.0, 2.0, 1.0
"""Seconds of holding and of shaking; push (N) on a disk of 1 kg, five times its friction with the table."""
SHARES = (0.85, 0.95, 1.05, 1.15)
"""Gaps between the tips, in diameters of the disk."""


def deepest(world: MujocoWorld) -> float:
    """How far (m) the object is pressed into the hand."""
    thing = world.model.geom("outline").id
    found = [
        float(distance)
        for pair, distance in zip(world.data.contact.geom, world.data.contact.dist, strict=True)
        if thing in pair
    ]
    return max(0.0, -min(found, default=0.0))


def hold(name: str) -> None:
    """Catch, squeeze, and tell what has changed."""
    text, start, bed = HOLDS[name]
    case = parse_case(text, name)
    world = (bed_world if bed else mujoco_world)(case, (*start, 0.0))
    rate = case.hand.finger_rate
    closing = Command((rate, 0.0), (rate, 0.0))
    while not all(world.observe().stalled) and world.time < 30.0:
        world.act(closing, 0.02)
    first, pose, depth = world.outcome(), np.array(world.pose), deepest(world)
    world.act(closing, 1.0)
    settled, most = np.array(world.pose), depth
    for _ in range(round(HOLD / 0.1)):
        world.act(closing, 0.1)
        most = max(most, deepest(world))
    creep = np.array(world.pose) - settled
    print(
        f"{name}: {first.value} at {world.time - HOLD - 1.0:.1f} s, {1e3 * np.hypot(*(settled - pose)[:2]):.3f} mm in the"
        f" first second; then in {HOLD:g} s {1e3 * np.hypot(*creep[:2]):.4f} mm and {np.degrees(creep[2]):+.4f} deg;"
        f" deepest contact {1e3 * depth:.3f} mm at first, {1e3 * most:.3f} mm at most; {world.outcome().value}",
        flush=True,
    )


def gap_angle(case: Case, gap: float) -> float:
    """The angle (rad) of both fingers, leaning inwards, at which their tips are ``gap`` apart (m)."""
    hand = case.hand
    return acos((0.5 * gap + hand.half_thickness - hand.half_palm) / hand.finger_length)


def shaken(case: Case, share: float, seed: int) -> tuple[bool, bool]:
    """Whether the judge calls the disk caged with a gap of ``share`` diameters, and whether shaking gets it out."""
    radius, straight = case.object.radius, (0.0,) * (len(case.hand.finger_links) - 1)
    world = mujoco_world(case, (0.0, case.hand.half_thickness + radius + 0.02, 0.0))
    angle = gap_angle(case, share * 2.0 * radius)
    rest = Command((0.0, *straight), (0.0, *straight))
    world.servos.place(((angle, *straight), (angle, *straight)))
    world.servos.tell((rest.right, rest.left), (0.0, 0.0))
    world.judge.see(world.pose, (0.0, 0.0))
    caged = world.judge.outcome(world.servos.angles, (False, False), True) is Outcome.CAGED
    push, rng = world.data.qfrc_applied[world.first : world.first + 2], np.random.default_rng(seed)
    out = case.hand.finger_length * sin(angle) + 2.0 * radius
    for k in range(round(2.0 * SHAKE / 0.1)):
        way = rng.uniform(0.0, 2.0 * pi) if k < SHAKE / 0.1 else 0.5 * pi + rng.uniform(-0.6, 0.6)
        push[:] = PUSH * cos(way), PUSH * sin(way)
        world.act(rest, 0.1)
        if world.pose[1] > out:
            return caged, True
    return caged, False


def main(words: list[str]) -> None:
    """Holds, then shakes."""
    number, seed = (int(words[0]) if words else 5), (int(words[1]) if len(words) > 1 else 20261126)
    for name in HOLDS:
        hold(name)
    for radius in (20.0, 38.0):
        for fingers in (THICK, ""):
            case = parse_case(HAND + fingers + f"[object]\nradius_mm = {radius}\n{SLIP}[support]\nfriction = 0.02\n")
            for share in SHARES:
                found = [shaken(case, share, seed + k) for k in range(number)]
                print(
                    f"{radius:g} mm disk, {'thick' if fingers else 'line'} fingers, gap of {share:g} diameters: caged"
                    f" {sum(each for each, _ in found)} of {number}, got out {sum(each for _, each in found)}",
                    flush=True,
                )


if __name__ == "__main__":
    main(sys.argv[1:])
