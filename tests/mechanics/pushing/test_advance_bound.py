"""The bound on how an object moves out along a finger, against the closed motion of disks and against simulation."""

import numpy as np
import pytest

from palmar.mechanics.pushing.advance_bound import advance_bound
from palmar.mechanics.pushing.closing_frames import carry_frames
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.slider import disk_slider, polygon_slider, slider_body

RECTANGLE = np.array([[-0.04, -0.027], [0.04, -0.027], [0.04, 0.027], [-0.04, 0.027]])


@pytest.mark.parametrize("friction", [0.0, 0.7])
def test_a_disk_runs_out_at_its_radius(friction):
    advance = advance_bound(disk_slider(0.038), friction, 0.244)
    assert advance.growth == pytest.approx(np.full(len(advance.at), 0.038), rel=1e-6)
    assert advance.lean <= 0.011


@pytest.mark.parametrize("friction", [0.0, 0.3, 0.7])
def test_no_simulated_push_runs_out_faster(friction):
    slider = polygon_slider(RECTANGLE, (0.0, 0.0))
    advance = advance_bound(slider, friction, 0.244)
    motion, rng = hand_motion(0.06, [0.244]), np.random.default_rng(2)
    psi = np.linspace(0.0, 1.2, 241)
    seen = 0.0
    for _ in range(25):
        start = np.array([rng.uniform(0.12, 0.2), rng.uniform(0.05, 0.1), rng.uniform(0.0, 6.28)])
        poses, _ = carry_frames(motion, slider_body(slider, friction), start, psi)
        along = (poses[:, 0] - 0.06) * np.cos(psi) + poses[:, 1] * np.sin(psi)
        pushed = np.hypot(*np.diff(poses[:, :2], axis=0).T) > 1e-9
        rates = np.diff(along) / np.diff(psi)
        inside = pushed & (along[1:] + 0.049 < 0.244) & (poses[1:, 1] > 0.0487)
        bounds = advance.growth[np.searchsorted(advance.at, along[1:].clip(0.0, 0.2439))]
        assert (rates[inside] <= bounds[inside] * (1.0 + 1e-3)).all()
        seen = max(seen, float((rates[inside] / bounds[inside]).max(initial=0.0)))
    assert seen > 0.6
