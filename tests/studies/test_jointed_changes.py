"""How the radii of jointed hands move with their dimensions, and what would let them hold a disk."""

from __future__ import annotations

import pytest

from palmar.mechanics.closure.four_jointed_friction import largest_with_friction
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.closure import Closure
from palmar.studies.jointed_closure import JointedClosure, jointed_closure


def case_of(
    palm: float = 0.12, links: tuple[float, float] = (0.137, 0.107), friction: float = 0.7, radius: float = 0.2
):
    return parse_case(
        f"[hand]\npalm_width_mm = {1e3 * palm!r}\nfinger_links_mm = {[1e3 * each for each in links]}\n"
        f"[object]\nradius_mm = {1e3 * radius!r}\n[contact]\nfriction = {friction!r}\n"
    )


def moved(dimension: str, to: float) -> Case:
    links = [0.137, 0.107]
    if dimension.startswith("link"):
        links[int(dimension[-1]) - 1] = to
    given = {dimension.removesuffix("_width"): to} if not dimension.startswith("link") else {}
    return case_of(**given, links=(links[0], links[1]), radius=0.31)


def name_of(dimension: object) -> str:
    return f"link_{dimension}" if isinstance(dimension, int) else {"half_palm": "palm"}.get(dimension.value, "friction")


def largest(answer: JointedClosure, closure: Closure) -> float:
    held = answer.structural if closure is Closure.STRUCTURAL else answer.frictional
    assert held is not None
    return held.radius_max


def test_slopes_are_differences_and_add_up_to_the_radius() -> None:
    """R is homogeneous of degree 1 in the lengths, so R = sum of length times slope."""
    here = jointed_closure(case_of())
    lengths = {"palm": 0.12, "link_1": 0.137, "link_2": 0.107}
    for closure in Closure:
        slopes = {name_of(each.dimension): each for each in here.slopes if each.closure is closure}
        total = sum(length * slopes[name].radius_max[1] for name, length in lengths.items())
        assert total == pytest.approx(largest(here, closure), rel=1e-6)
    some = next(each for each in here.slopes if each.dimension == 2 and each.closure is Closure.STRUCTURAL)
    longer = jointed_closure(case_of(links=(0.137, 0.108)))
    difference = (largest(longer, Closure.STRUCTURAL) - largest(here, Closure.STRUCTURAL)) / 1e-3
    assert some.radius_max[1] == pytest.approx(difference, rel=0.01)
    rough = next(each for each in here.slopes if name_of(each.dimension) == "friction")
    more = jointed_closure(case_of(friction=0.701))
    assert rough.radius_max[1] == pytest.approx(
        (largest(more, Closure.FRICTIONAL) - largest(here, Closure.FRICTIONAL)) / 1e-3, rel=0.01
    )


def test_every_change_is_just_enough() -> None:
    answer = jointed_closure(case_of(radius=0.31))
    assert not answer.object.frictional
    changes = {name_of(each.dimension): each for each in answer.changes if each.closure is Closure.FRICTIONAL}
    assert set(changes) == {"palm", "link_1", "link_2", "friction"}
    for name, each in changes.items():
        for share, held in ((1.0 + 1e-6, True), (1.0 - 1e-6, False)):
            to = each.now + share * (each.to - each.now)
            hand, contact = moved(name, to).hand, moved(name, to).contact
            most = largest_with_friction(hand.half_palm, *hand.finger_links, contact.friction_angle)
            assert bool(most >= 0.31) is held, name


def test_what_is_held_needs_no_change() -> None:
    assert jointed_closure(case_of(radius=0.04)).changes == ()


def test_fingers_of_one_plane_hold_small_disks_by_bending_only_if_their_tips_can_meet() -> None:
    """The smallest radius is that of straight fingers, 25.4 mm here, unless they bend until the tips meet: |p - q| <= w."""
    text = "[hand]\npalm_width_mm = 60\nfinger_links_mm = [137, 40]\nfingers = 'colliding'\n[object]\nradius_mm = 1\n"
    answer = jointed_closure(parse_case(text + "[contact]\nfriction = 0\n"))
    assert answer.structural is not None and answer.structural.radius_min > 0.0
    change = next(each for each in answer.changes if each.dimension == 2)
    assert change.to <= 0.107 + 1e-9
    longer = text.replace("40]", f"{1e3 * change.to + 1e-6}]")
    assert jointed_closure(parse_case(longer + "[contact]\nfriction = 0\n")).object.structural


@pytest.mark.parametrize(("distal", "meets"), [(40.0, False), (120.0, True)])
def test_the_smallest_radius_is_that_of_the_closure(distal: float, meets: bool) -> None:
    text = f"[hand]\npalm_width_mm = 60\nfinger_links_mm = [137, {distal}]\nfingers = 'colliding'\n"
    answer = jointed_closure(parse_case(text + "[object]\nradius_mm = 30\n[contact]\nfriction = 0\n"))
    assert answer.structural is not None and (answer.structural.radius_min == 0.0) is meets
    assert any(each.radius_min != (0.0, 0.0) for each in answer.slopes) is not meets
