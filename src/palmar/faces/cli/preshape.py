"""``palmar preshape``: the angle of the distal joint with which a disk rides on the turning finger."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Any

from cyclopts import App

from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, show
from palmar.faces.cli.texts import table, titled
from palmar.models.case import Case
from palmar.models.shipped import open_case
from palmar.models.support import SupportKind

if TYPE_CHECKING:
    from palmar.faces.words import Row
    from palmar.mechanics.pushing.preshape_5_2 import Ride
    from palmar.studies.preshape import Preshapes

app = App(name="preshape")


@app.default
def preshape(case: CaseName, *, json: AsJson = False, check: Check = False) -> None:
    """The distal angle without rolling on a table, or without sliding in free space, and what it depends on."""
    from palmar.studies.preshape import preshapes

    name, given = open_case(case)
    found = preshapes(given)
    show(titled(name, given, _text(given, found)), _record(found), json)
    answer(found.tip is not None or found.centrifugal is not None, check)


def _text(case: Case, found: Preshapes) -> str:
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
    low, high = (degrees(each) for each in found.by_offset)
    rows: list[Row] = [("contact or pressure", "distal angle", "friction needed on the link")]
    rows += [(f"contact at {100.0 * part:.3g} % of the distal link", *_ride(each)) for part, each in found.places]
    rows += [(f"at its tip, pressure: {named}", *_ride(each)) for named, each in found.by_pressure]
    return (
        f"Curled by {degrees(found.tip.angle):.2f} deg, the disk rides on the distal link without rolling while the base\n"
        "joint closes; curled by more it rolls in, towards the palm.\n\n"
        f"{table(rows)}\n\n"
        f"With the pressure's centre off by 5 % of the radius: {low:.4g} to {high:.4g} deg.\n"
        f"The source's contact region is a disc of radius {1e3 * found.disc:.4g} mm about each base joint."
    )


def _ride(ride: Ride | None) -> tuple[str, str]:
    return ("none", "") if ride is None else (f"{degrees(ride.angle):.2f} deg", f"{ride.friction:.3f}")


def _record(found: Preshapes) -> dict[str, Any]:
    return {
        "angle_rad": None if found.tip is None else found.tip.angle,
        "friction": None if found.tip is None else found.tip.friction,
        "along": [{"part": part, **_one(each)} for part, each in found.places],
        "pressure": {name: _one(each) for name, each in found.by_pressure},
        "off_centre_rad": None if found.by_offset is None else list(found.by_offset),
        "disc_radius_m": found.disc,
        "centrifugal_rad": None if found.centrifugal is None else list(found.centrifugal),
    }


def _one(ride: Ride | None) -> dict[str, Any]:
    return {"angle_rad": None if ride is None else ride.angle, "friction": None if ride is None else ride.friction}
