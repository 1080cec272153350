"""Random starts of polygons before the test-bed hand (line fingers) by the stepping kernel, one call, both cores."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.pushing.closing_steps import BATCH_TOLERANCE, TOLERANCE, carry_all
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.polygon_contacts import polygon_body

HAND = hand_motion(0.06, [0.244])
COUNT = 5_000
STARTS = np.random.default_rng(0).uniform([-0.3, 0.05, 0.0], [0.3, 0.28, 2.0 * pi], (COUNT, 3))
HALVES = {"square": (0.0318, 0.0318), "3:2 rectangle": (0.0374, 0.0250)}
"""Half sides (m): circumradius 45 mm."""


@pytest.mark.parametrize("tolerance", [BATCH_TOLERANCE, TOLERANCE])
@pytest.mark.parametrize("friction", [0.0, 0.7])
@pytest.mark.parametrize("shape", list(HALVES))
def test_five_thousand_starts(benchmark, shape, friction, tolerance):
    a, b = HALVES[shape]
    body = polygon_body([[a, -b], [a, b], [-a, b], [-a, -b]], friction)
    carry_all(HAND, body, STARTS[:10], tolerance)
    benchmark.pedantic(carry_all, (HAND, body, STARTS, tolerance), rounds=3)
    benchmark.extra_info["starts_per_second"] = round(COUNT / benchmark.stats.stats.min)
