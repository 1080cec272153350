"""Places that the arm serves, against a numerical inverse that knows only the forward kinematics and the limits."""

from functools import lru_cache

import numpy as np
import pytest
import shapely

from palmar.geometry.planar_set import areal, uniform_places
from palmar.mechanics.arm.puma_560 import LOWER, UPPER, forward, jacobian
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK, CellTask
from palmar.models.guarantee import Guarantee
from palmar.models.salisbury_hand import SalisburyHand
from palmar.studies.cell_prediction import Predicted
from palmar.studies.cell_workspace import Workspace, allowed_places, hand_way, workspace

HAND = SalisburyHand()
TASKS = [pytest.param(TABLE_TASK, id="table"), pytest.param(FLOATING_TASK, id="floating")]


@lru_cache
def found(task: CellTask) -> Workspace:
    return workspace(HAND, task, 0.02)


def error(pose: np.ndarray, goal: np.ndarray) -> np.ndarray:
    """Place and small turn (6,) from one pose to another."""
    turn = goal[:3, :3] @ pose[:3, :3].T
    rotation = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return np.concatenate([goal[:3, 3] - pose[:3, 3], rotation])


def solved(joints: np.ndarray, goal: np.ndarray, steps: int) -> np.ndarray | None:
    """Damped least squares from joint angles, kept within the limits."""
    for _ in range(steps):
        off = error(forward(joints), goal)
        if np.abs(off).max() < 1e-6:
            return joints
        rates = jacobian(joints)
        step = rates.T @ np.linalg.solve(rates @ rates.T + 1e-5 * np.eye(6), off)
        joints = np.clip(joints + np.clip(step, -0.3, 0.3), LOWER, UPPER)
    return None


def follows(task: CellTask, place: np.ndarray, random: np.random.Generator, tries: int) -> bool:
    """Whether some first joint angles, found from random ones, can be carried along the whole way."""
    way, unmount = hand_way(HAND, task), np.eye(4)
    unmount[2, 3] = -HAND.mount
    goals = way @ unmount
    goals[:, :2, 3] += place
    for _ in range(tries):
        joints = solved(random.uniform(LOWER, UPPER), goals[0], 60)
        for goal in goals[1:]:
            joints = None if joints is None else solved(joints, goal, 12)
        if joints is not None:
            return True
    return False


@pytest.mark.parametrize("task", TASKS)
def test_what_is_served_can_be_followed_and_what_is_far_outside_cannot(task):
    random, served = np.random.default_rng(5), found(task)
    for place in uniform_places(served.places, 2, random):
        assert follows(task, place, random, 60)
    beyond = areal(served.places.buffer(0.12) - served.places.buffer(3.0 * served.spacing))
    for place in uniform_places(beyond, 2, random):
        assert not follows(task, place, random, 12)


@pytest.mark.parametrize("task", TASKS)
def test_the_task_s_own_place_has_room_and_a_finer_grid_only_adds(task):
    served = found(task)
    assert served.guarantee is Guarantee.SAMPLED
    assert served.room(task.place[:2]) > 0.05
    coarse = workspace(HAND, task, 0.04)
    assert served.places.area > coarse.places.area
    assert served.places.buffer(1e-9).covers(coarse.places)


def test_an_error_shrinks_it_and_cuts_the_region_at_the_boundary():
    served = found(TABLE_TASK)
    shrunk = served.with_error(0.03)
    assert shrunk.area < served.places.area and served.places.covers(shrunk.buffer(0.03 - 1e-9))
    region = allowed_places(HAND, TABLE_TASK, Predicted(1, 0.02, "", Guarantee.CLOSED_FORM))
    at = TABLE_TASK.place[:2]
    assert served.served(region, at).area == pytest.approx(region.area)
    right = served.places.bounds[2]
    assert 0.2 < served.served(region, (right, 0.0)).area / region.area < 0.8
    assert served.room((right + 0.01, 0.0)) == 0.0


def test_the_region_is_that_of_the_hand_about_the_axis_in_the_base():
    """The hand looks down, a finger at negative y: toward that one the axis may be farther from the middle."""
    region = allowed_places(HAND, TABLE_TASK, Predicted(1, 0.02, "", Guarantee.CLOSED_FORM))
    assert region.contains(shapely.Point(0.0, 0.035)) and not region.contains(shapely.Point(0.0, -0.035))
    strip = allowed_places(HAND, FLOATING_TASK, Predicted(1, 0.01, "", Guarantee.CONSTRUCTION, (0.05, 0.01)))
    assert strip.bounds == (-0.05, -0.01, 0.05, 0.01)
