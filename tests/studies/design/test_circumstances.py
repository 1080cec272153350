"""All circumstances at once against each of them alone."""

import numpy as np
import pytest

from palmar.models.design_brief_file import open_brief, parse_brief
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.outcome import Outcome
from palmar.studies.design.certificate import certified
from palmar.studies.design.circumstances import STRAIGHT, Circumstances, case_of
from palmar.studies.design.curled import curling
from palmar.studies.design.tolerance import tolerance
from palmar.studies.design.verify import verify
from palmar.studies.simulate import simulate_starts

FREE = open_brief("free_catch")[1]
TABLE = open_brief("table_parts")[1]
BAR = (
    "[targets]\nvertices_mm = [[-30.3, -20.2], [30.3, -20.2], [30.3, 20.2], [-30.3, 20.2]]\n"
    'friction = "1..1.5"\nerror_mm = 15\n[limits]\nmargin = 0\n'
)


def alone(case, places, turn=0.0):
    return simulate_starts(case, np.column_stack([places, np.full(len(places), turn)])).codes <= Outcome.CAGED.code


def test_free_disks_are_asked_about_at_three_restitutions():
    """None of which decides alone."""
    hand = FREE.limits.hand(0.05, (0.08,))
    places = np.random.default_rng(2).uniform((-0.03, 0.036), (0.03, 0.08), (1500, 2))
    by_restitution = {
        e: np.all(
            [alone(case_of(FREE, hand, Disk(radius=r), 0.0, e), places) for r in np.linspace(*FREE.held, 3)], axis=0
        )
        for e in (0.3, 0.6, 0.9)
    }
    together = np.all(list(by_restitution.values()), axis=0)
    assert np.array_equal(Circumstances(FREE, hand).caught(places), together)
    assert all(held.sum() > together.sum() for held in by_restitution.values())


def test_orientations_that_are_alike_are_asked_about_once_at_the_least_and_the_most_friction():
    brief = parse_brief(BAR)
    hand = brief.limits.hand(0.015, (0.06,))
    asked = Circumstances(brief, hand)
    assert asked.mirrored
    turns = np.radians(np.arange(0.0, 360.0, 15.0))
    places = np.random.default_rng(1).uniform((-0.03, 0.037), (0.03, 0.085), (120, 2))
    bar = ConvexPolygon(shape="polygon", vertices=brief.targets.vertices)
    held = {
        friction: np.all([alone(case_of(brief, hand, bar, friction), places, turn) for turn in turns], axis=0)
        for friction in (1.0, 1.5)
    }
    assert np.array_equal(asked.caught(places), held[1.0] & held[1.5])
    assert (held[1.0] & ~held[1.5]).any()


def test_a_circle_is_as_large_as_its_nearest_loss():
    hand = FREE.limits.hand(0.04, (0.0665,))
    asked, place = Circumstances(FREE, hand), (0.0, 0.0505)
    radius = asked.circle(place, 0.02)
    far = np.hypot(*(asked.boundary(place, 0.02) - place).T)
    assert far.min() == pytest.approx(radius, abs=0.02 / 2**7)
    assert far.max() > 1.05 * radius


def test_what_is_certified_is_about_the_place_told():
    hand = FREE.limits.hand(0.04, (0.0665,))
    at, aside = (certified(FREE, hand, (0.0, y), STRAIGHT)[0] for y in (0.0505, 0.0535))
    assert at == pytest.approx(0.0153, abs=3e-4)
    assert aside == pytest.approx(at - 0.003, abs=1e-3)


def test_curled_fingers_catch_what_straight_ones_of_that_length_lose():
    """By the closing that a case names, in the search and in the trial."""
    hand, does = TABLE.limits.hand(0.0001, (0.0757, 0.0113)), curling(np.radians(20.0))
    found = tolerance(TABLE, hand, does)
    assert found.radius == pytest.approx(0.0203, abs=3e-4)
    assert verify(TABLE, hand, found.place, 3000, 0, does).violations == 0
    assert verify(TABLE, hand, found.place, 5000, 0).violations > 0
    assert tolerance(TABLE, hand).radius < 0.01


def test_a_tolerance_that_is_beaten_is_not_worked_out():
    hand, does = TABLE.limits.hand(0.0001, (0.0757, 0.0113)), curling(np.radians(20.0))
    told = tolerance(TABLE, hand, does, beaten=0.025)
    assert told.radius <= 0.025
    assert told.place is None
