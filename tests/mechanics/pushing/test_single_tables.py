"""Tables of single contacts against Newton's method, and starts carried with them against starts carried without."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing import closing_steps
from palmar.mechanics.pushing.closing_motion import NONE, bench, mode_twist
from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, carry_all
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.polygon_contacts import END, VERTEX, contact_code, disk_body, polygon_body
from palmar.mechanics.pushing.single_contact import in_tables, single_twist
from palmar.mechanics.pushing.single_tables import single_tables, tabulated

FRICTION = 0.4
SHAPES = {
    "square": [(0.03, -0.03), (0.03, 0.03), (-0.03, 0.03), (-0.03, -0.03)],
    "triangle": [(0.045, 0.0), (-0.0225, 0.039), (-0.0225, -0.039)],
}
MODES = {"sticks": (0, 1, NONE), "slides left": (0, NONE, NONE), "slides right": (1, NONE, NONE)}


@compiled
def _in_tables(body, at):
    return in_tables(body, at, 1)


@compiled
def _looked_up(body, at, speed):
    return single_twist(body, at, speed)


@compiled
def _solved(body, at, speed, x, y, w):
    return mode_twist(body, at, 1, speed, (x, y, w))


def _write(at, body, rng, kind):
    """A contact of a random corner, or of a fingertip with an edge, pushed into the body in a random direction."""
    i = int(rng.integers(len(body.vertices)))
    ex, ey, length = body.edges[i]
    place, normal = body.vertices[i], np.array([-ey, ex])
    if kind == END:
        place = place + rng.uniform(0.0, 1.0) * length * np.array([ex, ey])
    else:
        turn = rng.uniform(0.0, 1.0)  # between the normals of the two edges that meet there
        before = body.edges[i - 1]
        normal = turn * normal + (1.0 - turn) * np.array([-before[1], before[0]])
        normal /= np.hypot(*normal)
    angle = rng.uniform(-1.2, 1.2)
    c, s = np.cos(angle), np.sin(angle)
    push = 0.2 * np.array([c * normal[0] - s * normal[1], s * normal[0] + c * normal[1]])
    at.contacts[0] = [*place, *normal, *push, body.friction]
    at.active[0] = contact_code(1, kind, i)
    at.frame[:2] = 1.0, 0.0


@pytest.mark.parametrize("mode", list(MODES))
@pytest.mark.parametrize("kind", [VERTEX, END])
@pytest.mark.parametrize("shape", list(SHAPES))
def test_tables_agree_with_newton(shape, kind, mode):
    body, at, rng = tabulated(polygon_body(SHAPES[shape], FRICTION)), bench(0), np.random.default_rng(7)
    compared = 0
    for _ in range(300):
        _write(at, body, rng, kind)
        at.edges[:] = MODES[mode]
        assert _in_tables(body, at) == (kind == VERTEX or mode != "sticks")
        if not _in_tables(body, at):
            continue
        reached, margin = _looked_up(body, at, 0.3)
        if not reached:
            continue
        found = at.space.motions[0, :3].copy()
        at.frame[2:] = -1.0, 0.0
        moves, exact = _solved(body, at, 0.3, *found)
        assert moves
        apart = (found - at.space.motions[0, :3]) * [1.0, 1.0, body.reach]
        assert np.abs(apart).max() <= 1e-5 * np.abs(found * [1.0, 1.0, body.reach]).max()
        assert (margin > 0.0) == (exact > 0.0) or abs(exact) <= 1e-4
        compared += 1
    assert compared >= 250 or kind == END


def test_tables_are_kept_and_only_for_uniform_polygons():
    body = polygon_body(SHAPES["square"], FRICTION)
    assert single_tables(body.surface, body.vertices, FRICTION) is tabulated(body).single
    assert len(tabulated(disk_body(0.03, FRICTION)).single) == 0


@pytest.mark.parametrize("friction", [0.0, 0.7])
@pytest.mark.parametrize("half_thickness", [0.0, 0.0125])
def test_starts_end_as_without_tables(friction, half_thickness, monkeypatch):
    motion = hand_motion(0.06, [0.244], half_thickness)
    body = polygon_body(SHAPES["square"], friction)
    starts = np.random.default_rng(5).uniform([-0.25, 0.06, 0.0], [0.25, 0.25, 2.0 * pi], (200, 3))
    codes, ends, _ = carry_all(motion, body, starts, BATCH_TOLERANCE)
    monkeypatch.setattr(closing_steps, "MANY_STARTS", 1)
    other_codes, other_ends, _ = carry_all(motion, body, starts, BATCH_TOLERANCE)
    assert np.array_equal(codes, other_codes)
    held = codes <= 1
    assert np.abs(ends - other_ends)[held, :2].max() <= 1e-4
    assert np.median(np.abs(ends - other_ends)[held, :2]) <= 1e-6
