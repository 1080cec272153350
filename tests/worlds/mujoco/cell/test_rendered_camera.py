"""Rendered frames: the camera model fits the renderer, cameras do not disturb each other, faults work through them."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")
pytest.importorskip("cv2", reason="needs the extra palmar[mujoco]")

from palmar.errors import NotCoveredError
from palmar.models.cell_messages import EyeKind
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK
from palmar.models.salisbury_hand import SalisburyHand
from palmar.studies.cell_trials import TASKS, eye_here
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.timed_camera import CameraSettings
from palmar.worlds.mujoco.cell.cell import ARM, FINGERS, Cell
from palmar.worlds.mujoco.cell.film import EVERY, Film
from palmar.worlds.mujoco.cell.rendered_camera import RenderedCamera
from palmar.worlds.mujoco.cell.renderer import surface
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import run_trial, start_pose

HAND = SalisburyHand()


@pytest.fixture(scope="module", autouse=True)
def rendering():
    try:
        surface()
    except NotCoveredError as error:
        pytest.skip(str(error))


def beside(camera, task, x, y):
    """The state at the start of a task, the cylinder moved."""
    start = Cell(HAND, task, CellSettings(), start_pose(HAND, task)).data.qpos
    state = camera.rest.copy()
    state[ARM], state[FINGERS] = start[ARM], start[FINGERS]
    state[FINGERS.stop : FINGERS.stop + 2] += x, y
    return state


@pytest.mark.parametrize("task", TASKS.values(), ids=lambda task: task.kind.value)
def test_the_cylinder_is_found_where_it_is_and_a_shifted_calibration_shifts_it(task):
    right = RenderedCamera(HAND, task, CellSettings(seed=1))
    wrong = RenderedCamera(HAND, task, CellSettings(seed=1, camera=CameraSettings(bias=(0.003, -0.004))))
    for x, y in ((0.0, 0.0), (0.03, -0.02), (-0.03, 0.035)):
        state = beside(right, task, x, y)
        seen, shifted = right.sight(state, 1.5), wrong.sight(state, 1.5)
        assert seen is not None and shifted is not None
        off = np.array([seen.x_m - task.place[0] - x, seen.y_m - task.place[1] - y])
        assert np.linalg.norm(off) < 2.0 * seen.sigma_m < 1.5e-3
        assert seen.radius_m == pytest.approx(task.cylinder.radius, abs=1e-4)
        assert (shifted.x_m - seen.x_m, shifted.y_m - seen.y_m) == pytest.approx((0.003, -0.004), abs=2e-4)
        assert seen.stamp_s == 1.5


def test_cameras_and_a_film_in_one_process_do_not_disturb_each_other():
    first, cell = (
        RenderedCamera(HAND, TABLE_TASK, CellSettings(camera=CameraSettings(grain=0.0))),
        Cell(HAND, TABLE_TASK, CellSettings(), start_pose(HAND, TABLE_TASK)),
    )
    before, film = first.picture(first.rest), Film(size=(90, 120))
    for _ in range(EVERY + 1):
        film(cell)
    other = RenderedCamera(HAND, FLOATING_TASK, CellSettings())
    assert not np.array_equal(other.picture(other.rest), before)
    del other
    assert np.array_equal(first.picture(first.rest), before)
    assert [each.shape for each in film.pictures] == [(90, 120, 3)] * 2
    assert film.pictures[0].std() > 10.0


def test_where_it_is_not_nothing_is_seen():
    camera = RenderedCamera(HAND, TABLE_TASK, CellSettings())
    assert camera.sight(beside(camera, TABLE_TASK, 0.0, 2.0), 0.0) is None


@pytest.mark.parametrize("fault", [FaultKind.CAMERA_KILLED, FaultKind.FRAMES_FROZEN])
def test_faults_of_the_camera_end_a_trial_as_with_the_other_eye(fault):
    settings = CellSettings(seed=3, fault=Fault(fault, 1.0))
    camera, frames = RenderedCamera(HAND, FLOATING_TASK, settings), []

    def sight(qpos, now):
        frames.append(now)
        return camera.sight(qpos, now)

    found = run_trial(HAND, FLOATING_TASK, settings, sight=sight)
    assert frames == sorted(frames)
    assert 25 < len(frames) <= 31
    assert frames[-1] < 1.1  # a frozen camera shows the last picture again
    assert (found.outcome, found.unsafe) == ("no fresh sighting", ())


def test_where_nothing_can_be_rendered_the_pose_camera_takes_its_place(monkeypatch):
    surface.cache_clear()
    monkeypatch.setenv("MUJOCO_GL", "off")
    used, why = eye_here(EyeKind.CAMERA)
    assert used is EyeKind.POSE
    assert why == (
        "simulated-pose camera instead of the rendered one: nothing can be rendered: MUJOCO_GL=off forbids it"
    )
    assert eye_here(EyeKind.POSE) == (EyeKind.POSE, None)
    monkeypatch.setenv("MUJOCO_GL", "egl")
    assert eye_here(EyeKind.CAMERA) == (EyeKind.CAMERA, None)
