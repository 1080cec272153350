"""With sensors: where the object is thought to be, and the plan by touch for the error asked about."""

from __future__ import annotations

import shapely

from palmar.models.design_brief import DesignBrief
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.studies.design.circumstances import case_of
from palmar.studies.plan import Plan, plan


def place_ahead(brief: DesignBrief, hand: Hand) -> tuple[float, float]:
    """Where an object to be felt for is thought to be (m): so far ahead that the hand is clear of all that it may be."""
    return 0.0, 2.0 * (hand.finger_length + brief.held[1] + brief.error)


def plan_for(brief: DesignBrief, hand: Hand) -> Plan:
    """The planner's answer for the error asked about and all radii, the margin included, at the least friction."""
    low, high = brief.held
    case = case_of(brief, hand, Disk(radius=low), brief.least_friction.friction)
    where = shapely.Point(0.0, 0.0).buffer(brief.error)
    return plan(case, where, place_ahead(brief, hand), brief.targets.approaches_max, largest=high)
