"""The JSON record of `palmar design`."""

from __future__ import annotations

from typing import Any

from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.hand import Hand
from palmar.studies.design.design import Design, Option


def design_record(found: Design) -> dict[str, Any]:
    """`palmar design BRIEF --json`."""
    record: dict[str, Any] = {
        "possible": found.chosen is not None,
        "links": [_option(each) for each in found.options],
        "fewest_links": found.fewest_links,
    }
    if found.chosen is None or found.chosen.hand is None:
        return {**record, "because": found.because, "proven": found.proven}
    tried = found.verification
    return {
        **record,
        "hand": hand_record(found.chosen.hand),
        "size_m": found.chosen.size,
        "closing": closing_record(found.chosen.does),
        "size_at_least_m": found.least,
        "error_m": found.error,
        "place_m": None if found.chosen.place is None else list(found.chosen.place),
        "binds": list(found.binds),
        "front": [list(each) for each in found.front],
        "verification": None if tried is None else {"cases": tried.cases, "violations": tried.violations},
        "guarantee": None if found.guarantee is None else found.guarantee.value,
        "margin": found.brief.limits.margin,
        "notes": list(found.notes),
    }


def hand_record(hand: Hand) -> dict[str, Any]:
    """A designed hand."""
    return {
        "palm_width_m": hand.palm_width,
        "finger_links_m": list(hand.finger_links),
        "finger_thickness_m": hand.finger_thickness,
        "fingers": hand.fingers.value,
    }


def closing_record(does: Behaviour) -> dict[str, Any]:
    """How a designed hand closes."""
    if does.name is BehaviourName.CLOSE:
        return {"behaviour": does.name.value}
    return {"behaviour": does.name.value, "preshape_rad": does.preshape}


def _option(option: Option) -> dict[str, Any]:
    if option.hand is None:
        return {"links": option.links, "size_m": None, "because": option.because, "proven": option.proven}
    return {
        "links": option.links,
        "size_m": option.size,
        "size_at_least_m": option.least,
        "hand": hand_record(option.hand),
        "closing": closing_record(option.does),
    }
