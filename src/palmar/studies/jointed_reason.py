"""Why a hand with jointed fingers holds a disk or does not, in a sentence."""

from __future__ import annotations

from dataclasses import dataclass
from math import tan

from palmar.mechanics.closure.stance import Stance
from palmar.models.case import Case
from palmar.models.objects import Disk
from palmar.studies.closure import RadiusRange

Intervals = tuple[tuple[float, float], ...]
IN_WORDS = {
    "proximal_palm": "proximal links and palm",
    "distal_palm": "distal links and palm",
    "distal_proximal": "distal and proximal links",
    "distal_proximal_palm": "distal and proximal links and palm",
}


@dataclass(frozen=True)
class Held:
    """What the sentence is about: radii without friction and with it, those by each set of links, the largest stances."""

    ranges: tuple[RadiusRange | None, RadiusRange | None]
    cases: dict[str, Intervals]
    holds: tuple[Stance | None, Stance | None]


def within(radii: RadiusRange | None, radius: float) -> bool:
    """Whether a radius (m) is held, the limits included."""
    return radii is not None and radii.radius_min <= radius <= radii.radius_max


def jointed_reason(case: Case, known: Held) -> str:
    """Of the case's disk: how it is held without friction or else with it, or by how much it is not."""
    assert isinstance(case.object, Disk)
    radius, friction = case.object.radius, tan(case.contact.friction_angle)
    limited, (plain, rough) = case.hand.joint_limits is not None, known.ranges
    by = _by(radius, plain, known.cases, known.holds[0])
    alone = _sentence(radius, plain, "without friction", by, limited=limited)
    if not friction or within(plain, radius):
        return alone
    how = f"with friction {friction:.3g}"
    told = _sentence(radius, rough, how, _by(radius, rough, {}, known.holds[1]), limited=limited)
    return f"{told if within(rough, radius) else f'{how} {told}'}; without friction {alone}"


def carriers(hold: Stance) -> str:
    """The contacts of a hold, links counted from the palm."""
    if hold.carrier is None:
        return f"links {hold.last} of both fingers alone"
    if hold.carrier == 0:
        return f"links {hold.last} of both fingers and the palm"
    return f"links {hold.last} and {hold.carrier} of both fingers"


def _sentence(radius: float, radii: RadiusRange | None, how: str, by: str, *, limited: bool = False) -> str:
    if radii is None:
        return "no disk can be held: the fingers do not reach the equator of any disk on the palm"
    if radius > radii.radius_max:
        return f"too large by {_mm(radius - radii.radius_max)}: the largest disk is held {by}"
    if radius < radii.radius_min:
        why = "the joints reach their limits" if limited else "the fingertips cannot come close enough together"
        return f"too small by {_mm(radii.radius_min - radius)}: {why}"
    above = f", {_mm(radius - radii.radius_min)} above the smallest" if radii.radius_min > 0.0 else ""
    return f"held {how} {by}, {_mm(radii.radius_max - radius)} below the largest{above}"


def _by(radius: float, radii: RadiusRange | None, cases: dict[str, Intervals], hold: Stance | None) -> str:
    """Which contacts hold the disk, or the largest one where the disk is larger; where not known for this disk, how."""
    held = within(radii, radius)
    shown = radius if held or radii is None else radii.radius_max
    able = [IN_WORDS[name] for name, known in cases.items() if any(low <= shown <= high for low, high in known)]
    if able:
        return f"by {' or by '.join(able)}"
    if hold is None or held:
        return "by the fingers, with or without the palm"
    return f"by {carriers(hold)}"


def _mm(length: float) -> str:
    return f"{float(f'{1e3 * length:.3g}'):g} mm"
