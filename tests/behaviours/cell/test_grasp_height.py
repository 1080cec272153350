"""Heights at which tips may push: bounded by the table below and by toppling above."""

from dataclasses import replace

import pytest

from palmar.behaviours.cell.grasp_height import grasp_heights
from palmar.models.cell_task import STANDING
from palmar.models.salisbury_hand import SalisburyHand

HAND = SalisburyHand()


def heights(**changed):
    return grasp_heights(HAND, replace(STANDING, **changed))


def test_a_push_stays_where_the_cylinder_slides_for_certain():
    found = heights()
    assert found.bound == pytest.approx(STANDING.radius * (1.0 / 0.3 - 0.7))
    assert found.lowest == pytest.approx(STANDING.height + 0.002)
    assert 0.0 < found.pushes[0] < found.pushes[1] < found.bound
    assert found.refusal is None and found.by_palm


def test_a_tall_cylinder_is_refused_with_its_heights():
    assert "push 179 mm" in heights(height=0.280).refusal and "below 79 mm" in heights(height=0.280).refusal
    assert heights(height=0.280, radius=0.080).refusal is None


def test_a_short_one_keeps_the_tips_off_the_table():
    found = heights(height=0.06)
    assert found.refusal is None and not found.by_palm
    assert found.pushes[0] == pytest.approx(HAND.tip_radius + 0.003)


def test_one_that_topples_at_its_rim_is_not_felt_for():
    assert heights(height=0.100).rim == 0.0
    assert heights().may_feel and not heights(height=0.170).may_feel
