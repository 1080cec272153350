"""Closing strategies and preshapes of jointed fingers as the JSON records of the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from palmar.models.behaviour import BehaviourName

if TYPE_CHECKING:
    from palmar.mechanics.pushing.preshape_5_2 import Ride
    from palmar.studies.preshape import Preshapes
    from palmar.studies.strategies import Strategy


def strategies_record(found: tuple[Strategy, ...], best: Strategy) -> dict[str, Any]:
    """`palmar strategies --json`; ``search`` where the angle or ratio was searched for: to which step, at which spacing."""
    return {"best": best.name, "strategies": [_strategy(each) for each in found]}


def _strategy(each: Strategy) -> dict[str, Any]:
    coupled = each.behaviour.name is BehaviourName.CLOSE_COUPLED
    step = None if each.step is None else {("step" if coupled else "step_rad"): each.step, "spacing_m": each.spacing}
    return {
        "name": each.name,
        "behaviour": each.behaviour.name.value,
        "preshape_rad": each.value if each.behaviour.name is BehaviourName.CURL_AND_CLOSE else None,
        "ratio": each.value if coupled else None,
        "search": step,
        "area_m2": each.region.area,
        "guarantee": each.region.guarantee.value,
        "spacing_m": each.region.spacing,
    }


def preshape_record(found: Preshapes) -> dict[str, Any]:
    """`palmar preshape --json`."""
    return {
        "angle_rad": None if found.tip is None else found.tip.angle,
        "friction": None if found.tip is None else found.tip.friction,
        "along": [{"part": part, **_ride(each)} for part, each in found.places],
        "pressure": {name: _ride(each) for name, each in found.by_pressure},
        "off_centre_rad": None if found.by_offset is None else list(found.by_offset),
        "disc_radius_m": found.disc,
        "centrifugal_rad": None if found.centrifugal is None else list(found.centrifugal),
    }


def _ride(ride: Ride | None) -> dict[str, Any]:
    return {"angle_rad": None if ride is None else ride.angle, "friction": None if ride is None else ride.friction}
