"""What is certain without mechanics: against simulation at any friction, and by hand."""

from math import acos, cos, pi, sin

import numpy as np
import pytest
import shapely

from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.polygon_contacts import polygon_body
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.outcome import Outcome
from palmar.regions.caging_core import caging_core

HAND = Hand(palm_width=0.2, finger_links=(0.244,))
BAR = ConvexPolygon(shape="polygon", vertices=((-0.03, -0.012), (0.03, -0.012), (0.03, 0.012), (-0.03, 0.012)))
OFFSET = ConvexPolygon(shape="polygon", vertices=((0.0, 0.0), (0.04, 0.0), (0.04, 0.03), (0.0, 0.03)))


def random_places(area, count, seed):
    rng = np.random.default_rng(seed)
    left, low, right, high = area.bounds
    tried = np.column_stack([rng.uniform(left, right, 20 * count), rng.uniform(low, high, 20 * count)])
    return tried[shapely.contains_xy(area, tried)][:count]


def test_a_disk_lies_between_the_fingers_when_they_cage_it():
    core = caging_core(HAND, Disk(radius=0.03), pi, 0.0, 0.0)
    psi = acos((0.03 - 0.1) / 0.244)
    left, low, right, top = core.bounds
    assert (left, low) == (pytest.approx(-right), pytest.approx(0.03, rel=2e-3))
    # On the palm line the finger at psi is nearest: its line stands at D + y cot psi, R / sin psi beyond the disk.
    assert right == pytest.approx(0.1 + 0.03 * cos(psi) / sin(psi) - 0.03 / sin(psi), rel=5e-3)
    assert top < 0.244 * sin(psi)


@pytest.mark.parametrize("thing", [BAR, OFFSET])
@pytest.mark.parametrize("friction", [0.0, 0.4, 1.5])
def test_nothing_in_it_is_lost_at_any_friction(thing, friction):
    low, high = 0.3, 0.6
    core = caging_core(HAND, thing, pi, low, high)
    assert core.area > 1e-4
    vertices = np.array(thing.vertices)
    middle = vertices.mean(axis=0)
    body = polygon_body(vertices - middle, friction)
    for theta in (low, 0.5 * (low + high), high):
        turn = np.array([[cos(theta), -sin(theta)], [sin(theta), cos(theta)]])
        places = random_places(core, 60, 1) + turn @ middle
        codes, _, _ = carry_all(straight_motion(HAND), body, np.column_stack([places, np.full(len(places), theta)]))
        assert (codes <= Outcome.CAGED.code).all()


def test_more_orientations_leave_less():
    one, some = (caging_core(HAND, BAR, pi, 0.0, high) for high in (0.0, 0.7))
    assert one.buffer(1e-9).contains(some)
    assert 0.0 < some.area < one.area


def test_where_no_cage_closes_nothing_is_certain():
    wide = Hand(palm_width=0.6, finger_links=(0.244,))
    assert caging_core(wide, BAR, pi, 0.0, 0.0).is_empty
    assert caging_core(HAND, BAR, 1.2, 0.0, 0.0).is_empty


def test_thick_fingers_leave_less():
    thick = Hand(palm_width=0.2, finger_links=(0.244,), finger_thickness=0.02, fingers=Fingers.COLLIDING)
    assert caging_core(thick, BAR, 3.0, 0.0, 0.0).area < caging_core(HAND, BAR, pi, 0.0, 0.0).area
