"""Curls, circles of tips, and circles through tips."""

import numpy as np
import pytest

from palmar.behaviours.cell.tip_circle import alike, circumcentre, curl_for, open_circle, through, tips_at
from palmar.models.salisbury_hand import TIP_PREHENSION, SalisburyHand

HAND = SalisburyHand()


@pytest.mark.parametrize("circle", [0.02, 0.039, 0.07])
def test_at_its_curl_the_tips_are_on_the_circle(circle):
    tips = tips_at(HAND, np.array(alike(curl_for(HAND, circle))))
    assert np.hypot(*tips[:, :2].T) == pytest.approx(circle, abs=1e-5)
    assert np.ptp(tips[:, 2]) < 1e-12


def test_open_is_the_widest():
    assert curl_for(HAND, open_circle(HAND)) == TIP_PREHENSION.opened


def test_circles_through_points():
    centre = np.array([0.01, -0.02])
    points = centre + 0.039 * np.array([[1.0, 0.0], [0.0, 1.0], [-0.6, -0.8]])
    assert circumcentre(points) == pytest.approx(centre)
    assert through(points[0], points[1], 0.039, np.zeros(2)) == pytest.approx(centre)
