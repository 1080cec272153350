"""The reference for free flight: the known exact area, mirror symmetry, and convergence with the step."""

import numpy as np
import pytest

from reference.slow_free_flight import carried, caught, verdict_angle

D, L, R = 6.0, 24.4, 3.8


def test_the_exact_area_of_the_example_on_a_grid():
    """400.3 at e = 1, found elsewhere by another simulation; it grows as e falls."""
    spacing = 0.5
    x, y = np.meshgrid(np.arange(spacing / 2, 28.0, spacing), np.arange(R + spacing / 2, 27.0, spacing))
    starts = np.column_stack([x.ravel(), y.ravel()])
    elastic, plastic = (2.0 * spacing**2 * caught(starts, D, L, R, e, step=1e-3)[0].sum() for e in (1.0, 0.0))
    assert elastic == pytest.approx(400.3, abs=5.0)
    assert plastic > elastic + 50.0


def test_mirrored_starts_fare_alike():
    rng = np.random.default_rng(2)
    starts = np.column_stack([rng.uniform(0.0, 12.0, 150), rng.uniform(R, 24.0, 150)])
    held, ends = caught(starts, D, L, R, 0.6, step=1e-3)
    mirrored, others = caught(starts * [-1.0, 1.0], D, L, R, 0.6, step=1e-3)
    assert (held == mirrored).mean() > 0.98, "but where both fingers strike at once"
    few = (ends[:, 4] < 4) & (others[:, 4] == ends[:, 4])
    assert few.sum() > 30
    assert others[few, :2] == pytest.approx(ends[few, :2] * [-1.0, 1.0], abs=1e-3 * L)


def test_smaller_steps_change_nothing_while_impacts_are_few():
    coarse, fine = (carried(11.0, 9.0, 0.0, verdict_angle(D, L, R), (D, L, R), 1.0, step) for step in (1e-3, 1e-5))
    assert coarse[4] == fine[4] >= 2
    assert coarse[:2] == pytest.approx(fine[:2], abs=1e-3 * L)


def test_a_disk_nobody_touches_flies_straight():
    x, y, vx, vy, hits = carried(0.0, 12.0, 0.0, 0.5, (D, L, R), 1.0, 1e-3, 0.3, -0.2)
    assert (x, y, vx, vy, hits) == pytest.approx((0.15, 11.9, 0.3, -0.2, 0))
