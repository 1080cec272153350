"""The tendon law and its inverse, and the places of the tips."""

import numpy as np
import pytest
from scipy.optimize import linprog

from palmar.errors import InputError
from palmar.mechanics.arm.salisbury_finger import (
    chain_in_hand,
    internal,
    joint_torques,
    meeting_curl,
    tensions,
    tip_in_hand,
)
from palmar.models.salisbury_hand import CYLINDRIC, TIP_PREHENSION, SalisburyHand

HAND = SalisburyHand()
TORQUES = np.random.default_rng(3).uniform(-0.5, 0.5, (500, 3))


def test_the_patent_s_law_term_by_term():
    one, two, three = HAND.radii
    t1, t2, t3, t4 = 11.0, 23.0, 31.0, 47.0
    expected = [
        -one * t1 + two * t2 + two * t3 - one * t4,
        three * t1 + two * t2 - two * t3 - three * t4,
        two * t2 - two * t3,
    ]
    assert joint_torques(HAND, np.array([t1, t2, t3, t4])) == pytest.approx(expected)


def test_tensions_make_their_torques_with_the_slackest_at_the_pretension():
    found = tensions(HAND, TORQUES)
    assert np.abs(joint_torques(HAND, found) - TORQUES).max() < 1e-12
    assert found.min(axis=1) == pytest.approx(np.full(len(found), HAND.tension_least))
    assert np.abs(joint_torques(HAND, internal(HAND))).max() < 1e-15


def test_no_other_distribution_pulls_less():
    """A linear programme: the least sum of tensions."""
    for torque in TORQUES[:20]:
        bounds = [(HAND.tension_least, None)] * 4
        best = linprog(np.ones(4), A_eq=HAND.tendon_matrix, b_eq=torque, bounds=bounds)
        assert tensions(HAND, torque).sum() == pytest.approx(best.fun, rel=1e-6)


def test_curls_keep_the_finger_in_its_plane():
    for curl in (TIP_PREHENSION, CYLINDRIC):
        for finger, angle in enumerate(HAND.bases):
            tips = tip_in_hand(HAND, finger, curl.joints(np.linspace(-0.4, 1.0, 15)))
            assert np.abs(tips[:, 0] * np.sin(angle) - tips[:, 1] * np.cos(angle)).max() < 1e-15


def _gap(points, radius):
    """Least distance (m) of the links' surfaces, sampled, from a cylinder on the palm: points (3, 3, 3)."""
    share = np.linspace(0.0, 1.0, 400)[:, None]
    links = [
        (each[i] + share * (each[i + 1] - each[i]), size) for each in points for i, size in ((0, 0.008), (1, 0.009))
    ]
    return min(
        np.hypot(link[:, 1] - HAND.grasp_line, link[:, 2] - radius).min() - size - radius for link, size in links
    )


@pytest.mark.parametrize("radius", [0.025, 0.030, 0.035])
@pytest.mark.parametrize("clearance", [0.0, 0.005])
def test_fingers_are_clear_of_a_cylinder_on_the_palm_up_to_the_meeting_curl(radius, clearance):
    met = meeting_curl(HAND, CYLINDRIC, radius, clearance)

    def gap(curl):
        return _gap([chain_in_hand(HAND, k, CYLINDRIC.joints(np.array(curl))) for k in range(3)], radius)

    assert gap(met) > clearance - 1e-6
    assert gap(met + 0.011) < clearance
    assert all(gap(curl) > clearance - 1e-6 for curl in np.linspace(CYLINDRIC.opened, met, 25))


def test_fingers_that_hold_a_cylinder_on_the_palm_do_not_meet():
    """Tips farther apart than their diameter, up to 0.1 rad beyond the touch."""
    for radius in (0.030, 0.035):
        for curl in meeting_curl(HAND, CYLINDRIC, radius, 0.0) + np.array([0.0, 0.05, 0.1]):
            tips = [tip_in_hand(HAND, k, CYLINDRIC.joints(np.array(curl))) for k in range(3)]
            assert min(np.linalg.norm(tips[i] - tips[i - 1]) for i in range(3)) > 2.0 * HAND.tip_radius + 0.005


def test_bad_numbers_are_refused():
    with pytest.raises(InputError, match="tensions 9 to 2 N"):
        SalisburyHand(tension_least=9.0, tension_most=2.0)
