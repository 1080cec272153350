"""Where objects end up, and what the fingers' angles then say, against closed forms."""

from math import acos, atan, cos, pi, radians, sin, tan

import numpy as np
import pytest
import shapely

from palmar.models.case_file import parse_case
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.build import build_region
from palmar.regions.exact import settle
from palmar.studies.final_angles import final_angles, radius_read
from palmar.studies.final_poses import final_poses, grid
from palmar.studies.simulate import simulate_start

EXAMPLE = open_case("chapter3_example")[1]


def ends_of(case, closure=Closure.FRICTIONAL):
    plain = settle(case, closure)
    return plain, final_poses(plain, build_region(plain).centre)


def test_a_grid_has_the_wanted_number_of_points_all_inside():
    shape = shapely.Point(1.0, 2.0).buffer(0.5)
    points, spacing = grid(shape, 5000)
    assert len(points) == pytest.approx(5000, rel=0.01)
    assert shapely.contains_xy(shape, points).all()
    assert spacing**2 * 5000 == pytest.approx(shape.area)
    assert len(grid(shapely.box(0, 0, 1e-9, 5), 3)[0]) >= 1


def test_without_friction_all_end_in_one_pose():
    case, ends = ends_of(EXAMPLE, Closure.STRUCTURAL)
    (kind,) = ends.kinds
    assert (kind.name, kind.share, ends.caught) == ("centred", 1.0, 1.0)
    assert (*ends.x, *ends.y) == pytest.approx((0.0, 0.0, 0.5, 0.5), abs=1e-9)
    assert ends.centring < 1e-9
    # tan(psi / 2) = D / R: 126.87 degrees (docs/derivations/sweeping.md).
    assert kind.smaller == pytest.approx((radians(126.87), radians(126.87)), abs=1e-4)
    assert final_angles(case, ends).centred == pytest.approx(2.0 * atan(2.0), abs=1e-9)


def test_with_friction_pinches_lie_between_the_elevations_of_the_friction_angle():
    _, ends = ends_of(EXAMPLE)
    kinds = {each.name: each for each in ends.kinds}
    assert set(kinds) == {"pinched", "wedged", "centred"}
    assert sum(each.share for each in ends.kinds) == pytest.approx(1.0)
    alpha = radians(35.0)
    # The last disk caught: both tips touch 35 degrees below the equator, at y = L sin A + R sin alpha.
    sweep = acos((0.5 * cos(alpha) - 1.0) / 2.0)
    highest = 2.0 * sin(sweep) + 0.5 * sin(alpha)
    assert kinds["pinched"].y[1] == pytest.approx(highest, abs=0.03)
    assert kinds["pinched"].y[1] <= highest
    assert kinds["pinched"].smaller[0] >= 0.5 * pi - alpha
    assert kinds["pinched"].smaller == kinds["pinched"].larger
    # The wedge locks at 180 - 2 alpha = 110 degrees.
    assert kinds["wedged"].smaller[0] == pytest.approx(radians(110.0), abs=1e-3)
    assert ends.turn[0] == pytest.approx(-ends.turn[1], abs=1e-6)


def test_the_motion_gathers_and_a_lost_start_counts_as_lost():
    case = open_case("testbed_table")[1]
    ends = final_poses(case, shapely.box(-0.3, 0.05, 0.3, 0.35))
    shares = {each.name: each.share for each in ends.kinds}
    region = build_region(case).centre
    held = region.intersection(shapely.box(-0.3, 0.05, 0.3, 0.35)).area / (0.6 * 0.3)
    assert ends.caught == pytest.approx(held, abs=2e-3)
    assert shares["missed"] + shares["escaped"] == pytest.approx(1.0 - ends.caught, abs=2e-3)
    assert ends.centring < 0.6
    assert final_poses(case, shapely.box(1.0, 1.0, 1.1, 1.1)) is None


@pytest.mark.parametrize("radius", [0.02, 0.038, 0.055])
@pytest.mark.parametrize("name", ["testbed_table", "testbed_table_thick"])
def test_the_radius_read_is_that_of_the_disk_that_was_held(name, radius):
    case = open_case(name)[1]
    thing = case.object.model_copy(update={"radius": radius})
    hand = case.hand.model_copy(update={"fingers": open_case("testbed_table")[1].hand.fingers})
    smooth = case.contact.model_copy(update={"friction": 0.0})
    held = simulate_start(case.model_copy(update={"object": thing, "hand": hand, "contact": smooth}), (0.02, 0.12))
    if held.outcome.value == "structural":
        assert radius_read(hand, held.right[0]) == pytest.approx(radius, abs=1e-9)
    else:
        assert radius > 0.06 - 0.0125


def test_what_the_angles_say_in_the_test_bed():
    case, ends = ends_of(open_case("testbed_table")[1], Closure.STRUCTURAL)
    said = final_angles(case, ends)
    assert said.missed == pytest.approx(pi)
    assert said.centred == pytest.approx(2.0 * atan(0.060 / 0.038), abs=1e-9)
    assert said.caught_from_missed == pytest.approx(pi - said.centred, abs=1e-4)
    # R = D / tan(psi / 2), so dR/dpsi = -D / (2 sin^2(psi / 2)).
    assert said.radius_per_angle == pytest.approx(-0.06 / (2.0 * sin(said.centred / 2.0) ** 2), rel=1e-6)
    angles, radii = np.array(said.radii).T
    assert radii == pytest.approx([0.06 / tan(psi / 2.0) for psi in angles], abs=1e-12)


def test_fingers_that_meet_around_a_small_disk_cannot_tell():
    case, ends = ends_of(open_case("testbed_table_thick")[1], Closure.STRUCTURAL)
    assert [each.name for each in ends.kinds] == ["caged"]
    said = final_angles(case, ends)
    assert said.caught_from_missed == 0.0
    assert said.centred is None


def test_a_polygon_ends_by_outcome():
    text = """
    [hand]
    palm_width_mm = 120
    finger_links_mm = [244]
    [object]
    shape = "polygon"
    vertices_mm = [[-30, -20], [30, -20], [30, 20], [-30, 20]]
    """
    ends = final_poses(parse_case(text), shapely.box(-0.005, 0.115, 0.005, 0.125))
    assert {each.name for each in ends.kinds} <= {"structural", "frictional"}
    assert ends.caught == 1.0
