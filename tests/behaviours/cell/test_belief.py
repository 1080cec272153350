"""What fingers feel cuts the set of possible places, never past the true one; the hand closes only where that is certain."""

import numpy as np
import pytest
import shapely

from palmar.behaviours.cell.belief import Reasoning, around, standing_turn
from palmar.behaviours.descent import Closing, Descent, Stand
from palmar.mechanics.pushing.three_tips import drift, ends
from palmar.models.cell_task import STANDING
from palmar.models.outcome import Outcome
from palmar.models.salisbury_hand import SalisburyHand

REASONING = Reasoning(SalisburyHand(), STANDING, feel=True)
REACH = REASONING.reach
CAUGHT = [each.code for each in Outcome if each.caught]


def caught(stand: Stand, truth: np.ndarray) -> bool:
    """By the kernel, not by the region."""
    c, s = np.cos(stand.turn), np.sin(stand.turn)
    seen = (truth - (stand.x, stand.y)) @ np.array([[c, -s], [s, c]])
    radii = (STANDING.radius, REACH.tips.tip_radius, REACH.tips.open_radius, REACH.tips.closed_radius)
    return int(ends(radii, 0.0, drift(None, 0.0), seen[None])[0]) in CAUGHT


def touching(stand: Stand, truth: np.ndarray, random: np.random.Generator) -> tuple[bool, ...]:
    """Tips of the plan that land on the top; one beside the rim is felt or not, as it comes."""
    away = np.linalg.norm(np.array(stand.tips) - truth, axis=1)
    felt = (away < STANDING.radius) | ((away < REACH.rho) & (random.random(3) < 0.5))
    return tuple(bool(each) for each in felt)


@pytest.mark.parametrize(("error", "most"), [(0.0315, 2), (0.0415, 3)])
def test_every_cylinder_ends_in_a_closing_that_catches_it(error, most):
    random, descents = np.random.default_rng(2), []
    for _ in range(60):
        way, share = 2.0 * np.pi * random.random(), np.sqrt(random.random())
        truth = error * share * np.array([np.cos(way), np.sin(way)])
        move, count = REASONING.first(error, most), 1
        while isinstance(move, Descent):
            touched, number = touching(move.stand, truth, random), standing_turn(move.stand.turn)[1]
            fingers = tuple(touched[(k - number) % 3] for k in range(3))
            if not any(touched):
                away = truth - np.array(move.stand.tips)
                near = np.linalg.norm(away, axis=1).argmin()
                beside = max(REACH.rho - np.linalg.norm(away[near]), 0.0)
                truth = truth + beside * away[near] / np.linalg.norm(away[near])
            move = REASONING.after_touch(move, fingers, error)
            count += not (isinstance(move, Closing) and move.there)
        assert isinstance(move, Closing)
        assert move.belief.buffer(1e-6).contains(shapely.Point(truth))
        assert caught(move.stand, truth)
        descents.append(count)
    assert max(descents) <= most and max(descents) > 1


def test_a_hand_stands_where_the_plan_has_its_tips():
    for turn in (0.3, -1.9, 2.5, 4.0):
        smallest, number = standing_turn(turn)
        assert abs(smallest) <= np.pi / 3.0
        planned = np.array(Stand(0.01, 0.02, turn, 0.05).tips)
        fingers = np.array(Stand(0.01, 0.02, smallest, 0.05).tips)
        assert fingers[(np.arange(3) + number) % 3] == pytest.approx(planned)


def test_a_touch_that_contradicts_the_set_starts_it_anew_at_the_finger():
    move = REASONING.first(0.005, 4)
    assert isinstance(move, Closing)
    again = REASONING.after_touch(move, (True, False, False), 0.005)
    assert np.linalg.norm(again.belief.centroid.coords[0] - np.array(move.stand.tips[0])) < 1e-3
    assert again.belief.area == pytest.approx(np.pi * 0.0415**2, rel=0.01)


def test_what_closing_would_have_caught_is_left_out():
    move = REASONING.first(0.02, 4)
    left = REASONING.after_nothing(move, around((0.02, 0.0), 0.03)).belief
    assert not left.buffer(-1e-6).contains(shapely.Point(0.0, 0.0))
    assert not left.is_empty and left.area < np.pi * 0.03**2


def test_without_feeling_only_a_certain_closing_is_a_move():
    blind = Reasoning(SalisburyHand(), STANDING, feel=False)
    assert isinstance(blind.first(0.021, 4), Closing)
    assert blind.first(0.025, 4) is None


def test_a_tip_that_slides_off_the_rim_unfelt_has_pushed_the_cylinder_aside():
    stand = Stand(0.0, 0.0, 0.0, 0.025)
    tip = np.array(stand.tips[0])
    outward = tip / np.linalg.norm(tip)
    before = around(tuple(tip + (REACH.rho - 0.004) * outward), 0.003)
    after = dict(REACH.outcomes(before, stand))[("nothing",)]
    assert after.contains(shapely.Point(tip + (REACH.rho + 1e-4) * outward))
    assert not before.contains(shapely.Point(tip + (REACH.rho + 1e-4) * outward))
    assert after.distance(shapely.Point(tip)) == pytest.approx(REACH.rho - REACH.pose_error, abs=1e-4)
