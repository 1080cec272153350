"""Batches of polygons: the looser tolerance that is meant for them, and the end of a pinch without friction."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, TOLERANCE, carry, carry_all
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.polygon_contacts import polygon_body
from palmar.models.outcome import Outcome

HAND = hand_motion(0.06, [0.244])
SQUARE = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]]) * 0.0318
RECTANGLE = SQUARE * [1.2, 0.8]


@pytest.mark.parametrize("vertices", [SQUARE, RECTANGLE], ids=["square", "rectangle"])
@pytest.mark.parametrize("friction", [0.0, 0.7])
def test_the_tolerance_for_batches_keeps_outcomes_and_poses(vertices, friction):
    body = polygon_body(vertices, friction)
    starts = np.random.default_rng(8).uniform([-0.3, 0.06, 0.0], [0.3, 0.28, 2.0 * pi], (400, 3))
    codes, ends, _ = carry_all(HAND, body, starts, BATCH_TOLERANCE)
    fine_codes, fine, _ = carry_all(HAND, body, starts, TOLERANCE)
    assert np.count_nonzero(codes != fine_codes) <= 2
    held = (codes == fine_codes) & (codes <= Outcome.FRICTIONAL.code)
    assert held.sum() > 100
    apart = np.abs(ends - fine)[held][:, :3] * [1.0, 1.0, body.reach]
    assert np.median(apart.max(axis=1)) < 20.0 * BATCH_TOLERANCE * 0.244
    assert np.quantile(apart.max(axis=1), 0.95) < 200.0 * BATCH_TOLERANCE * 0.244


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
def test_tips_without_friction_turn_a_square_until_they_oppose_each_other(tolerance):
    """Its way there ends with an infinite rate; the outcome used to be a matter of luck."""
    end = carry(HAND, polygon_body(SQUARE, 0.0), 0.016731, 0.246261, 1.127552, tolerance)[0]
    assert Outcome.from_code(end.code) is Outcome.FRICTIONAL
    assert end.theta == pytest.approx(0.5 * pi, abs=2e-4)
    assert end.x == pytest.approx(0.0, abs=1e-5)
    assert np.cos(end.right) * 0.244 + 0.06 == pytest.approx(0.0318, abs=1e-5)
