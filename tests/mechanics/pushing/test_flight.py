"""When a finger first touches an object at rest, in closed form, against the gaps on the way; cosine and sine."""

from math import cos, pi, sin

import numpy as np
import pytest

from palmar.mechanics.angles import cosine_sine
from palmar.mechanics.compiled import compiled
from palmar.mechanics.pushing.closing_flight import turn_to_touch
from palmar.mechanics.pushing.closing_motion import LEFT, RIGHT, THETA, TIME, X, Y, bench
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.hand_pose import MOVING, free_motion, hand_motion, place_links
from palmar.mechanics.pushing.polygon_contacts import disk_body, polygon_body
from palmar.models.outcome import Outcome


@compiled
def _both(angle):
    return cosine_sine(angle)


def test_cosine_and_sine():
    angles = np.concatenate([np.random.default_rng(0).uniform(-50.0, 50.0, 2000), np.arange(-8, 9) * pi / 4])
    for angle in angles:
        c, s = _both(angle)
        assert abs(c - cos(angle)) <= 3e-16
        assert abs(s - sin(angle)) <= 3e-16
    assert _both(0.0) == (1.0, 0.0)


def _distance(body, links, x, y, theta):
    """Distance of the right and left links' axes from the body's outline, which they do not cross; less its radius."""
    c, s = np.cos(theta), np.sin(theta)
    corners = body.vertices @ np.array([[c, s], [-s, c]]) + [x, y]
    least = np.inf
    for row in links[1:3]:
        a, b = row[:2], row[2:4]
        for i, p in enumerate(corners):
            q = corners[(i + 1) % len(corners)]
            pairs = [(p, a, b)] if len(corners) == 1 else [(p, a, b), (a, p, q), (b, p, q)]
            for point, begin, end in pairs:
                t = np.clip((point - begin) @ (end - begin) / ((end - begin) @ (end - begin)), 0.0, 1.0)
                least = min(least, np.hypot(*(point - begin - t * (end - begin))))
    return least - body.radius


@pytest.mark.parametrize("half_thickness", [0.0, 0.0125])
@pytest.mark.parametrize(
    "body", [disk_body(0.03, 0.5), polygon_body([(0.04, -0.02), (0.04, 0.02), (-0.04, 0.02), (-0.04, -0.02)], 0.5)]
)
def test_turn_is_the_first_at_which_a_link_is_near(body, half_thickness):
    motion, at, rng, met = hand_motion(0.06, [0.244], half_thickness), bench(0), np.random.default_rng(2), 0
    within = half_thickness + 1e-5
    for _ in range(60):
        x, y, theta, now = (
            rng.uniform(-0.25, 0.25),
            rng.uniform(0.06, 0.27),
            rng.uniform(0.0, 6.28),
            rng.uniform(0.0, 0.5),
        )
        at.state[[X, Y, THETA, TIME, RIGHT, LEFT]] = x, y, theta, now, MOVING, MOVING

        def gap(turn, pose=(x, y, theta), now=now):
            place_links(motion, now + turn, MOVING, MOVING, at.links)
            return _distance(body, at.links, *pose) - within

        if gap(0.0) <= 0.0:
            continue
        turn = turn_to_touch(motion, body, at, within + body.radius)
        clear = np.linspace(0.0, min(turn * (1.0 - 1e-6), pi - now), 120)
        assert min(gap(each) for each in clear) > 0.0
        if turn < pi - now:
            assert abs(gap(turn)) <= 1e-9
            met += 1
    assert met >= 10


def test_a_motion_whose_time_is_not_the_base_angle_touches_all_the_same() -> None:
    """The closing motion told as joint angles and rates from time 0 on, at twice the rate, ends every start alike."""
    first, turn = 0.6, 2.2
    closing = hand_motion(0.06, [0.244], first=first, limit=first + turn)
    angles, rates = np.full((2, 1), first), np.full((2, 1), 2.0)
    told = free_motion(0.06, closing.links, 0.0, angles, rates, (0.0, 0.0), 0.5 * (closing.last - first), False)
    rng = np.random.default_rng(8)
    starts = np.column_stack([rng.uniform(-0.2, 0.2, 300), rng.uniform(0.03, 0.26, 300), rng.uniform(0.0, 6.3, 300)])
    for body in (
        polygon_body([(-0.012, -0.008), (0.012, -0.008), (0.012, 0.008), (-0.012, 0.008)], 0.5),
        disk_body(0.02, 0.5),
    ):
        codes, ends, _ = carry_all(closing, body, starts)
        others, poses, _ = carry_all(told, body, starts)
        assert np.array_equal(codes, others)
        assert np.abs(poses[:, :2] - ends[:, :2]).max() < 1e-5
        assert (codes != Outcome.MISSED.code).sum() > 100
