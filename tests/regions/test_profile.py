"""The profile of a hand against distances from its links, which know nothing of it."""

from __future__ import annotations

from math import cos, pi, radians, sin

import numpy as np
import pytest
from shapely import LineString, Point

from palmar.models.case_file import build_case
from palmar.models.hand import Hand
from palmar.models.sensors import SensorLayout, Sensors, Stretch
from palmar.regions.profile import DEAD, profile

HANDS = {
    "bed": (Hand(palm_width=0.12, finger_links=(0.137, 0.107)), 0.038),
    "thick": (Hand(palm_width=0.12, finger_links=(0.137, 0.107), finger_thickness=0.02), 0.038),
    "short": (Hand(palm_width=0.3, finger_links=(0.1,), finger_thickness=0.012), 0.05),
}


def clearance(hand: Hand, radius: float, opening: float, x: float, y: float) -> float:
    """Distance (m) of a disk at (x, y) from the hand."""
    place, gaps = Point(x, y), [LineString([(-hand.half_palm, 0), (hand.half_palm, 0)]).distance(Point(x, y)) - radius]
    for side in (1.0, -1.0):
        base = (side * hand.half_palm, 0.0)
        tip = (base[0] + side * hand.finger_length * cos(opening), hand.finger_length * sin(opening))
        gaps.append(LineString([base, tip]).distance(place) - radius - hand.half_thickness)
    return min(gaps)


@pytest.mark.parametrize("name", HANDS)
@pytest.mark.parametrize("degrees", [0, 20, 60, 90, 130])
def test_a_disk_coming_down_touches_on_the_profile(name: str, degrees: float) -> None:
    hand, radius = HANDS[name]
    seen = profile(hand, radius, Sensors(layout=SensorLayout.FULL).stretches(hand), radians(degrees))
    x = np.random.default_rng(3).uniform(seen.left, seen.right, 200)
    for each, height in zip(x, seen.heights(x), strict=True):
        assert -1e-9 - seen.flattening <= clearance(hand, radius, radians(degrees), each, height) <= 1e-9
        for above in (1e-3, 1e-2, 0.1, 0.5):
            assert clearance(hand, radius, radians(degrees), each, height + above) > -seen.flattening


@pytest.mark.parametrize("name", HANDS)
def test_beside_the_profile_nothing_is_touched(name: str) -> None:
    hand, radius = HANDS[name]
    seen = profile(hand, radius, (), radians(25.0))
    for x in (seen.left - 1e-9, seen.right + 1e-9):
        assert min(clearance(hand, radius, radians(25.0), x, y) for y in np.linspace(-0.5, 0.5, 400)) > 0.0
    assert np.isneginf(seen.heights(np.array([seen.left - 1e-6, seen.right + 1e-6]))).all()


def test_the_open_hand_is_felt_stretch_by_stretch() -> None:
    """Fingers along the palm line: every stretch has its own width, a radius above it; the tips end in a quarter circle."""
    hand, radius = HANDS["bed"]
    stretches = Sensors(layout=SensorLayout.DISTRIBUTED).stretches(hand)
    seen = profile(hand, radius, stretches, 0.0)
    spans = {stretches[each.owner].name: (each.points[0, 0], each.points[-1, 0]) for each in seen.pieces}
    assert len(seen.pieces) == len(spans) == 13
    assert spans["palm"] == pytest.approx((-0.06, 0.06))
    assert spans["right_1 0..45.66666667"] == pytest.approx((0.06, 0.06 + 0.137 / 3))
    tip = max(high for _, high in spans.values())
    assert tip == pytest.approx(0.304 + radius)
    assert seen.top == pytest.approx(radius)


def test_what_no_stretch_covers_is_dead() -> None:
    hand = Hand(palm_width=0.1, finger_links=(0.1,))
    seen = profile(hand, 0.02, (Stretch(body="right_1", begin=0.03, end=0.06),), 0.0)
    owners = [each.owner for each in seen.pieces]
    assert owners == [DEAD, 0, DEAD]
    assert seen.pieces[1].points[[0, -1], 0] == pytest.approx([0.08, 0.11])


def test_fingers_turned_past_each_other_are_one_profile() -> None:
    hand = Hand(palm_width=0.1, finger_links=(0.12,))
    seen = profile(hand, 0.02, (), pi - 0.6)
    x = np.array([-0.03, 0.03])
    assert seen.heights(x)[0] == pytest.approx(seen.heights(x)[1])


def test_chords_that_hardly_cross_leave_no_doubt_larger_than_the_hand() -> None:
    raw = {"palm_width_mm": 152.84454064561908, "finger_thickness_mm": 196.5228375266183}
    raw["finger_links_mm"] = [189.33493334482378, 134.53135267434251, 0.035175450675322024]
    hand = build_case({"hand": raw, "object": {"radius_mm": 38.0}}).hand
    seen = profile(hand, 0.038, Sensors().stretches(hand), 1.6)
    assert max(each.blur for each in seen.pieces) < hand.palm_width + 2.0 * hand.finger_length
