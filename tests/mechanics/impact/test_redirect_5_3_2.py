"""Windows of paths that a still, preshaped hand turns to its palm: the capture kernel meets the same bodies in turn."""

from __future__ import annotations

from dataclasses import replace
from math import cos, inf, radians, sin, tan

import numpy as np
import pytest

from palmar.mechanics.impact.capture import capture
from palmar.mechanics.impact.capture_hand import programmed_hand
from palmar.mechanics.impact.capture_state import IMPACT
from palmar.mechanics.impact.redirect_5_3_2 import (
    NOTHING,
    PreshapedHand,
    across,
    direct_window,
    redirected_window,
    width,
)
from palmar.models.shipped import open_case
from palmar.studies.redirect import catch_of, redirection

HAND = PreshapedHand(0.06, (0.137, 0.107), 0.0, 0.02, radians(40.0), radians(10.0))
WIDE = PreshapedHand(0.06, (0.137, 0.107), 0.0, 0.038, radians(30.0), radians(30.0))
THICK = PreshapedHand(0.06, (0.137, 0.107), 0.008, 0.02, radians(60.0), radians(5.0))
STRAIGHT_IN = np.array([0.0, -1.0])


def met(hand: PreshapedHand, direction: np.ndarray, aside: float, restitution: float) -> list[tuple[int, int]]:
    """(body, feature) of the first two impacts of a disk on the path ``aside`` (m), in the capture kernel."""
    # It comes from far away, while the fingers, too slow to matter, close.
    far = -3.0 * direction + aside * across(direction)
    still = programmed_hand(
        hand.half_palm, hand.links, hand.radius, hand.half_thickness, np.array([[hand.base, hand.bend]] * 2),
        [(inf, np.array([[1e-9, 0.0]] * 2))],
    )  # fmt: skip
    events = capture(still, far, direction, restitution, most_events=4)[2]
    return [(int(row[2]), int(row[3])) for row in events if row[1] == IMPACT][:2]


@pytest.mark.parametrize(
    ("hand", "degrees", "restitution", "side"),
    [
        (HAND, -90.0, 0.4, 1.0),
        (HAND, -90.0, 0.4, -1.0),
        (HAND, -80.0, 0.4, 1.0),
        (WIDE, -90.0, 1.0, 1.0),
        (THICK, -100.0, 0.6, -1.0),
    ],
)
def test_paths_in_the_window_meet_the_link_and_then_the_palm(
    hand, degrees: float, restitution: float, side: float
) -> None:
    direction = np.array([cos(radians(degrees)), sin(radians(degrees))])
    found = redirected_window(hand, direction, restitution, side)
    assert width(found) > 0.005
    body = 2 if side > 0.0 else 4
    tiny = 1e-4
    for share in (0.05, 0.5, 0.95):
        impacts = met(hand, direction, found[0] + share * width(found), restitution)
        assert impacts == [(body, 0), (0, 0)]
    for outside in (found[0] - tiny, found[1] + tiny):
        assert met(hand, direction, outside, restitution) != [(body, 0), (0, 0)]


def test_straight_in_the_palm_itself_is_the_direct_window() -> None:
    side = 0.06 - 0.02 * tan(radians(20.0))
    assert direct_window(HAND, STRAIGHT_IN) == pytest.approx((-side, side))
    assert direct_window(HAND, -STRAIGHT_IN) == NOTHING
    narrow = PreshapedHand(0.06, (0.137, 0.107), 0.0, 0.02, radians(92.0), 0.0)
    tip = narrow.points(1.0)[2]
    assert direct_window(narrow, STRAIGHT_IN) == pytest.approx((-(tip[0] - 0.02), tip[0] - 0.02))


def test_a_window_is_mirrored_with_the_hand_and_the_direction() -> None:
    one = redirected_window(HAND, np.array([0.2, -0.9]) / np.hypot(0.2, 0.9), 0.4, 1.0)
    other = redirected_window(HAND, np.array([-0.2, -0.9]) / np.hypot(0.2, 0.9), 0.4, -1.0)
    assert one == pytest.approx((-other[1], -other[0]))


def test_the_best_preshape_for_the_test_bed() -> None:
    """As wide as two thirds more than the palm, and no neighbour is better."""
    _, case = open_case("testbed_free")
    case = case.model_copy(update={"contact": case.contact.model_copy(update={"restitution": 1.0})})
    found = redirection(case, radians(-90.0))
    assert found is not None
    assert found.catch.width == pytest.approx(0.1970, abs=1e-3)
    for base, bend in ((0.02, 0.0), (-0.02, 0.0), (0.0, 0.02), (0.0, -0.02)):
        near = replace(found.hand, base=found.hand.base + base, bend=found.hand.bend + bend)
        assert catch_of(near, radians(-90.0), 1.0).width <= found.catch.width
    low, high = found.cone
    assert low == pytest.approx(-np.pi - high)
    assert catch_of(found.hand, low - 0.01, 1.0).width < 0.5 * found.catch.width <= catch_of(found.hand, low, 1.0).width
