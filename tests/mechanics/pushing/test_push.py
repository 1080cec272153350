"""The push kernel: events, order of convergence, invariants, and a slow rival that shares nothing but the physics."""

import numpy as np
import pytest
from scipy.optimize import root
from shapely.geometry import Point, Polygon

from palmar.geometry.polygon import area_centroid, checked_convex
from palmar.mechanics.pushing.contact_solve import workspace
from palmar.mechanics.pushing.limit_surface import wrench
from palmar.mechanics.pushing.pressure_cells import polygon_cells
from palmar.mechanics.pushing.push import Pusher, PushOutcome, moved_out, push, push_one
from palmar.mechanics.pushing.slider import disk_slider, nearest, polygon_slider

KITE = checked_convex(((0.05, 0.0), (0.01, 0.045), (-0.06, 0.01), (-0.01, -0.05)))
SLIDER = polygon_slider(KITE, area_centroid(KITE))
DISK = disk_slider(0.05)
PUSHER = Pusher(0.005, 0.3)
SPACE = workspace()


def pushed(slider, start, path, pusher=PUSHER, tolerance=1e-8):
    done = push(slider, pusher, np.atleast_2d(np.array(start, float)), np.atleast_2d(np.array(path, float)), tolerance)
    return done.poses[0], done.outcomes[0]


def random_pushes(count, seed=0):
    rng = np.random.default_rng(seed)
    starts = np.column_stack((rng.normal(size=(count, 2)) * 0.02, rng.uniform(-3.0, 3.0, count)))
    bearing, aim = rng.uniform(0.0, 2.0 * np.pi, count), rng.normal(size=(count, 2)) * 0.02
    tips = starts[:, :2] + 0.09 * np.stack((np.cos(bearing), np.sin(bearing)), axis=1)
    ends = starts[:, :2] + aim
    return starts, np.hstack((tips, ends))


def test_nearest_agrees_with_a_library():
    outline = Polygon(SLIDER.core)
    rng = np.random.default_rng(1)
    for x, y in rng.uniform(-0.1, 0.1, (200, 2)):
        distance, fx, fy, nx, ny = nearest(SLIDER, x, y)
        there = Point(x, y)
        signed = -outline.exterior.distance(there) if outline.contains(there) else outline.distance(there)
        assert distance == pytest.approx(signed, abs=1e-12)
        assert outline.exterior.distance(Point(fx, fy)) < 1e-12
        assert (x - fx, y - fy) == pytest.approx((distance * nx, distance * ny), abs=1e-12)
    assert nearest(DISK, 0.03, 0.04)[:3] == pytest.approx((0.0, 0.03, 0.04))


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_a_push_through_the_middle_carries_a_disk_straight(friction):
    pose, outcome = pushed(DISK, (0.3, 0.1, 0.7), (0.2, 0.1, 0.345, 0.1), Pusher(0.005, friction))
    assert outcome is PushOutcome.PUSHED
    assert pose == pytest.approx([0.4, 0.1, 0.7], abs=1e-9)


def test_a_pusher_that_passes_or_stops_short_or_moves_away_moves_nothing():
    for path in ((0.1, 0.0551, -0.1, 0.0551), (0.1, 0.0, 0.0551, 0.0), (0.056, 0.0, 0.1, 0.0), (0.06, 0.0, 0.06, 0.0)):
        pose, outcome = pushed(DISK, (0.0, 0.0, 0.2), path)
        assert outcome is PushOutcome.MISSED
        assert pose == pytest.approx([0.0, 0.0, 0.2], abs=0.0)


@pytest.mark.parametrize("inside", [(0.052, 0.0), (0.03, 0.001), (0.0, 0.01), (-0.02, -0.03)])
def test_a_pusher_inside_is_moved_out_the_shortest_way(inside):
    pose = (0.0, 0.0, 0.0)
    x, y = moved_out(SLIDER, PUSHER.radius, pose, *inside)
    grown = Polygon(SLIDER.core).buffer(PUSHER.radius, quad_segs=256)
    assert np.hypot(x - inside[0], y - inside[1]) == pytest.approx(grown.exterior.distance(Point(inside)), abs=1e-6)
    assert nearest(SLIDER, x, y)[0] == pytest.approx(PUSHER.radius, abs=1e-12)


def test_a_glancing_pusher_turns_the_object_and_leaves_it():
    pose, outcome = pushed(SLIDER, (0.0, 0.0, 0.0), (0.1, 0.03, -0.2, 0.04))
    assert outcome is PushOutcome.PUSHED
    assert pose[2] > 0.1
    gap = nearest(SLIDER, *local(pose, (-0.2, 0.04)))[0] - PUSHER.radius
    assert gap > 0.05


def local(pose, point):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    dx, dy = np.subtract(point, pose[:2])
    return c * dx + s * dy - SLIDER.centre[0], c * dy - s * dx - SLIDER.centre[1]


def test_the_pusher_never_ends_inside_and_nothing_is_undecided():
    starts, paths = random_pushes(300)
    done = push(SLIDER, PUSHER, starts, paths)
    assert PushOutcome.UNDECIDED not in done.outcomes
    assert done.outcomes.count(PushOutcome.PUSHED) > 200
    assert not done.ambiguous.any()
    gaps = [nearest(SLIDER, *local(pose, path[2:]))[0] for pose, path in zip(done.poses, paths, strict=True)]
    assert min(gaps) - PUSHER.radius > -1e-9


def test_the_error_falls_with_the_tolerance_as_its_order_says():
    """Error per step of order 3 kept below the tolerance: steps grow as its cube root, the error as its 2/3 power."""
    starts, paths = random_pushes(60, 3)
    exact = push(SLIDER, PUSHER, starts, paths, 1e-12).poses
    errors = []
    for tolerance in (1e-5, 1e-7, 1e-9):
        apart = push(SLIDER, PUSHER, starts, paths, tolerance).poses - exact
        errors.append(float(np.mean(np.hypot(apart[:, 0], apart[:, 1]))))
    orders = np.diff(np.log(errors)) / np.log(1e-2)
    assert np.all(orders > 0.6)
    assert errors[1] < 1e-6


def test_mirrored_and_moved_pushes_end_mirrored_and_moved():
    starts, paths = random_pushes(30, 4)
    here = push(SLIDER, PUSHER, starts, paths, 1e-10).poses
    flipped = checked_convex([(x, -y) for x, y in KITE])
    there = push(
        polygon_slider(flipped, area_centroid(flipped)), PUSHER, starts * [1, -1, -1], paths * [1, -1, 1, -1], 1e-10
    ).poses
    assert there * [1, -1, -1] == pytest.approx(here, abs=1e-7)
    c, s = np.cos(0.8), np.sin(0.8)
    turn = np.array([[c, s], [-s, c]])
    moved = np.column_stack((starts[:, :2] @ turn + [0.3, -0.2], starts[:, 2] + 0.8))
    along = np.hstack((paths[:, :2] @ turn, paths[:, 2:] @ turn)) + np.array([0.3, -0.2, 0.3, -0.2])
    ends = push(SLIDER, PUSHER, moved, along, 1e-10).poses
    assert ends == pytest.approx(np.column_stack((here[:, :2] @ turn + [0.3, -0.2], here[:, 2] + 0.8)), abs=1e-7)


def test_the_place_of_the_frame_does_not_matter():
    starts, paths = random_pushes(20, 5)
    shifted = checked_convex([(x + 0.02, y - 0.01) for x, y in KITE])
    slider = polygon_slider(shifted, area_centroid(shifted))
    c, s = np.cos(starts[:, 2]), np.sin(starts[:, 2])
    offset = np.column_stack((c * 0.02 + s * 0.01, s * 0.02 - c * 0.01, np.zeros(20)))
    ends = push(slider, PUSHER, starts - offset, paths, 1e-10).poses
    expected = push(SLIDER, PUSHER, starts, paths, 1e-10).poses
    c, s = np.cos(ends[:, 2]), np.sin(ends[:, 2])
    assert ends[:, 0] + c * 0.02 + s * 0.01 == pytest.approx(expected[:, 0], abs=1e-7)
    assert ends[:, 1] + s * 0.02 - c * 0.01 == pytest.approx(expected[:, 1], abs=1e-7)


def test_the_number_of_threads_changes_no_bit():
    starts, paths = random_pushes(130, 6)
    one, four = (push(SLIDER, PUSHER, starts, paths, threads=threads) for threads in (1, 4))
    assert np.array_equal(one.poses, four.poses) and one.outcomes == four.outcomes


def test_a_corner_can_be_pushed():
    """The contact rolls from an edge round a corner to the next edge."""
    pose, outcome = pushed(SLIDER, (0.0, 0.0, 0.0), (0.08, 0.008, -0.02, 0.012))
    assert outcome is PushOutcome.PUSHED
    assert nearest(SLIDER, *local(pose, (-0.02, 0.012)))[0] >= PUSHER.radius - 1e-9


@pytest.mark.parametrize("row", [0, 2, 3])
def test_a_slow_rival_ends_at_the_same_place(row):
    """Euler steps, 1500 support points, a spring and tanh friction at the pusher: no modes, no metric, no events."""
    starts, paths = random_pushes(4, 7)
    points, weights, _ = polygon_cells(KITE, 0.0, 12, 125, area_centroid(KITE))
    expected, _ = pushed(SLIDER, starts[row], paths[row])
    got = slow_push(points, weights, starts[row], paths[row], 400)
    assert got[:2] == pytest.approx(expected[:2], abs=1e-4)
    assert got[2] == pytest.approx(expected[2], abs=5e-3)


def to_centre(pose):
    c, s, (x, y) = np.cos(pose[2]), np.sin(pose[2]), SLIDER.centre
    return np.array([c * x - s * y, s * x + c * y, 0.0])


def slow_push(points, weights, start, path, steps, soft=2e-3):
    outline = Polygon(SLIDER.core)
    pose = start + to_centre(start)
    stride = (path[2:] - path[:2]) / steps
    guess = np.zeros(4)
    for k in range(steps):
        c, s = np.cos(pose[2]), np.sin(pose[2])
        turn = np.array([[c, s], [-s, c]])
        tip, u = turn @ (path[:2] + (k + 1) * stride - pose[:2]), turn @ stride
        there = Point(tip)
        gap = outline.distance(there) - PUSHER.radius
        if gap > 0.0:
            continue
        foot = np.array(outline.exterior.interpolate(outline.exterior.project(there)).coords[0])
        n = (foot - tip) / np.linalg.norm(foot - tip)
        t, speed = np.array([-n[1], n[0]]), np.linalg.norm(u)

        def unbalanced(z, n=n, t=t, u=u, foot=foot, gap=gap, speed=speed):
            """Twist per stride and normal load; the contact closes the gap within the step."""
            nu, load = z[:3] * [speed, speed, speed / 0.04], z[3]
            moving = nu[:2] + nu[2] * np.stack((-points[:, 1], points[:, 0]), axis=1)
            pull = weights[:, None] * moving / np.sqrt(np.sum(moving**2, axis=1) + (1e-3 * speed) ** 2)[:, None]
            slip = t @ (nu[:2] + nu[2] * np.array([-foot[1], foot[0]]) - u)
            force = load * (n - PUSHER.friction * np.tanh(slip / (soft * speed)) * t)
            twisting = np.sum(points[:, 0] * pull[:, 1] - points[:, 1] * pull[:, 0])
            rest = [*(force - pull.sum(axis=0)), (foot[0] * force[1] - foot[1] * force[0] - twisting) / 0.04]
            return [*rest, (n @ (nu[:2] + nu[2] * np.array([-foot[1], foot[0]])) + gap) / speed]

        done = root(unbalanced, guess if guess.any() else [*(0.5 * u / speed), 0.1, 0.5])
        if not done.success:
            done = root(unbalanced, [*(0.5 * n), 0.0, 0.5])
        guess = done.x
        nu = guess[:3] * [speed, speed, speed / 0.04]
        pose = pose + np.array([*(turn.T @ nu[:2]), nu[2]])
    return pose - to_centre(pose)


def test_one_push_is_what_a_row_of_many_is():
    pose, code, several = push_one(DISK, PUSHER, (0.0, 0.0, 0.0), (0.1, 0.01, 0.03, 0.02), 1e-8, SPACE)
    row, outcome = pushed(DISK, (0.0, 0.0, 0.0), (0.1, 0.01, 0.03, 0.02))
    assert PushOutcome(code) is outcome is PushOutcome.PUSHED and not several
    assert pose == pytest.approx(row, abs=1e-15)
    assert wrench(DISK.surface, 1.0, 0.0, 0.0) == pytest.approx((1.0, 0.0, 0.0))
