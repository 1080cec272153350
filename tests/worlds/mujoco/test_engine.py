"""Before any comparison: friction and time step of the MuJoCo scenes do what is asked of them (impacts: test_impacts)."""

from __future__ import annotations

from functools import partial
from math import hypot

import numpy as np
import pytest

from palmar.mechanics.pushing.limit_surface import (
    LimitSurface,
    disk_surface,
    ellipsoid_surface,
    polygon_surface,
    wrench,
)
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.motion import Command
from palmar.models.outcome import Outcome

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

from palmar.studies.simulate import simulate_start
from palmar.studies.simulate_in_world import simulate_start_in
from palmar.worlds.mujoco.scene import GRAVITY
from palmar.worlds.mujoco.table_friction import TableLaw
from palmar.worlds.mujoco.world import MujocoWorld, mujoco_world

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n"
DISK = "[object]\nradius_mm = 38\nmass_kg = 0.7\n"
BOX = '[object]\nshape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n'
TABLE, RADIUS, FRICTION = "[support]\nfriction = 0.3\n", 0.038, 0.3
REST = Command((0.0,), (0.0,))


def far_off(text: str = HAND + DISK + TABLE, law: TableLaw = TableLaw.EXACT) -> MujocoWorld:
    """An object that lies where no hand is, settled on its table."""
    world = mujoco_world(parse_case(text), (0.0, 1.0, 0.0), law=law)
    world.act(REST, 0.1)
    return world


def slid(world: MujocoWorld, velocity: tuple[float, float], spin: float) -> tuple[np.ndarray, float]:
    """Way (x, y, theta) that the object slides from a twist, and the time until it rests."""
    before, began = np.array(world.pose), world.time
    world.data.qvel[world.first : world.first + 3] = *velocity, spin
    world.act(REST, 0.001)
    while not world.settled:
        world.act(REST, 0.001)
    return np.array(world.pose) - before, world.time - began


@pytest.mark.parametrize("velocity", [(0.5, 0.0), (-0.2, 0.3)])
def test_a_sliding_disk_stops_as_coulomb_has_it(velocity: tuple[float, float]) -> None:
    way, time = slid(far_off(), velocity, 0.0)
    speed, slowing = hypot(*velocity), FRICTION * GRAVITY
    assert way[:2] == pytest.approx(0.5 * speed / slowing * np.array(velocity), rel=0.01)
    assert speed / slowing <= time < speed / slowing + 0.03  # the last of the speed creeps away
    assert abs(way[2]) < 5e-5  # the centre of mass is 1e-6 m off, see COUPLED


def test_a_spinning_disk_stops_as_a_uniform_pressure_has_it() -> None:
    """Moment 2/3 mu m g R on the inertia m R^2 / 2."""
    spin, slowing = 20.0, 4.0 / 3.0 * FRICTION * GRAVITY / RADIUS
    way, _ = slid(far_off(), (0.0, 0.0), spin)
    assert way[2] == pytest.approx(0.5 * spin**2 / slowing, rel=0.01)


def slides_under(law: LimitSurface, inertia: float, twist: np.ndarray) -> np.ndarray:
    """Way (x, y, theta) until rest under a law of friction, by small steps; ``inertia`` per mass."""
    state, way, step = twist.copy(), np.zeros(3), 1e-4
    while hypot(state[0], state[1]) + law.length * abs(state[2]) > 1e-3:
        way += step * state
        c, s, along = np.cos(way[2]), np.sin(way[2]), complex(state[0], state[1])
        seen = along * complex(c, -s)
        fx, fy, moment = wrench(law, seen.real, seen.imag, state[2])
        load = complex(fx, fy) * complex(c, s)
        state -= step * FRICTION * GRAVITY * np.array([load.real, load.imag, moment / inertia])
    return way


@pytest.mark.parametrize(
    ("thing", "law", "error"),
    [(DISK, TableLaw.EXACT, 0.01), (BOX, TableLaw.EXACT, 0.01), (DISK, TableLaw.ELLIPSOID, 0.025)],
)
@pytest.mark.parametrize("share", [0.3, 3.0])
def test_friction_is_the_law_that_is_asked_for(thing: str, law: TableLaw, error: float, share: float) -> None:
    """A disk and a box that slide and spin at once; ``share``: speed of turning, at the length c, over that of sliding."""
    world = far_off(HAND + thing + TABLE, law)
    surface = world.scene.slider.surface
    twist = np.array([0.4, 0.0, share * 0.4 / surface.length])
    found, _ = slid(world, (0.4, 0.0), float(twist[2]))
    inertia = 0.5 * world.scene.reach**2
    expected = slides_under(surface if law is TableLaw.EXACT else ellipsoid_surface(surface.length), inertia, twist)
    assert found[[0, 2]] == pytest.approx(expected[[0, 2]], rel=error)


@pytest.mark.parametrize(("thing", "least", "most"), [(DISK, 0.06, 0.07), (BOX, 0.08, 0.09)])
def test_how_far_the_ellipsoid_is_from_the_uniform_pressure(thing: str, least: float, most: float) -> None:
    """How far its loads lie outside or inside, in parts of them: what the scene's table leaves out."""
    case = parse_case(HAND + thing + TABLE)
    exact = disk_surface(RADIUS) if thing == DISK else polygon_surface(np.array(case.object.vertices))
    apart = 0.0
    for way in np.linspace(0.0, 2.0 * np.pi, 25):
        for turn in np.linspace(0.0, 0.5 * np.pi, 25):
            twist = np.cos(turn) * np.cos(way), np.cos(turn) * np.sin(way), np.sin(turn) / exact.length
            fx, fy, moment = wrench(exact, *twist)
            apart = max(apart, abs(hypot(fx, fy, moment / exact.length) - 1.0))
    assert least < apart < most


def closed(case: Case, step: float) -> np.ndarray:
    found = simulate_start_in(case, (-0.1483, 0.1066), partial(mujoco_world, step=step))
    assert found.outcome is Outcome.FRICTIONAL
    return np.array(found.pose)


def test_ends_converge_with_the_rate_and_hardly_depend_on_the_step() -> None:
    def case(rate: float) -> Case:
        return parse_case(HAND + f"finger_rate_deg_s = {rate}\n" + DISK + TABLE)

    exact = np.array(simulate_start(case(30.0), (-0.1483, 0.1066)).pose)
    errors = [float(np.abs(closed(case(rate), 1e-3) - exact)[:2].max()) for rate in (40.0, 20.0, 10.0)]
    assert errors[0] > 1.3 * errors[1] > 1.3 * 1.3 * errors[2]
    assert errors[2] < 5e-4
    coarse, usual, fine = (closed(case(20.0), step) for step in (2e-3, 1e-3, 5e-4))
    assert np.abs(usual - fine)[:2].max() < 4e-4
    assert np.abs(coarse - fine)[:2].max() < 1.2e-3
