"""Turning the hand about its own axis, step by step."""

import numpy as np
import pytest

from palmar.behaviours.cell.arm_path import PERIOD, TURN_RATE, ArmPath, turned


@pytest.mark.parametrize("angle", [0.3, -0.3])
def test_it_arrives_at_the_angle_and_stays_in_place(angle):
    pose = np.diag([1.0, -1.0, -1.0, 1.0])
    pose[:3, 3] = 0.4, 0.1, 0.2
    path, done, steps = ArmPath(pose), 0.0, 0
    while done != angle:
        path, step = turned(path, angle - done)
        assert abs(step) <= TURN_RATE * PERIOD
        done, steps = done + step, steps + 1
    c, s = np.cos(angle), np.sin(angle)
    assert path.pose[:3, :3] == pytest.approx(pose[:3, :3] @ [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    assert path.place == pytest.approx([0.4, 0.1, 0.2])
    assert steps == 11
