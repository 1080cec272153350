"""Briefs and their answers: special cases, proofs, worst cases, and a trial that can fail."""

from dataclasses import replace
from math import atan, tan

import numpy as np
import pytest

from palmar.mechanics.closure.chain import Chain, largest_hold
from palmar.models.design_brief_file import open_brief, parse_brief
from palmar.models.guarantee import Guarantee
from palmar.models.objects import Disk
from palmar.studies.design.binding import binding
from palmar.studies.design.bounds import bound, least_reach
from palmar.studies.design.circumstances import case_of
from palmar.studies.design.design import design, size_of, slack, stages
from palmar.studies.design.tolerance import tolerance
from palmar.studies.design.verify import verify
from palmar.studies.simulate import simulate_starts

SMOOTH = "[targets]\nradii_mm = 40\nerror_mm = 30\n[limits]\nlinks = [1]\nmargin = 0\n"
ROUGH = '[targets]\nradii_mm = "25..45"\nfriction = "0.3..0.8"\nerror_mm = 20\n[limits]\nlinks = [1]\n'


@pytest.mark.parametrize(
    ("name", "links", "length"),
    [("source_4r", 1, 4.0 * 0.05), ("source_half_octagon", 2, 8.0 * (2.0**0.5 - 1.0) * 0.05)],
)
def test_the_hands_of_the_source(name, links, length):
    found = design(open_brief(name)[1], cases=500)
    assert found.chosen.links == links
    assert found.chosen.size == pytest.approx(length, rel=1e-9)
    assert found.verification.violations == 0
    assert found.binds == ("largest radius",)
    assert found.guarantee is Guarantee.CLOSED_FORM


def test_the_fewest_links_for_a_length():
    found = design(open_brief("fewest_links")[1], cases=100)
    assert found.fewest_links == 2
    assert found.options[0].hand is None
    assert found.options[0].proven
    assert "152 mm" in found.options[0].because


def test_without_friction_the_bound_is_attained():
    """Palm 2 R, fingers R + 2 e: 4 (R + e) in all."""
    found = design(parse_brief(SMOOTH), cases=1000)
    assert found.chosen.least == pytest.approx(4.0 * (0.04 + 0.03))
    assert found.chosen.size == pytest.approx(found.chosen.least, rel=1.5e-3)
    assert found.error >= 0.03 * (1.0 - 1e-6)
    assert set(found.binds) == {"largest radius", "error"}
    assert found.guarantee is Guarantee.CLOSED_FORM
    assert found.verification.violations == 0


def test_a_family_of_radii_and_frictions():
    brief = parse_brief(ROUGH)
    found = design(brief, cases=5000)
    assert found.verification.violations == 0
    assert found.chosen.least <= found.chosen.size <= 1.02 * found.chosen.least
    assert found.guarantee is Guarantee.SAMPLED
    hand = found.chosen.hand
    assert slack(brief, 0.97 * hand.half_palm, (0.97 * hand.finger_length,)) < 0.0


def test_a_hand_too_small_is_caught_out():
    brief = parse_brief(ROUGH)
    hand = brief.limits.hand(0.021, (0.068,))
    tried = verify(brief, hand, (0.0, 0.0657), 5000, seed=1)
    assert tried.violations > 0
    assert "radius" in tried.examples[0]


def test_thick_fingers_do_not_hold_what_thin_ones_would():
    """The trial of a hold counts half a thickness into the distance of joint line and centre: straight, bent, pinching."""
    text = "[targets]\nradii_mm = 40\nfriction = {}\n[limits]\nlinks = [{}]\nfinger_thickness_mm = 16\nmargin = 0\n{}"
    for friction, links, palm in ((0.3, 1, ""), (0.0, 2, ""), (0.5, 1, "palm_width_mm = 60\n")):
        brief = parse_brief(text.format(friction, links, palm))
        hand = design(brief, cases=50).chosen.hand
        assert verify(brief, hand, None, 50, 0).violations == 0
        less = brief.limits.hand(hand.half_palm, tuple(0.98 * each for each in hand.finger_links))
        assert verify(brief, less, None, 50, 0).violations == 50


def test_what_a_limit_of_the_hand_binds_is_told():
    brief = parse_brief(SMOOTH + 'palm_width_mm = "90..300"\nfinger_length_mm = "0..100.6"\n')
    assert binding(brief, brief.limits.hand(0.045, (0.1004,))) == ("error", "palm_width_mm", "finger_length_mm")
    assert binding(brief, brief.limits.hand(0.046, (0.12,))) == ()


def test_postures_are_not_found_for_a_disk_that_is_too_large():
    brief = open_brief("source_half_octagon")[1]
    hand = design(brief, cases=10).chosen.hand
    larger = brief.model_copy(update={"targets": brief.targets.model_copy(update={"radii": (0.0501, 0.0501)})})
    assert verify(larger, hand, None, 100, seed=0).violations == 100


def test_what_lies_beyond_the_reach_is_lost():
    """The bound of reach: no start farther ahead than L + rho sin(alpha) is caught, whatever the palm."""
    brief = parse_brief(ROUGH)
    rng = np.random.default_rng(3)
    for half_palm in (0.01, 0.03, 0.06):
        hand = brief.limits.hand(half_palm, (0.09,))
        top = 0.09 + 0.03 * np.sin(atan(0.5))
        starts = np.column_stack([rng.uniform(-0.1, 0.1, 400), rng.uniform(top, top + 0.05, 400)])
        codes = simulate_starts(case_of(brief, hand, Disk(radius=0.03), 0.5), starts).codes
        assert (codes > 2).all()


def test_reach_grows_with_error_and_spread():
    brief = parse_brief(ROUGH)
    alpha = atan(0.3 * 0.99)
    assert least_reach(brief) == pytest.approx(0.04545 + 2.0 * 0.0202 - 0.02475 * np.sin(alpha))
    felt = open_brief("felt_search")[1]
    assert least_reach(felt) == 0.0


@pytest.mark.parametrize(
    ("limits", "told"),
    [
        ("hand_length_mm = 100", "4 x 1 x 45.45 x tan("),
        ("finger_length_mm = [10, 60]", "an error of 20.2 mm asks for fingers of at least 78.8"),
        ("palm_width_mm = [300, 400]\nhand_length_mm = 350", "at most 350 mm are allowed"),
    ],
)
def test_what_is_impossible_is_proven(limits, told):
    found = design(parse_brief(ROUGH + limits), cases=10)
    assert found.chosen is None
    assert found.options[0].proven
    assert told in found.options[0].because


def test_below_the_best_palm_the_closed_form_proves_less():
    """Fingers of two links cradle a disk off a palm narrower than the best one, with less than they need on it."""
    text = '[targets]\nradii_mm = 50\n[limits]\nlinks = [2]\nmargin = 0\npalm_width_mm = "0..2"\n'
    found = design(parse_brief(text), cases=10)
    cradle = largest_hold(Chain(0.001, (0.6 * 0.092, 0.4 * 0.092)))
    assert cradle.radius > 0.05
    assert found.least == pytest.approx(8.0 * (2.0**0.5 - 1.0) * 0.05)
    assert found.least < 2.0 * 0.093 < 0.98 * found.chosen.size
    refused = design(parse_brief(text + "hand_length_mm = 190\n"), cases=10)
    assert refused.chosen is None
    assert not refused.proven
    assert design(parse_brief(text + "hand_length_mm = 160\n"), cases=10).proven


def test_what_is_proven_of_one_link_is_not_of_two():
    one = parse_brief(ROUGH + "hand_length_mm = 190\n")
    assert design(one, cases=10).proven
    both = one.model_copy(update={"limits": one.limits.model_copy(update={"links": (1, 2), "curl": False})})
    found = design(both, cases=10)
    assert found.chosen is None
    assert not found.proven


def test_a_brief_that_only_the_search_refuses_is_not_called_proven():
    brief = parse_brief(ROUGH)
    least = bound(brief, 1).size
    close = parse_brief(ROUGH + f"hand_length_mm = {1e3 * least * 1.001}")
    found = design(close, cases=10)
    assert found.chosen is None
    assert not found.options[0].proven
    assert "tolerates" in found.options[0].because


def test_the_hand_is_told_before_it_is_tried():
    brief = parse_brief(SMOOTH)
    found, tried = stages(brief, cases=100)
    assert found.verification is None
    assert tried == replace(found, verification=tried.verification) == design(brief, cases=100)


def test_the_front_rises():
    front = design(parse_brief(SMOOTH), cases=100, front=2).front
    assert [error for _, error in front] == pytest.approx([0.0, 0.045])
    assert [size for size, _ in front] == pytest.approx([0.16, 0.34], rel=2e-3)


def test_free_tolerance_is_what_is_caught_at_every_restitution():
    brief = open_brief("free_catch")[1]
    hand = brief.limits.hand(0.04, (0.0665,))
    found = tolerance(brief, hand)
    assert found.radius == pytest.approx(0.0152, abs=2e-4)
    assert verify(brief, hand, found.place, 2000, seed=0).violations == 0


def test_a_polygon_to_hold_at_every_orientation():
    square = "[targets]\nvertices_mm = [[-30, -30], [30, -30], [30, 30], [-30, 30]]\nfriction = 0.5\n"
    found = design(parse_brief(square + "[limits]\nlinks = [1]\npalm_width_mm = 60\n"), cases=500)
    assert found.verification.violations == 0
    assert found.binds == ("orientations", "palm_width_mm")
    assert size_of(found.chosen.hand) < 4.0 * np.hypot(0.03, 0.03) * 1.01


def test_friction_makes_hands_smaller():
    text = "[targets]\nradii_mm = 50\nfriction = {}\n[limits]\nlinks = [1]\nmargin = 0\n"
    found = design(parse_brief(text.format(0.5)), cases=200)
    assert found.chosen.size == pytest.approx(0.2 * tan(np.pi / 4.0 - 0.5 * atan(0.5)), rel=1e-9)
    assert replace(found, options=()).fewest_links is None
