"""A paddle that follows the disk's mirror image, and catching strokes: limits, momentum, small steps."""

from math import pi

import numpy as np
import pytest

from palmar.mechanics.impact import matched_return_4_3_2 as paddle
from palmar.mechanics.impact.impact_4_1_2 import heavy_finger


def met(gain: float, speed: float, restitution: float) -> tuple[float, float, float]:
    """Where, and how fast they meet, and how fast the disk returns: both moved by small steps, the paddle by its law."""
    z = 0.3 - speed * np.arange(0.0, 0.76, 1e-6)
    told = paddle.mirror_reference(gain, z, speed)
    touch = int(np.argmax(z <= told.position))
    own = float((told.position[touch] - told.position[touch - 1]) / 1e-6)
    relative = speed + own
    return float(z[touch]), relative, own + restitution * relative


@pytest.mark.parametrize(("gain", "e"), [(0.0, 1.0), (0.5, 0.8), (-0.4, 0.5), (-0.8, 0.0), (1.0, 1.0)])
def test_against_small_steps(gain, e):
    found = paddle.mirror_impact(gain, 0.4, e)
    z, relative, back = met(gain, 0.4, e)
    assert z == pytest.approx(0.0, abs=1e-5)
    assert (found.impact, found.returned) == pytest.approx((relative, back), rel=1e-6, abs=1e-9)


def test_the_gains_give_what_they_are_chosen_for():
    for u in (0.05, 0.4, 0.9):
        assert paddle.mirror_impact(paddle.mirror_gain_for_impact(u, 0.4), 0.4, 0.7).impact == pytest.approx(u)
    for q in (0.0, 0.5, 1.0):
        assert paddle.mirror_impact(paddle.mirror_gain_for_return(q, 0.7), 0.4, 0.7).returned == pytest.approx(q * 0.4)


def test_known_gains():
    assert paddle.mirror_gain_for_return(1.0, 1.0) == 0.0, "an elastic wall returns a disk by standing still"
    assert paddle.mirror_gain_for_return(0.0, 1.0) == -0.5, "to stop it dead, the wall yields at half its speed"
    assert paddle.mirror_gain_for_return(0.0, 0.0) == 0.0
    assert paddle.mirror_gain_for_impact(0.0, 0.4) == -1.0


def test_the_return_is_that_of_a_heavy_finger():
    gain, v, e = np.linspace(-0.9, 1.0, 20), 0.4, 0.6
    struck = heavy_finger(1.0, gain * v, -v, e)
    assert paddle.mirror_impact(gain, v, e).returned == pytest.approx(struck, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("catch", [paddle.quadratic_catch, paddle.sinusoidal_catch])
def test_a_catch_takes_the_momentum_and_the_energy_within_the_stroke(catch):
    """Deceleration integrated: the speed is gone at the end of the stroke, the paddle pressing all the while."""
    v, stroke = 0.9, 0.12
    time, most = catch(v, stroke)
    t = np.linspace(0.0, float(time), 200001)
    even = catch is paddle.quadratic_catch
    slowing = np.full(t.shape, float(most)) if even else float(most) * np.sin(v * t / stroke)
    speed = v - np.concatenate([[0.0], np.cumsum(0.5 * (slowing[1:] + slowing[:-1]) * np.diff(t))])
    way = np.sum(0.5 * (speed[1:] + speed[:-1]) * np.diff(t))
    assert speed[-1] == pytest.approx(0.0, abs=1e-8)
    assert way == pytest.approx(stroke, rel=1e-8)
    assert np.all(slowing >= 0.0)
    assert slowing.max() == pytest.approx(float(most), rel=1e-8)


def test_even_deceleration_presses_half_as_hard_as_a_sine():
    v, stroke = np.array([0.2, 1.0]), 0.1
    even, sine = paddle.quadratic_catch(v, stroke), paddle.sinusoidal_catch(v, stroke)
    assert sine.deceleration == pytest.approx(2.0 * even.deceleration)
    assert sine.time / even.time == pytest.approx([pi / 4, pi / 4])
    assert paddle.run_up(v, even.deceleration) == pytest.approx([stroke, stroke])
