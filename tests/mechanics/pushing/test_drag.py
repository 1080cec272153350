"""The drag of one contact, against the general contact solver, which knows nothing of it."""

from math import atan, degrees, inf, tan

import numpy as np
import pytest

from palmar.mechanics.pushing.contact_solve import CONTACT_WIDTH, workspace
from palmar.mechanics.pushing.drag import drag_table, lean, slipping_from
from palmar.mechanics.pushing.limit_surface import disk_surface, ellipsoid_surface, sampled_surface
from palmar.mechanics.pushing.motion_solve import solve_motion
from palmar.mechanics.pushing.pressure_cells import disk_cells

SURFACES = {
    "uniform": disk_surface(0.5),
    "ellipsoid": ellipsoid_surface(0.3),
    "rim": sampled_surface(disk_cells(0.5, 1.0)),
    "ring": sampled_surface(disk_cells(0.5, inf, around=96)),
}


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("friction", [0.1, 0.6])
def test_it_is_what_the_contact_solver_finds(name, friction):
    surface, space, contact = SURFACES[name], workspace(), np.zeros((1, CONTACT_WIDTH))
    table = drag_table(surface, 0.5)
    for t in (0.01, 0.2, 0.9, 1.4, 2.5, 20.0):
        contact[0] = (-0.5, 0.0, 1.0, 0.0, 1.0, t, friction)
        assert solve_motion(surface, contact, 1, (1.0, 0.0, 0.0), space) == 1
        vx, vy, _ = space.motions[0, :3]
        assert lean(table, friction, t) == pytest.approx(
            vy / vx, abs=1e-6 if name in ("uniform", "ellipsoid") else 5e-3
        )


@pytest.mark.parametrize(("angle", "lean_angle"), [(10, 39.34), (20, 55.25), (35, 66.36), (45, 71.92)])
def test_a_line_tip_slides_from_the_known_lean(angle, lean_angle):
    slips = slipping_from(drag_table(disk_surface(1.0), 1.0), tan(np.radians(angle)))
    assert degrees(atan(slips)) == pytest.approx(lean_angle, abs=6e-3)


def test_no_length_enters():
    one, other = drag_table(disk_surface(1.0), 1.0), drag_table(disk_surface(0.03), 0.03)
    assert np.array_equal(one, other)
    assert one[0] == pytest.approx(0.2, abs=1e-6)
