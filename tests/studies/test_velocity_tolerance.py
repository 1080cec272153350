"""The disc of velocities that a free disk may have: drawn inside it is caught, at its edge it is not, and it scales."""

from __future__ import annotations

import numpy as np
import pytest

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.capture_case import capture_hand_of
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.studies.velocity_tolerance import velocity_tolerance

CASE = open_case("zero_g_example")[1]
AT = (0.01, 0.12)


def is_caught(velocities: np.ndarray) -> np.ndarray:
    ends = capture_all(capture_hand_of(CASE), np.tile(AT, (len(velocities), 1)), velocities)
    return ends.codes <= Outcome.CAGED.code


def test_velocities_within_are_caught_and_one_at_the_edge_is_not() -> None:
    found = velocity_tolerance(CASE, AT)
    rng = np.random.default_rng(2)
    angles, sizes = rng.uniform(0.0, 2.0 * np.pi, 20_000), found.radius * np.sqrt(rng.random(20_000))
    inside = sizes[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    assert is_caught(inside).mean() > 0.9995
    assert found.worst is not None
    assert not is_caught(np.array([found.worst]))[0]
    assert np.hypot(*found.worst) == pytest.approx(found.radius, rel=1e-3)


def test_twice_the_finger_rate_allows_twice_the_speed() -> None:
    hand = CASE.hand.model_copy(update={"finger_rate": 2.0 * CASE.hand.finger_rate})
    quick = CASE.model_copy(update={"hand": hand})
    assert velocity_tolerance(quick, AT).radius == pytest.approx(2.0 * velocity_tolerance(CASE, AT).radius, rel=1e-3)


def test_where_a_disk_at_rest_is_lost_no_velocity_is_promised() -> None:
    found = velocity_tolerance(CASE, (0.25, 0.3))
    assert found.radius == 0.0
    assert found.worst == (0.0, 0.0)


def test_a_table_has_no_velocities() -> None:
    with pytest.raises(NotCoveredError, match="table"):
        velocity_tolerance(open_case("testbed_table")[1], AT)
