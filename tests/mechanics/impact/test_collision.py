"""One impact: the published formula with its limits, conservation, friction; fingers that impacts slow down."""

from math import cos, inf, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.errors import NotCoveredError
from palmar.mechanics.impact.capture import capture, capture_all
from palmar.mechanics.impact.capture_hand import closing_hand
from palmar.mechanics.impact.capture_run import capture_on
from palmar.mechanics.impact.capture_state import IMPACT, bench
from palmar.mechanics.impact.collision import ImpactLaw, after_impact, effective_restitution, rod_inertia
from palmar.mechanics.impact.finger_motion import turned
from palmar.models.outcome import Outcome

PARTS = st.floats(0.05, 20.0)
SPEEDS = st.floats(-5.0, 5.0)


@settings(deadline=None)
@given(PARTS, PARTS, PARTS, st.floats(0.0, 1.0), SPEEDS, SPEEDS)
def test_the_published_velocity_and_what_is_conserved(mass, finger_mass, arm, e, rate, speed):
    """Equation 4.5 with the right sign; angular momentum about the base, and for e = 1 the energy."""
    length, normal = 20.0, np.array([-sin(0.4), cos(0.4)])
    inertia, tangent = rod_inertia(finger_mass, length), np.array([cos(0.4), sin(0.4)])
    law = ImpactLaw(mass, inertia, 0.0)
    wall, velocity = arm * rate * normal, speed * normal + 1.5 * tangent
    vx, vy, spin, change = after_impact(law, e, 1.0, *normal, *wall, -arm, *velocity, 0.7)
    after, heavy = np.array([vx, vy]), finger_mass * length**2
    published = (heavy * (1 + e) * arm * rate + speed * (3 * mass * arm**2 - e * heavy)) / (heavy + 3 * mass * arm**2)
    scale = 1.0 + abs(speed) + abs(arm * rate)
    assert after @ normal == pytest.approx(published, abs=1e-12 * scale)
    assert after @ tangent == pytest.approx(1.5, abs=1e-12 * scale)
    assert spin == 0.7
    momentum = mass * arm * (after @ normal - speed) + inertia * change
    assert momentum == pytest.approx(0.0, abs=1e-12 * (mass * arm + inertia) * scale)
    parting = after @ normal - arm * (rate + change)
    assert parting == pytest.approx(-e * (speed - arm * rate), abs=1e-12 * scale)
    lost = 0.5 * mass * (speed**2 - (after @ normal) ** 2) + 0.5 * inertia * (rate**2 - (rate + change) ** 2)
    reduced = mass * inertia / (inertia + mass * arm**2)
    expected = 0.5 * reduced * (1.0 - e**2) * (speed - arm * rate) ** 2
    assert lost == pytest.approx(expected, abs=1e-11 * (mass + inertia) * (scale + abs(rate) * 25.0) ** 2)


@settings(deadline=None)
@given(PARTS, PARTS, st.floats(0.0, 1.0))
def test_a_rate_restored_at_once_lowers_the_restitution_and_never_below_0(mass, arm, e):
    law = ImpactLaw(mass, 400.0)
    lower = effective_restitution(law, e, arm)
    assert lower == pytest.approx(max((e * 400.0 - mass * arm**2) / (400.0 + mass * arm**2), 0.0), rel=1e-12, abs=1e-15)
    assert effective_restitution(ImpactLaw(mass), e, arm) == e
    _, vy, _, change = after_impact(law, e, 1.0, 0.0, 1.0, 0.0, 2.0, -arm, 0.0, -1.0, 0.0)
    assert vy - 2.0 == pytest.approx(3.0 * lower, abs=1e-12)
    assert change == 0.0


@settings(deadline=None)
@given(st.floats(0.0, 3.0), SPEEDS, SPEEDS, st.floats(0.0, 1.0))
def test_friction_stops_the_slip_or_spends_the_cone_and_never_adds_energy(mu, along, spin, e):
    law, radius = ImpactLaw(friction=mu), 2.0
    vx, vy, after, _ = after_impact(law, e, radius, 0.0, 1.0, 0.3, 0.5, 0.0, along, -2.0, spin)
    slip, left = along - 0.3 + radius * spin, vx - 0.3 + radius * after
    push = (1.0 + e) * 2.5
    assert vy == pytest.approx(0.5 + e * 2.5)
    assert abs(vx - along) <= mu * push + 1e-12
    assert left == pytest.approx(0.0, abs=1e-12) or abs(abs(vx - along) - mu * push) < 1e-12
    assert left * slip >= -1e-12
    assert vx - along == pytest.approx(0.5 * radius * (after - spin), abs=1e-12)  # both by one impulse
    energy = [
        u**2 + w**2 + 0.5 * radius**2 * turn**2
        for u, w, turn in ((along - 0.3, 2.5, spin), (vx - 0.3, vy - 0.5, after))
    ]
    assert energy[1] <= energy[0] + 1e-12


HAND = closing_hand(6.0, [24.4], 3.8)
PLACES = np.random.default_rng(0).uniform([0.0, 3.8], [20.0, 24.0], (3000, 2))


def test_a_very_heavy_finger_is_the_same_whether_restored_or_not():
    plain = capture_all(HAND, PLACES).codes
    for law in (ImpactLaw(1.0, 1e12), ImpactLaw(1.0, 1e12, 1e14)):
        codes = capture_all(HAND, PLACES, law=law).codes
        assert (codes == plain).mean() > 0.995


def test_lighter_fingers_catch_more():
    shares = []
    for ratio in (inf, 100.0, 10.0, 4.0):
        law = ImpactLaw(1.0, rod_inertia(ratio, 24.4))
        shares.append((capture_all(HAND, PLACES, law=law).codes == Outcome.CAGED.code).sum())
    assert shares == sorted(shares)
    assert shares[-1] > 1.1 * shares[0]


def test_without_motor_and_loss_the_energy_of_disk_and_fingers_stays():
    inertia = rod_inertia(3.0, 24.4)
    law, checked = ImpactLaw(1.0, inertia, 0.0), 0
    for place in PLACES[:60]:
        for most in (2, 3, 5):
            at = bench(HAND, 50)
            capture_on(HAND, law, at, *place, 0.0, 0.0, 0.0, 1.0, most)
            s = at.state
            rates = [turned(at.fingers[f], 0, s[0])[1] for f in range(2)]
            if min(abs(rate) for rate in rates) == 0.0 or s[9] == 0.0:
                continue  # a stop takes energy
            energy = 0.5 * (s[3] ** 2 + s[4] ** 2) + 0.5 * inertia * (rates[0] ** 2 + rates[1] ** 2)
            assert energy == pytest.approx(inertia, rel=1e-12)
            checked += 1
    assert checked > 60


def test_a_slowed_finger_is_back_at_its_rate_when_its_motor_has_made_up_for_the_impulse():
    inertia, torque = rod_inertia(3.0, 24.4), 2000.0
    law = ImpactLaw(1.0, inertia, torque)
    _, _, events = capture(HAND, (14.0, 6.0), law=law)
    first = events[events[:, 1] == IMPACT][0]
    arm = (first[4] - 6.0) * cos(first[0]) + first[5] * sin(first[0])
    slowed = first[9] / cos(first[0]) * arm / inertia  # J X / I with J = m |v'|
    at = bench(HAND, 0)
    capture_on(HAND, law, at, 14.0, 6.0, 0.0, 0.0, 0.0, 1.0, 2)
    assert at.state[0] == pytest.approx(first[0] + slowed * inertia / torque, rel=1e-9) or len(events) > 3
    angle, rate = turned(at.fingers[0], 0, at.state[0])
    assert rate == pytest.approx(1.0, abs=1e-12)
    assert angle == pytest.approx(at.state[0] - 0.5 * slowed**2 * inertia / torque, abs=1e-9)


def test_with_a_motor_every_start_is_decided_and_more_torque_comes_nearer_to_restored():
    inertia, codes = rod_inertia(4.0, 24.4), []
    for torque in (100.0, 1e4, 1e5, inf):
        found = capture_all(HAND, PLACES, law=ImpactLaw(1.0, inertia, torque), restitution=0.8)
        assert (found.codes == Outcome.UNDECIDED.code).mean() < 0.002
        codes.append(found.codes)
    alike = [(each == codes[-1]).mean() for each in codes[:-1]]
    assert alike[0] < alike[2]
    assert alike[2] > 0.97


def test_what_is_not_modelled_is_refused():
    jointed = closing_hand(6.0, [13.7, 10.7], 3.8, offsets=[0.3])
    with pytest.raises(NotCoveredError, match="torque"):
        capture(jointed, (8.0, 9.0), law=ImpactLaw(1.0, 100.0, 5.0))
    thick = closing_hand(6.0, [24.4], 3.8, 1.0)
    with pytest.raises(NotCoveredError, match="friction"):
        capture(thick, (8.0, 9.0), law=ImpactLaw(1.0, 100.0, friction=0.5))
    assert thick.times[-1] < pi
