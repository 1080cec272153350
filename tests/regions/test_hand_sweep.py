"""All that a hand may touch, against disks placed outside of it."""

from math import pi

import numpy as np
import shapely
from shapely import box

from palmar.mechanics.pushing.closing_case import straight_motion
from palmar.models.hand import Hand
from palmar.regions.hand_sweep import may_be_touched
from palmar.studies.plan_trial import drawn_starts
from palmar.worlds.planar.feeling import NOTHING, go_until_touched

HAND = Hand(palm_width=0.12, finger_links=(0.137, 0.107))


def test_all_that_closing_touches_lies_in_what_it_may_touch() -> None:
    """Disks outside of it are clear of the still hand at every angle between, and of the hand as it comes and goes."""
    hand, radius = HAND.model_copy(update={"finger_thickness": 0.02}), 0.03
    last = straight_motion(hand).last
    for opening in (0.0, 0.8):
        swept = may_be_touched(hand, radius, opening, last, 3.0)
        places = drawn_starts(box(-0.6, -0.5, 0.6, 0.6), 4000, 1)
        outside = places[~shapely.contains_xy(swept, places)]
        assert 500 < len(outside) < 3500
        for psi in np.linspace(opening, min(last, pi), 40):
            touch = go_until_touched(hand, (), float(psi), radius, outside + np.array([0.0, 1.0]), 1.0)
            assert (touch.sensors == NOTHING).all()
