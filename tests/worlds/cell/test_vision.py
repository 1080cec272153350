"""What vision's process sends: frames with their numbers, stamped when the light left the scene."""

import numpy as np
import pytest

from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.pose_camera import PoseCamera
from palmar.worlds.cell.timed_camera import CameraSettings, TimedCamera
from palmar.worlds.cell.timing import percentiles

pytest.importorskip("zenoh", reason="needs the extra palmar[realtime]")

from palmar.worlds.cell.vision import AXIS, PoseSight, Retina
from palmar.worlds.cell.wire import Light

SETTINGS = CameraSettings(latency=0.0, jitter=0.0, noise=0.0, dropped=0.2, bias=(0.01, -0.02))


def sent(fault: Fault) -> list[tuple[int, float]]:
    """Number and stamp of what arrives in 4 s of light that is 10 ms old."""
    qpos = np.zeros(22)
    qpos[AXIS] = 0.5, 0.1
    retina = Retina(PoseSight(PoseCamera(SETTINGS, np.random.default_rng(0)), 0.03))
    camera, found = TimedCamera(SETTINGS, np.random.default_rng(1), fault), []
    for now in np.arange(0.0, 4.0, 0.002):
        retina.light = Light(stamp_s=float(now) - 0.01, epoch_s=0.0, qpos=tuple(qpos.tolist()))
        camera.expose(float(now), retina.see)
        for number, sighting in camera.arrivals(float(now)):
            assert (sighting.x_m, sighting.y_m) == pytest.approx((0.51, 0.08))
            assert now - sighting.stamp_s == pytest.approx(0.01)
            found.append((number, sighting.stamp_s))
    return found


def test_every_frame_has_its_number_and_lost_ones_leave_gaps():
    numbers = [number for number, _ in sent(Fault())]
    assert numbers == sorted(set(numbers))
    assert 110 < numbers[-1] <= 121
    assert len(numbers) == pytest.approx(0.8 * numbers[-1], abs=12)


@pytest.mark.parametrize("kind", [FaultKind.CAMERA_KILLED, FaultKind.VISION_KILLED])
def test_nothing_is_taken_once_the_camera_or_vision_is_gone(kind):
    assert max(stamp for _, stamp in sent(Fault(kind, 1.0))) < 1.0


def test_percentiles_are_of_all_runs_together():
    found = percentiles([np.arange(0.0, 50.0), np.arange(50.0, 101.0)])
    assert found == {"median": 50.0, "p95": 95.0, "p99": 99.0, "max": 100.0}
    assert percentiles([])["median"] is None
