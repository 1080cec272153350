"""What is promised of the cell's tasks, against closed forms and rival computations; and the trials beside it."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from palmar.behaviours.cell.belief import ARM_OFF, GRAIN
from palmar.behaviours.cell.table_pick import SPREAD, Phase
from palmar.mechanics.arm.salisbury_finger import tip_in_hand
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK
from palmar.models.guarantee import Guarantee
from palmar.models.salisbury_hand import CYLINDRIC, SalisburyHand
from palmar.studies.cell_prediction import Predicted, against, palm_first, predict

HAND = SalisburyHand()


def test_one_approach_allows_what_the_closed_form_says_and_more_allow_more():
    found = predict(HAND, TABLE_TASK, most=2)
    assert [each.approaches for each in found] == [1, 2]
    rho = TABLE_TASK.cylinder.radius + HAND.tip_radius
    closed_form = rho / 3.0**0.5 - ARM_OFF - SPREAD
    assert closed_form - GRAIN <= found[0].error <= closed_form
    assert found[0].error < 0.030 < found[1].error < 0.040


def test_nothing_is_promised_of_a_cylinder_that_would_topple():
    assert predict(HAND, replace(TABLE_TASK, cylinder=replace(TABLE_TASK.cylinder, height=0.25))) == ()
    stiff = replace(TABLE_TASK, cylinder=replace(TABLE_TASK.cylinder, height=0.17))
    assert [each.approaches for each in predict(HAND, stiff)] == [1]


def test_a_catch_shrinks_to_where_the_palm_is_met_first():
    """Points along the fingers by the kinematics of shorter ones, the axis at many heights."""
    half, joints = palm_first(HAND, 0.025), CYLINDRIC.joints(np.array(CYLINDRIC.opened))
    near, far = HAND.links
    parts = [(near * share, 1e-12) for share in np.linspace(1e-6, 1.0, 200)]
    parts += [(near, far * share) for share in np.linspace(1e-6, 1.0, 200)]
    points = np.array([tip_in_hand(replace(HAND, links=each), k, joints)[1:] for each in parts for k in range(3)])
    nearest = []
    for off in (half - 2e-4, half + 2e-4):
        places = [(HAND.grasp_line + side, z) for side in (off, -off) for z in np.linspace(0.025, 0.2, 400)]
        nearest.append(np.linalg.norm(np.array(places)[:, None] - points, axis=-1).min())
    assert nearest[1] < 0.025 + HAND.link_radius < nearest[0]
    (only,) = predict(HAND, FLOATING_TASK)
    assert (only.approaches, only.guarantee) == (1, Guarantee.CONSTRUCTION)
    assert only.error == only.along_across[1] < half


def test_a_slim_cylinder_is_felt_over_the_sensors_whole_width():
    assert palm_first(HAND, 0.008) == pytest.approx(HAND.pads[1], abs=2e-5)


@dataclass(frozen=True)
class Result:
    success: bool
    phases: tuple[tuple[float, str], ...]


def report(error: float, biases: list[tuple[float, float]], results: list[Result]) -> SimpleNamespace:
    def settings(k: int) -> SimpleNamespace:
        return SimpleNamespace(camera=SimpleNamespace(bias=biases[k]))

    return SimpleNamespace(trials=SimpleNamespace(error=error, settings=settings), results=results)


def test_trials_are_counted_beside_the_prediction():
    once, twice = ((0.0, Phase.OVER.value),), ((0.0, Phase.OVER.value), (1.0, Phase.OVER.value))
    promise = (Predicted(1, 0.02, "", Guarantee.CLOSED_FORM), Predicted(2, 0.03, "", Guarantee.CLOSED_FORM))
    ran = [Result(True, once), Result(False, once), Result(True, twice)]
    found = against(report(0.02, [(0.0, 0.0)] * 3, ran), promise)
    assert (found.inside, found.lost_inside, found.more_inside, found.outside) == (3, 1, 1, 0)
    assert against(report(0.03, [(0.0, 0.0)] * 3, ran), promise).more_inside == 0
    assert against(report(0.04, [(0.0, 0.0)] * 3, ran), promise).caught_outside == 2
    strip = (Predicted(1, 0.01, "", Guarantee.CONSTRUCTION, (0.05, 0.01)),)
    found = against(report(0.05, [(0.04, 0.009), (0.0, -0.02), (0.06, 0.0)], ran), strip)
    assert (found.inside, found.outside, found.caught_outside) == (1, 2, 1)
