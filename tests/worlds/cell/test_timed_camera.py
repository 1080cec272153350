"""When sightings come, what the simulated ones err by, and the camera's faults."""

import numpy as np
import pytest

from palmar.errors import InputError
from palmar.models.cell_messages import Sighting
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.pose_camera import PoseCamera
from palmar.worlds.cell.timed_camera import CameraSettings, TimedCamera


def watch(
    settings: CameraSettings, fault: FaultKind = FaultKind.NONE, seconds: float = 60.0
) -> list[tuple[float, ...]]:
    random = np.random.default_rng(1)
    pose, camera = PoseCamera(settings, random), TimedCamera(settings, random, Fault(fault, 1.0))
    found: list[tuple[float, ...]] = []
    for k in range(int(1000 * seconds)):
        camera.expose(k * 1e-3, lambda now: pose.sight(now, 0.5, -0.1, 0.03))
        seen = camera.look(k * 1e-3)
        if seen is not None and (not found or seen.stamp_s > found[-1][1]):
            found.append((k * 1e-3, seen.stamp_s, seen.x_m, seen.y_m, seen.radius_m))
    return found


def test_frames_come_at_their_rate_late_noisy_and_not_all():
    arrived, stamp, x, y, _ = np.array(watch(CameraSettings(dropped=0.1, bias=(0.01, 0.0)))).T
    assert len(x) == pytest.approx(60 * 30 * 0.9, rel=0.03)
    assert (arrived - stamp).mean() == pytest.approx(0.040, abs=2e-3)
    assert (arrived - stamp).std() == pytest.approx(0.008, rel=0.2)
    assert (x.mean(), y.mean()) == (pytest.approx(0.51, abs=2e-4), pytest.approx(-0.1, abs=2e-4))
    assert x.std() == pytest.approx(0.0015, rel=0.1)


@pytest.mark.parametrize("fault", [FaultKind.CAMERA_KILLED, FaultKind.FRAMES_FROZEN, FaultKind.STALE_FRAMES])
def test_faults_show(fault):
    found = [each for each in watch(CameraSettings(), fault, 3.0) if each[0] > 1.2]
    if fault is FaultKind.CAMERA_KILLED:
        assert found == []
    elif fault is FaultKind.FRAMES_FROZEN:
        assert len({each[2:] for each in found}) == 1
    else:
        assert min(each[0] - each[1] for each in found) > 0.4


def test_a_camera_without_frames_is_refused():
    with pytest.raises(InputError, match="the rate must be positive"):
        CameraSettings(rate=0.0)


def test_where_nothing_is_seen_nothing_is_sent_and_the_last_sighting_grows_old():
    settings = CameraSettings(dropped=0.0)
    camera = TimedCamera(settings, np.random.default_rng(2))
    for k in range(1000):
        camera.expose(k * 1e-3, lambda now: Sighting(now, 0.5, 0.0, 0.03, 1e-3) if now < 0.5 else None)
        camera.look(k * 1e-3)
    seen = camera.look(2.0)
    assert seen is not None
    assert seen.stamp_s == pytest.approx(0.5, abs=1.0 / settings.rate)
