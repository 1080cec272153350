"""A design put to the test: random objects, circumstances and starts, carried by kernels that the search did not rest on.

Starts are uniform over the circle of the error, a quarter of them on its rim; every group of starts has its own radius,
friction and restitution, drawn from the ranges of the brief, every tenth one with each at an end of its range. Where only
the hold counts, a posture is looked for in which the fingers touch the disk high enough; for polygons the orientations that
are held are computed anew at the friction drawn.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product
from math import atan, pi, tau

import numpy as np
from numpy.typing import NDArray

from palmar.mechanics.closure.closing_links import ClosingLinks, LimitedHand
from palmar.mechanics.closure.orientation_set import contains
from palmar.mechanics.closure.polygon_orientations import frictional_orientations, structural_orientations
from palmar.models.behaviour import Behaviour
from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.outcome import Outcome
from palmar.studies.design.circumstances import STRAIGHT, case_of
from palmar.studies.design.felt import plan_for
from palmar.studies.design.tolerance import Place
from palmar.studies.plan import Plan
from palmar.studies.plan_trial import Errors, try_plan
from palmar.studies.simulate import simulate_starts

Floats = NDArray[np.float64]
GROUP, FELT_GROUP = 500, 2500
"""Starts of one object."""
AT_ENDS = 10
ROUNDING = 1e-8


@dataclass(frozen=True)
class Verification:
    """Cases tried, and those in which the object was not held; the circumstances of the first few of these, in words."""

    cases: int
    violations: int
    examples: tuple[str, ...] = ()


def verify(
    brief: DesignBrief, hand: Hand, place: Place | None, cases: int, seed: int, does: Behaviour = STRAIGHT
) -> Verification:
    """Try ``cases`` random cases of the brief's ranges, without its margin; ``place`` (m): the middle of the starts.

    The hand closes as ``does`` says; with sensors, by its plan.
    """
    rng = np.random.default_rng(seed)
    if place is None:
        return _held_polygon(brief, hand, cases, rng) if brief.targets.vertices else _held(brief, hand, cases, rng)
    felt = None if brief.targets.sensors is None else plan_for(brief, hand)
    group = GROUP if felt is None else FELT_GROUP
    found = Verification(0, 0)
    for number, size in enumerate(_sizes(cases, group)):
        friction = _drawn(brief.targets.friction, number, rng)
        starts = np.array(place) + _within(brief.targets.error, size, rng)
        if felt is not None:
            lost, what = _lost_by_plan(brief, hand, felt, friction, starts, number, rng)
        else:
            lost, what = _lost(brief, hand, does, friction, starts, number, rng)
        examples = (*found.examples, *([what] if lost else []))[:5]
        found = Verification(found.cases + size, found.violations + lost, examples)
    return found


def _lost(
    brief: DesignBrief, hand: Hand, does: Behaviour, friction: float, starts: Floats, number: int,
    rng: np.random.Generator,
) -> tuple[int, str]:  # fmt: skip
    """Of one group of starts: how many are not caught, and the circumstances."""
    targets, turns = brief.targets, np.zeros(len(starts))
    restitution = _drawn(targets.restitution, number, rng)
    thing: Disk | ConvexPolygon
    if targets.radii is not None:
        thing = Disk(radius=_drawn(targets.radii, number, rng))
        what = f"radius {1e3 * thing.radius:.4g} mm, friction {friction:.4g}, restitution {restitution:.4g}"
    else:
        assert targets.vertices is not None
        thing, turns = ConvexPolygon(shape="polygon", vertices=targets.vertices), rng.uniform(0.0, tau, len(starts))
        what = f"friction {friction:.4g}"
    case = case_of(brief, hand, thing, friction, restitution, does)
    codes = simulate_starts(case, np.column_stack([starts, turns])).codes
    return int((codes > Outcome.CAGED.code).sum()), what


def _lost_by_plan(
    brief: DesignBrief, hand: Hand, found: Plan, friction: float, starts: Floats, number: int, rng: np.random.Generator
) -> tuple[int, str]:
    """By the one policy planned for the least friction and all radii, at those drawn."""
    assert brief.targets.radii is not None
    radius = _drawn(brief.targets.radii, number, rng)
    case = case_of(brief, hand, Disk(radius=radius), friction)
    errors = Errors(found.doubt.displacement, found.doubt.pose_error)
    trial = try_plan(case, found.found.policy, found.stretches, starts, errors)
    return trial.starts - trial.caught, f"radius {1e3 * radius:.4g} mm, friction {friction:.4g}"


def _held(brief: DesignBrief, hand: Hand, cases: int, rng: np.random.Generator) -> Verification:
    """Whether the fingers, links touching or staying straight one after the other, come to touch high enough."""
    assert brief.targets.radii is not None
    radius = rng.uniform(*brief.targets.radii, cases)
    alpha = np.arctan(rng.uniform(*brief.targets.friction, cases))
    held = _postures_hold(hand, radius, alpha)
    lost = np.flatnonzero(~held)
    words = [f"radius {1e3 * radius[k]:.4g} mm, friction {np.tan(alpha[k]):.4g}" for k in lost[:5]]
    return Verification(cases, len(lost), tuple(words))


def _postures_hold(hand: Hand, radius: Floats, alpha: Floats) -> NDArray[np.bool_]:
    links = hand.finger_links
    limits = ((0.0, pi), *[(-pi, pi)] * (len(links) - 1))
    bent = LimitedHand(
        hand.half_palm, links, limits, 0.0, hand.half_thickness, crossing=hand.fingers is Fingers.CROSSING
    )
    held = np.zeros(len(radius), np.bool_)
    for last in range(1, len(links) + 1):
        for touching in product((True, False), repeat=last - 1):
            left = np.flatnonzero(~held)
            finger = ClosingLinks(bent, radius[left] + hand.half_thickness, radius[left])
            margin = np.full(len(left), np.inf)
            for touches in touching:
                if touches:
                    finger.touch()
                else:
                    finger.stay_clear(None)
                margin = np.minimum(margin, finger.margin)
            elevation = finger.touch()
            margin = np.minimum(margin, finger.margin)
            margin = np.minimum(margin, np.minimum(elevation, pi - elevation) + alpha[left])
            held[left] |= margin >= -ROUNDING
    return held | _pinched(hand, radius, alpha)


def _pinched(hand: Hand, radius: Floats, alpha: Floats) -> NDArray[np.bool_]:
    """Whether straight fingers that lean out by alpha press on a disk off the palm at -alpha."""
    rho, sine = radius + hand.half_thickness, np.maximum(np.sin(alpha), ROUNDING)
    along = (rho * np.cos(alpha) - hand.half_palm) / sine
    height = along * np.cos(alpha) + rho * np.sin(alpha)
    reached = (along > 0.0) & (along <= hand.finger_length * (1.0 + ROUNDING))
    return reached & (height >= radius * (1.0 - ROUNDING)) & (alpha > 0.0)


def _held_polygon(brief: DesignBrief, hand: Hand, cases: int, rng: np.random.Generator) -> Verification:
    vertices = np.array(brief.targets.vertices)
    found = Verification(0, 0)
    for number, size in enumerate(_sizes(cases, GROUP)):
        friction = _drawn(brief.targets.friction, number, rng)
        held = orientations_held(vertices, hand, atan(friction))
        lost = int((~contains(held, rng.uniform(0.0, tau, size))).sum())
        examples = (*found.examples, *([f"friction {friction:.4g}"] if lost else []))[:5]
        found = replace(found, cases=found.cases + size, violations=found.violations + lost, examples=examples)
    return found


def orientations_held(vertices: Floats, hand: Hand, alpha: float) -> Floats:
    """Intervals (N, 2) of orientations (rad) at which straight fingers hold a polygon."""
    size = hand.half_palm, hand.finger_length
    if alpha > 0.0:
        return frictional_orientations(vertices, *size, alpha, hand.half_thickness)
    return structural_orientations(vertices, *size, hand.half_thickness)


def _sizes(cases: int, group: int) -> list[int]:
    return [min(group, cases - first) for first in range(0, cases, group)]


def _drawn(span: tuple[float, float], number: int, rng: np.random.Generator) -> float:
    """A value of a range; in every tenth group one of its ends."""
    value = float(rng.uniform(*span))
    return span[int(rng.integers(2))] if number % AT_ENDS == 0 else value


def _within(radius: float, count: int, rng: np.random.Generator) -> Floats:
    """Shifts (N, 2), m, uniform over a circle, a quarter of them on its rim."""
    angle = rng.uniform(0.0, tau, count)
    far = radius * np.where(np.arange(count) % 4 == 0, 1.0, np.sqrt(rng.uniform(size=count)))
    return np.stack([far * np.cos(angle), far * np.sin(angle)], axis=1)
