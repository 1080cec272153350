"""What the tendons' tensions tell: a dead one, and none that only noise makes look so."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.mujoco.cell.finger_sense import FingerSense

HAND = SalisburyHand()
STILL = np.zeros((3, 3))


def first_dead(noise, dead, seconds):
    """When (s) a tendon is said to be dead, None if none is."""
    sense, random = FingerSense(HAND, 1e-3, noise), np.random.default_rng(5)
    for k in range(round(1e3 * seconds)):
        readings = HAND.tension_least + noise * random.standard_normal((3, 4))
        if dead:
            readings[0, 1] = 0.0
        sense.feel(readings, STILL, STILL)
        if sense.dead:
            return 1e-3 * (k + 1)
    return None


@pytest.mark.parametrize("noise", [0.5, 2.0, 10.0, 20.0])
def test_noise_alone_makes_no_tendon_dead(noise):
    assert first_dead(noise, False, 4.0) is None


@pytest.mark.parametrize(("noise", "within"), [(0.5, 0.05), (2.0, 0.06), (20.0, 1.5)])
def test_a_dead_tendon_is_noticed_the_sooner_the_less_noise(noise, within):
    assert first_dead(noise, True, 3.0) < within
