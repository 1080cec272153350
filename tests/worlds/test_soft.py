"""Soft contacts: forces as the closed forms say, outcomes as with rigid ones, reflexes that feel forces."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from palmar.behaviours.build import reflex_of
from palmar.behaviours.close import Closing
from palmar.behaviours.reflex import Drive
from palmar.errors import NotCoveredError
from palmar.mechanics.impact import impact_force_4_3_2 as force
from palmar.mechanics.impact.capture import capture_all
from palmar.mechanics.impact.force_feedback_4_3_2 import characteristic_polynomial, gain_limit
from palmar.mechanics.impact.soft_4_3_2 import (
    ANGLE,
    FELT_WIDTH,
    MOMENT,
    MOTOR,
    PEAK,
    RATE,
    SPIN,
    STATE_WIDTH,
    VX,
    VY,
    SoftHand,
    X,
    Y,
    advance,
    steps_for,
)
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.outcome import Outcome
from palmar.worlds.planar.free import free_world
from palmar.worlds.planar.soft import soft_world
from palmar.worlds.run import Trace, run

LENGTH, RADIUS, MASS, FOOT, STIFF = 0.244, 0.038, 0.5, 0.15, 2e4
INERTIA = 0.4 * LENGTH**2 / 3.0
HAND = SoftHand(0.06, LENGTH, 0.0, -1.0, 3.0, INERTIA, 0.0, 0.0, RADIUS, MASS, STIFF, 0.0, 0.0)
LIMP = np.array([0.0, 0.0, 0.0, 0.0])


def struck(hand: SoftHand, rate: float, seconds: float = 0.03) -> tuple[np.ndarray, np.ndarray]:
    """State and felt after a free right finger at ``rate`` has met a disk at rest that it touches at FOOT."""
    state, felt = np.zeros(STATE_WIDTH), np.zeros(FELT_WIDTH)
    state[X], state[Y], state[RATE] = hand.half_palm + FOOT, hand.radius + 1e-9, rate
    advance(hand, state, LIMP, felt, seconds, steps_for(hand, seconds), np.zeros(STATE_WIDTH), np.zeros(STATE_WIDTH))
    return state, felt


@pytest.mark.parametrize("zeta", [0.0, 0.3])
def test_an_impact_is_as_the_closed_forms_say(zeta: float) -> None:
    """Peak, restitution and momentum about the base; the finger turns by a few mrad in it, hence the tolerance."""
    state, felt = struck(HAND._replace(damping=zeta), 0.2)
    mass, speed = float(force.effective_mass(MASS, FOOT, INERTIA)), 0.2 * FOOT
    assert felt[PEAK] == pytest.approx(float(force.peak_force(mass, speed, STIFF, zeta)), rel=2e-3)
    parting = state[VY] * np.cos(state[ANGLE]) - state[VX] * np.sin(state[ANGLE]) - state[RATE] * FOOT
    assert parting == pytest.approx(float(force.restitution(zeta)) * speed, rel=2e-3)
    about_base = MASS * ((state[X] - 0.06) * state[VY] - state[Y] * state[VX]) + INERTIA * state[RATE]
    assert about_base == pytest.approx(INERTIA * 0.2, rel=1e-4)


def test_without_damping_energy_stays_and_friction_stops_slip() -> None:
    state, _ = struck(HAND, 0.2)
    energy = 0.5 * MASS * (state[VX] ** 2 + state[VY] ** 2) + 0.5 * INERTIA * state[RATE] ** 2
    assert energy == pytest.approx(0.5 * INERTIA * 0.2**2, rel=1e-4)
    state, felt = np.zeros(STATE_WIDTH), np.zeros(FELT_WIDTH)
    state[[X, Y, VX, VY]] = 0.0, RADIUS + 1e-9, 0.02, -0.1
    scratch = np.zeros(STATE_WIDTH), np.zeros(STATE_WIDTH)
    advance(HAND._replace(friction=1.0), state, LIMP, felt, 0.05, 5000, *scratch)
    assert state[VY] > 0.09
    # A rim that stops slipping keeps two thirds of the slip as the disk's motion (Routh).
    assert state[VX] == pytest.approx(0.02 * 2.0 / 3.0, rel=2e-3)
    assert state[SPIN] == pytest.approx(-state[VX] / RADIUS, rel=3e-3)


def test_thick_fingers_and_the_left_side_mirror() -> None:
    thick = HAND._replace(half_thickness=0.0125, radius=RADIUS, friction=0.5)
    right, left = np.zeros(STATE_WIDTH), np.zeros(STATE_WIDTH)
    right[[X, Y, VX, VY, SPIN, RATE]] = 0.16, 0.0506, 0.01, -0.02, 0.3, 0.3
    left[:] = right
    left[[X, VX, SPIN]] *= -1.0
    left[[RATE, RATE + 1]] = 0.0, 0.3
    felt, scratch = np.zeros(FELT_WIDTH), (np.zeros(STATE_WIDTH), np.zeros(STATE_WIDTH))
    before = MASS * ((right[X] - 0.06) * right[VY] - right[Y] * right[VX] + 0.5 * RADIUS**2 * right[SPIN])
    for state in (right, left):
        advance(thick, state, LIMP, felt, 0.03, 3000, *scratch)
    assert left[[X, VX, SPIN]] == pytest.approx(-right[[X, VX, SPIN]])
    assert left[[Y, VY]] == pytest.approx(right[[Y, VY]])
    assert left[RATE + 1] == pytest.approx(right[RATE])
    # Nothing else acts on finger and disk: their angular momentum about the base joint stays, friction and all.
    after = MASS * ((right[X] - 0.06) * right[VY] - right[Y] * right[VX] + 0.5 * RADIUS**2 * right[SPIN])
    assert after + INERTIA * right[RATE] == pytest.approx(before + INERTIA * 0.3, rel=1e-9)


@pytest.mark.parametrize("share", [0.5, 2.0])
def test_force_feedback_grows_as_its_polynomial_says(share: float) -> None:
    """A finger on a disk that cannot move: the swing of the moment grows, or dies, at the rate of the slowest root."""
    lag, zeta, wanted = 5e-3, 0.1, 1.5
    hand = HAND._replace(limit=1e9, lag=lag, mass=1e9, damping=zeta)
    m = INERTIA / FOOT**2
    c = 2.0 * zeta * sqrt(STIFF * m)
    gain = share * float(gain_limit(m, c, STIFF, lag))
    state, felt = np.zeros(STATE_WIDTH), np.zeros(FELT_WIDTH)
    state[X], state[Y], state[MOTOR] = 0.06 + FOOT, RADIUS - wanted / FOOT / STIFF, 1.002 * wanted
    scratch, dt, off = (np.zeros(STATE_WIDTH), np.zeros(STATE_WIDTH)), 2e-5, []
    for _ in range(7000):
        told = np.array([0.0, 0.0, wanted + gain * (wanted + felt[MOMENT]), 0.0])
        advance(hand, state, told, felt, dt, 1, *scratch)
        off.append(abs(-felt[MOMENT] - wanted))
    peaks = [i for i in range(1, len(off) - 1) if off[i - 1] <= off[i] > off[i + 1]][2:]
    growth = np.polyfit(dt * np.array(peaks), np.log(np.array(off)[peaks]), 1)[0]
    root = np.roots(characteristic_polynomial(gain, m, c, STIFF, lag)).real.max()
    assert growth == pytest.approx(root, rel=0.03, abs=0.2)


TEXT = """[hand]
palm_width_mm = 120
finger_links_mm = [244]
finger_rate_deg_s = 60
finger_mass_kg = 0.4
{hand}
[object]
radius_mm = 38
mass_kg = 0.5
[contact]
friction = 0
restitution = {e}
stiffness_N_mm = {k}
[support]
kind = "free"
[start]
at_mm = [60, 110]
[behaviour]
{behaviour}
"""


def case_of(
    behaviour: str = 'name = "close"', hand: str = "finger_torque_N_m = 0.3", e: float = 0.6, k: float = 20
) -> Case:
    return parse_case(TEXT.format(behaviour=behaviour, hand=hand, e=e, k=k))


def run_of(case: Case, tick: float = 0.005) -> Trace:
    return run(soft_world(case, (*case.start.at, 0.0), tick=tick), reflex_of(case), longest=30.0)


def first_peak(trace: Trace) -> float:
    """The largest force (N) within 50 ms of the first touch."""
    since = next(row.seen.time for row in trace.rows if max(row.seen.forces) > 0.0)
    return max(max(row.seen.forces) for row in trace.rows if row.seen.time < since + 0.05)


def test_stiff_contacts_end_as_rigid_ones() -> None:
    """Closing from 12 starts; fingers that give way and whose motors bring them back at once."""
    case, rng = case_of(hand="", e=0.6, k=200), np.random.default_rng(4)
    starts = np.column_stack([rng.uniform(-0.2, 0.2, 12), rng.uniform(0.04, 0.25, 12)])
    rigid = free_world(case)
    whole = capture_all(rigid.hand, starts, np.zeros((12, 2)), 0.6, law=rigid.law)
    for start, code in zip(starts, whole.codes, strict=True):
        world = soft_world(case, (*start, 0.0), tick=0.05)
        assert (
            run(world, Closing(Drive(1, case.hand.finger_rate))).outcome.caught == Outcome.from_code(int(code)).caught
        )
    assert 2 < (whole.codes <= Outcome.CAGED.code).sum() < 10


def test_touching_down_is_softer_by_the_ratio_of_rates() -> None:
    """Peaks of the first touches: the approach speed is X times the rate, 60 against 5 degrees a second."""
    hard, soft = (run_of(case_of(f'name = "{name}"\nuncertainty_mm = 0.001')) for name in ("close", "touch_down"))
    assert first_peak(soft) / first_peak(hard) == pytest.approx(5.0 / 60.0, rel=0.1)
    assert hard.outcome is soft.outcome is Outcome.CAGED
    forces = [max(row.seen.forces) for row in hard.rows]
    assert 0.0 in forces[forces.index(max(forces)) :], "what is felt is what was felt since the last observation"


def test_letting_go_is_softer_than_driving_on() -> None:
    driven = run_of(case_of())
    let_go = run_of(case_of('name = "let_go"\ntrigger_N = 1\nlimp_s = 0.1'), tick=0.001)
    whys = [each.what for each in let_go.happenings if each.kind == "does"]
    assert whys.count("let go of a finger") == 2
    assert first_peak(let_go) < 0.95 * first_peak(driven)
    assert let_go.outcome is Outcome.CAGED


def test_force_feedback_hammers_about_the_grip_that_it_wants() -> None:
    """At a gain far above the limit the moments of both contacts swing, about the one wanted."""
    asked = 'name = "force_feedback"\ngrip_N_m = 0.1\ngain = 3\npatience_s = 3'
    trace = run_of(case_of(asked, hand="finger_torque_N_m = 0.3\ndrive_lag_s = 0.005"), tick=0.001)
    moments = np.array([row.seen.moments for row in trace.rows[-500:]])
    assert moments.mean(axis=0) == pytest.approx([0.1, 0.1], rel=0.15)
    assert (moments.std(axis=0) > 0.03).all()
    assert [each.what for each in trace.happenings if each.kind == "does"][-1] == "the time to grip is over"


def test_what_the_soft_world_does_not_have() -> None:
    rough = case_of()
    for change, words in (
        ({"contact": rough.contact.model_copy(update={"stiffness": None})}, "stiffness_N_mm absent"),
        ({"hand": rough.hand.model_copy(update={"finger_mass": None, "finger_torque": None})}, "finger_mass_kg absent"),
    ):
        with pytest.raises(NotCoveredError, match=words):
            soft_world(rough.model_copy(update=change), (0.0, 0.1, 0.0))
    world = soft_world(rough, (0.0, 0.1, 0.0))
    with pytest.raises(NotCoveredError, match="arm cannot move"):
        world.act(replace(Drive(1, 0.5).close("close"), velocity=(0.1, 0.0)), 0.01)
    assert soft_world(rough, (0.0, 0.02, 0.0)).broken
    with pytest.raises(NotCoveredError, match="does not reach"):
        reflex_of(
            case_of('name = "touch_down"').model_copy(
                update={"start": rough.start.model_copy(update={"at": (0.0, 0.5)})}
            )
        )
