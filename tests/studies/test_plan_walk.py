"""An object's way through a plan: what is known of it always holds it, and it ends in the grasp."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from shapely import Point, box

from palmar.models.sensors import SensorLayout
from palmar.studies.plan import plan
from palmar.studies.plan_walk import longest_way, walk
from studies.test_plan import case_of


@pytest.mark.parametrize("uncertainty", [Point(0.0, 0.0).buffer(0.28), box(-0.45, -0.1, 0.45, 0.1)])
def test_the_belief_holds_the_object_and_shrinks(uncertainty) -> None:
    case = case_of(SensorLayout.DISTRIBUTED)
    found = plan(case, uncertainty, (0.0, 0.5), 3)
    for seed in range(3):
        moments = list(walk(case, found, longest_way(case, found, seed)))
        known = [each for each in moments if each.doing != "close"]
        assert all(shapely.distance(each.belief, Point(each.thing)) < 1e-6 for each in known)
        areas = np.array(
            [each.belief.area for each in known if each.doing in ("approach", "placed: closing catches it")]
        )
        assert areas[-1] < 0.5 * areas[0]
        right, left = moments[-1].fingers
        assert min(right, left) > 1.0


def test_the_object_stays_until_the_fingers_close() -> None:
    case = case_of(SensorLayout.DISTRIBUTED)
    found = plan(case, Point(0.0, 0.0).buffer(0.28), (0.0, 0.6), 2)
    moments = list(walk(case, found, (0.1, 0.7)))
    assert {each.thing for each in moments if each.doing != "close"} == {(0.1, 0.7)}
    hand, thing = moments[-1].hand, moments[-1].thing
    assert np.hypot(thing[0] - hand[0], thing[1] - hand[1]) < 0.3
