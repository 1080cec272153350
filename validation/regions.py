"""Soundness of exact regions, hunted: random starts inside must be caught, outside the outer side must be lost.

    python3 dev.py validate regions [disks|polygons|certified] [STARTS]
    python3 dev.py validate regions balls [HANDS]

Twenty hands and disks (palm wider and narrower than the finger, radii near both limits, frictions 0 to 1, line and thick
fingers, open and half open, with and without joint limits), a million starts inside each region and as many outside;
five polygons at a random orientation each; certified regions of sixteen hands, bent, thick, sliding along, without friction,
half of the starts within a hundredth of the finger of the band. ``balls``: the largest certified balls about random starts
before many hands, with starts on their rims. A seed is fixed; every loss and catch is printed.
"""

from __future__ import annotations

import sys
import time
from math import atan, degrees, pi

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiPolygon

from palmar.geometry.planar_set import areal, uniform_places
from palmar.geometry.straight_finger import last_angle
from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.mechanics.pushing.certified_start import CAUGHT, LOST, certify_all
from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.closing_tables import ClosingHand, build_tables
from palmar.mechanics.pushing.enclosure import closed_from
from palmar.mechanics.pushing.hand_pose import HandMotion, hand_motion
from palmar.mechanics.pushing.limit_surface import disk_surface
from palmar.mechanics.pushing.polygon_contacts import disk_body, polygon_body
from palmar.mechanics.pushing.slider import polygon_slider
from palmar.models.hand import Hand
from palmar.models.objects import ConvexPolygon
from palmar.models.outcome import Outcome
from palmar.regions.caging_core import caging_core
from palmar.regions.certified import certified_sets
from palmar.regions.closing_exact import exact_sets
from palmar.regions.closing_sampled import sampled_sets
from palmar.regions.pushed_core import pushed_core

Floats = NDArray[np.float64]
HANDS, SEED = 20, 20261126


def random_hand(rng: np.random.Generator, number: int) -> ClosingHand:
    """Hands in turn with the palm wider and narrower than the finger, radii near the least, between, near the largest."""
    while True:
        d = rng.uniform(1.0, 1.4) if number % 4 == 0 else rng.uniform(0.15, 1.0)
        h = rng.choice([0.0, rng.uniform(0.0, 0.15)])
        friction = rng.choice([0.0, rng.uniform(0.0, 1.0), 1.0])
        crossing, first = rng.random() < 0.6, rng.choice([0.0, 0.0, rng.uniform(0.0, 1.3)])
        limit = rng.choice([pi, pi, rng.uniform(1.7, pi)])
        options = {"crossing": crossing, "psi_limits": (0.0, limit)}
        alpha = atan(friction)
        radii = frictional_radii(d, 1.0, alpha, h, **options) if alpha else structural_radii(d, 1.0, h, **options)
        low, high = float(radii.min), min(float(radii.max), 1.5)
        if not low < high:
            continue
        place = (0.02, 0.3, 0.7, 0.98)[number // 4 % 4]
        radius = max(low + place * (high - low), 0.01)
        last = float(last_angle(d, 1.0, h, crossing, limit))
        return ClosingHand(d, 1.0, h, radius, float(friction), float(first), last)


def disks(starts: int) -> int:
    """Print losses and catches per hand; returns their number."""
    rng = np.random.default_rng(SEED)
    wrong = 0
    print("palm/finger  radius  thick  friction  open      area  inside  lost  outside  caught  region_ms")
    for number in range(HANDS):
        sets = None
        while sets is None or sets.centre.is_empty:
            hand = random_hand(rng, number)
            surface = disk_surface(hand.radius)
            begin = time.perf_counter()
            tables = build_tables(hand, surface, spin=False)
            sets = exact_sets(hand, tables, 1e-5)
            spent = time.perf_counter() - begin
        reach = hand.half_palm + 1.0 + hand.radius
        inside = uniform_places(sets.centre, starts, rng)
        box = shapely.box(-reach, hand.radius, reach, 1.0 + 2.0 * hand.radius)
        outside = uniform_places(MultiPolygon([box]) - sets.outer.buffer(1e-9), starts, rng)
        lost = int((close_disk(hand, surface, inside, tables).codes > Outcome.CAGED.code).sum())
        caught = int((close_disk(hand, surface, outside, tables).codes <= Outcome.CAGED.code).sum())
        wrong += lost + caught
        print(
            f"{hand.half_palm:11.3f}  {hand.radius:6.3f}  {hand.half_thickness:5.3f}  {hand.friction:8.3f}  "
            f"{degrees(hand.first):4.1f}  {sets.centre.area:8.4f}  {starts}  {lost:4d}  {starts}  {caught:6d}  "
            f"{1e3 * spent:.1f}",
            flush=True,
        )
    return wrong


def regular(corners: int, radius: float) -> Floats:
    """A regular polygon."""
    angles = 2.0 * pi * np.arange(corners) / corners
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


POLYGONS = {
    "square": regular(4, 0.042),
    "rectangle 3:2": np.array([[-0.04, -0.027], [0.04, -0.027], [0.04, 0.027], [-0.04, 0.027]]),
    "triangle": regular(3, 0.045),
    "hexagon": regular(6, 0.04),
    "bar 3:1": np.array([[-0.045, -0.015], [0.045, -0.015], [0.045, 0.015], [-0.045, 0.015]]),
}
SPACING = 0.002


def polygons(starts: int) -> int:
    """The same for polygons before the test-bed hand, friction 0.7: regions by simulated starts, and their certain part."""
    rng = np.random.default_rng(SEED)
    hand, motion = Hand(palm_width=0.12, finger_links=(0.244,)), hand_motion(0.06, [0.244])
    wrong = 0
    print(
        "polygon        theta   area cm2  certain cm2  starts on grid  seconds  inside  lost  outside  caught  in core lost"
    )
    for name, corners in POLYGONS.items():
        theta = float(rng.uniform(0.0, 2.0 * pi))
        body = polygon_body(corners, 0.7)
        begin = time.perf_counter()
        sets = sampled_sets(motion, body, (0.0, 0.0), np.array([theta]), SPACING)
        spent = time.perf_counter() - begin
        thing = ConvexPolygon(shape="polygon", vertices=tuple(map(tuple, corners.tolist())))
        pushed = pushed_core(
            hand.half_palm, hand.finger_length, 0.0, motion.last, polygon_slider(corners, (0.0, 0.0)), 0.7
        )
        core = areal(caging_core(hand, thing, motion.last, theta, theta) | pushed)
        box = MultiPolygon([shapely.box(-0.36, 0.0, 0.36, 0.34)])
        counts = []
        for area, good in ((sets.centre, True), (box - sets.outer, False), (core, True)):
            if area.is_empty:
                counts.append(0)
                continue
            number = starts if area is not core else starts // 10
            poses = np.column_stack([uniform_places(area, number, rng), np.full(number, theta)])
            caught = carry_all(motion, body, poses)[0] <= Outcome.CAGED.code
            counts.append(int((caught != good).sum()))
        wrong += sum(counts)
        print(
            f"{name:13s}  {degrees(theta):5.1f}  {1e4 * sets.centre.area:9.1f}  {1e4 * core.area:11.1f}  {sets.starts:14d}  "
            f"{spent:7.2f}  {starts}  {counts[0]:4d}  {starts}  {counts[1]:6d}  {counts[2]}",
            flush=True,
        )
    return wrong


MOTIONS, CLOSE = 16, 0.01


def random_motion(rng: np.random.Generator, number: int) -> tuple[HandMotion, float]:
    """Hands of one to three links in turn, bent inwards or outwards, closing at other rates, thick, sliding; a radius."""
    links = 1 + number % 3
    thick = float(rng.choice([0.0, rng.uniform(0.01, 0.1)]))
    slide = (
        (float(rng.choice([0.0, rng.normal(0.0, 0.15)])), float(rng.normal(0.0, 0.15)))
        if rng.random() < 0.5
        else (0, 0)
    )
    motion = hand_motion(
        float(rng.uniform(0.2, 0.8)),
        rng.dirichlet(np.full(links, 4.0)),
        thick,
        first=float(rng.choice([0.0, rng.uniform(0.0, 0.8)])),
        offsets=rng.uniform(-0.2, 0.6, links - 1),
        ratios=float(rng.choice([0.0, 1.0])) * rng.uniform(-0.1, 0.7, links - 1),
        velocity=slide,
        colliding=bool(rng.random() < 0.5),
    )
    return motion, float(rng.uniform(0.08, 0.4))


def certified(starts: int) -> int:
    """The same for certified regions of any closing motion, judged by the stepping kernel."""
    rng = np.random.default_rng(SEED)
    wrong = number = 0
    print(
        "links  thick  palm  radius  bent (deg)  ratios  slide  area  band  followed  cpu_s  inside  lost  outside  caught"
    )
    while number < MOTIONS:
        motion, radius = random_motion(rng, number)
        begin = time.process_time()
        sets = certified_sets(motion, radius)
        spent = time.process_time() - begin
        if sets.inner.area < 0.05:
            continue
        number += 1
        body, counts = disk_body(radius, 0.0), []
        band = (sets.outer - sets.inner).buffer(CLOSE)
        box = shapely.box(*band.buffer(radius).bounds) - sets.outer
        for whole, good in ((sets.inner, True), (box, False)):
            near = areal(whole & band)
            some = np.concatenate(
                [uniform_places(areal(whole), starts // 2, rng), uniform_places(near, starts - starts // 2, rng)]
            )
            codes = carry_all(motion, body, some)[0]
            told = (codes != Outcome.INVALID.code) & (codes != Outcome.UNDECIDED.code)
            wrongly = told & ((codes <= Outcome.CAGED.code) != good)
            counts.append(int(wrongly.sum()))
            for x, y in some[wrongly][:5]:
                print(f"  promised {good}: ({x!r}, {y!r}) in {motion}, radius {radius!r}")
        wrong += sum(counts)
        print(
            f"{len(motion.links)}  {motion.half_thickness:.3f}  {motion.half_palm:.3f}  {radius:.3f}  "
            f"{np.degrees(motion.offsets[1:]).round(1).tolist()}  {motion.ratios[1:].round(2).tolist()}  "
            f"({motion.vx:.2f}, {motion.vy:.2f})  {sets.inner.area:.4f}  {100.0 * sets.share:.2f} %  {sets.starts}  "
            f"{spent:.2f}  {starts}  {counts[0]}  {starts}  {counts[1]}",
            flush=True,
        )
    return wrong


CENTRES, RIM, HALVINGS = 60, 40, 9


def balls(hands: int) -> int:
    """Starts on the rims of the largest balls certified about random centres; how many break the promise."""
    rng = np.random.default_rng(SEED + 1)
    counts = {CAUGHT: 0, LOST: 0}
    wrong = asked = 0
    for number in range(hands):
        motion, radius = random_motion(rng, number)
        closed, body = closed_from(motion, radius), disk_body(radius, 0.0)
        centres = np.column_stack([rng.uniform(-1.5, 1.5, CENTRES), rng.uniform(0.0, 1.4, CENTRES)])
        low, high, codes = np.zeros(CENTRES), np.full(CENTRES, 0.4), np.zeros(CENTRES, np.int8)
        for _ in range(HALVINGS):
            size = 0.5 * (low + high)
            told = certify_all(motion, radius, closed, np.column_stack([centres, size]))
            good = (told == CAUGHT) | (told == LOST)
            codes[good] = told[good]
            low, high = np.where(good, size, low), np.where(good, high, size)
        for code in (CAUGHT, LOST):
            some = np.flatnonzero(codes == code)
            counts[code] += len(some)
            angle = rng.uniform(0.0, 2.0 * pi, (len(some), RIM))
            rim = centres[some][:, None] + 0.999 * low[some][:, None, None] * np.stack(
                [np.cos(angle), np.sin(angle)], -1
            )
            ends = carry_all(motion, body, rim.reshape(-1, 2))[0]
            told = (ends != Outcome.INVALID.code) & (ends != Outcome.UNDECIDED.code)
            broken = told & ((ends <= Outcome.CAGED.code) != (code == CAUGHT))
            asked, wrong = asked + int(told.sum()), wrong + int(broken.sum())
            for k in np.flatnonzero(broken)[:3]:
                place, centre = rim.reshape(-1, 2)[k], centres[some[k // RIM]]
                print(f"  {code}: {place!r} in the ball about {centre!r}, {motion}, radius {radius!r}")
        if number % 50 == 49:
            told_balls = f"{counts[CAUGHT]} balls caught, {counts[LOST]} lost"
            print(f"{number + 1} hands, {told_balls}, {asked} starts on rims, {wrong} wrong", flush=True)
    return wrong


def main(words: list[str]) -> int:
    """Run what is asked for; the number of wrong promises."""
    which = words[0] if words else "disks"
    number = int(words[1]) if len(words) > 1 else (300 if which == "balls" else 1_000_000)
    return {"disks": disks, "polygons": polygons, "certified": certified, "balls": balls}[which](number)


if __name__ == "__main__":
    sys.exit(min(main(sys.argv[1:]), 1))
