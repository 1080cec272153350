"""Closing strategies and preshapes of jointed fingers in words and rows, for the terminal and for pages."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from palmar.faces.words import Row
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.support import SupportKind

if TYPE_CHECKING:
    from palmar.mechanics.pushing.preshape_5_2 import Ride
    from palmar.studies.preshape import Preshapes
    from palmar.studies.strategies import Strategy

STRATEGY_HEADS: Row = ("strategy", "", "area", "of straight closing", "guarantee", "spacing")
PRESHAPE_HEADS: Row = ("contact or pressure", "distal angle", "friction needed on the link")


def strategy_rows(found: tuple[Strategy, ...]) -> list[Row]:
    """One for each strategy, as ``STRATEGY_HEADS`` says."""
    straight = found[0].region.area
    rows: list[Row] = []
    for each in found:
        gain = "" if straight == 0.0 else f"{100.0 * each.region.area / straight:.1f} %"
        spacing = "" if each.region.spacing is None else f"{1e3 * each.region.spacing:.2g} mm"
        area, label = f"{1e4 * each.region.area:.4g} cm2", each.region.guarantee.value
        rows.append((each.name, strategy_value(each), area, gain, label, spacing))
    return rows


def strategy_value(each: Strategy) -> str:
    """What is done with the distal joints."""
    if each.value is None:
        return ""
    if each.behaviour.name is BehaviourName.CLOSE_COUPLED:
        return f"distal {each.value:.3g} times as fast"
    return f"curled by {degrees(each.value):.3g} deg"


def strategy_verdict(found: tuple[Strategy, ...], best: Strategy) -> str:
    """Which catches from the largest region, and by how much."""
    if best.region.area == 0.0:
        return "None of them catches anything."
    straight = found[0].region.area
    more = f", {100.0 * (best.region.area / straight - 1.0):.0f} % larger than that of straight closing"
    how = f" ({strategy_value(best)})" if best.value is not None else ""
    return f"The largest region: {best.name}{how}{more if best is not found[0] and straight > 0.0 else ''}."


def search_note(found: tuple[Strategy, ...]) -> str | None:
    """How the angle and the ratio were searched for."""
    steps = []
    for each in found:
        if each.step is not None:
            coupled = each.behaviour.name is BehaviourName.CLOSE_COUPLED
            steps.append(f"the ratio to {each.step:.2g}" if coupled else f"the angle to {degrees(each.step):.2g} deg")
    spacings = [1e3 * each.spacing for each in found if each.spacing is not None]
    return f"searched: {' and '.join(steps)}, at a spacing of {max(spacings):.2g} mm" if steps else None


def preshape_words(case: Case, found: Preshapes) -> str:
    """What theory says of the distal joint's angle."""
    if case.support.kind is SupportKind.FREE:
        if found.centrifugal is None:
            return (
                "No curl balances the centrifugal force with the disk on the distal link and clear of the proximal one:\n"
                "that needs a radius, with the finger's half thickness, of at most 0.3003 proximal links."
            )
        low, high = (degrees(each) for each in found.centrifugal)
        return (
            f"Curled by {low:.4g} to {high:.4g} deg, the centrifugal force has no part along the distal link where the\n"
            "disk touches it, and the disk is clear of the proximal link. The balance is unstable: a disk that is aside\n"
            "by e goes as e cosh(angle turned)."
        )
    if found.tip is None or found.by_offset is None or found.disc is None:
        return "At every angle of the distal joint up to 90 deg the disk rolls out."
    return (
        f"Curled by {degrees(found.tip.angle):.2f} deg, the disk rides on the distal link without rolling while the base\n"
        "joint closes; curled by more it rolls in, towards the palm."
    )


def preshape_rows(found: Preshapes) -> list[Row]:
    """Angles on a table by contact and by pressure; none in free space, or where the disk always rolls out."""
    if found.tip is None:
        return []
    rows: list[Row] = [
        (f"contact at {100.0 * part:.3g} % of the distal link", *_ride(each)) for part, each in found.places
    ]
    return rows + [(f"at its tip, pressure: {named}", *_ride(each)) for named, each in found.by_pressure]


def preshape_notes(found: Preshapes) -> list[str]:
    """What they are sensitive to, and the source's contact region."""
    if found.by_offset is None or found.disc is None:
        return []
    low, high = (degrees(each) for each in found.by_offset)
    return [
        f"With the pressure's centre off by 5 % of the radius: {low:.4g} to {high:.4g} deg.",
        f"The source's contact region is a disc of radius {1e3 * found.disc:.4g} mm about each base joint.",
    ]


def _ride(ride: Ride | None) -> tuple[str, str]:
    return ("none", "") if ride is None else (f"{degrees(ride.angle):.2f} deg", f"{ride.friction:.3f}")
