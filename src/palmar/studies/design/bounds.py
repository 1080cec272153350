"""What no hand can do with less: lower bounds in closed form, and the sentence for a brief that they rule out.

Two hold for every way of closing that leaves the palm where it is. *Hold*: the hand wraps the largest disk (``wrap``).
*Reach*: while the centre is farther ahead than any point of the fingers by rho sin alpha, every force that they can exert
on the disk has a part that points away from the palm, and so has its motion; it is never caught. Derived in
docs/derivations/design.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, inf, sin

from palmar.models.design_brief import LONGEST, DesignBrief
from palmar.models.hand import Fingers
from palmar.studies.design.wrap import Wrap


@dataclass(frozen=True)
class Bound:
    """Half palm and finger (m) of the shortest hand of the closed form; with ``because`` none is left within the limits.

    ``proven``: whether no hand is left, or shorter, however it holds; ``least`` (m): no hand is shorter, however it holds.
    """

    half_palm: float = 0.0
    finger: float = 0.0
    because: str | None = None
    proven: bool = True
    least: float = 0.0

    @property
    def size(self) -> float:
        """Palm and both fingers (m)."""
        return 2.0 * (self.half_palm + self.finger)


def wrap_of(brief: DesignBrief, links: int) -> Wrap:
    """The disks to hold, at the least friction, for fingers of so many links."""
    low, high = brief.held
    limits = brief.limits
    alpha = brief.least_friction.friction_angle
    return Wrap(links, low, high, alpha, limits.half_thickness, limits.fingers is Fingers.CROSSING)


def least_reach(brief: DesignBrief) -> float:
    """Length (m) that the error asks of a finger; 0 for polygons, and where the hand goes to feel for the object."""
    if brief.error == 0.0 or brief.targets.radii is None or brief.targets.sensors is not None:
        return 0.0
    low, high = brief.held
    forward = (low + brief.limits.half_thickness) * sin(brief.least_friction.friction_angle)
    return max(0.0, high + 2.0 * brief.error - forward)


def bound(brief: DesignBrief, links: int) -> Bound:
    """The shortest hand for disks that holds the radii and whose fingers are long enough for the error, or why none is."""
    wrap, reach, limits = wrap_of(brief, links), least_reach(brief), brief.limits
    most, least = limits.hand_length, _least(brief, wrap, reach)
    if wrap.least_length() > most * (1.0 + 1e-9):
        return Bound(because=_too_short(wrap, most))
    if reach > limits.finger_length[1]:
        return Bound(because=f"{_reaching(brief, reach)}, and at most {_mm(limits.finger_length[1])} mm are allowed")
    palm = (0.5 * limits.palm_width[0], 0.5 * limits.palm_width[1])
    found = wrap.shortest(palm, limits.finger_length, reach)
    proven = _is_all(wrap, palm[1], reach)
    if found is None and least <= most * (1.0 + 1e-9):
        return Bound(because=_no_proportion(wrap, brief), proven=proven)
    size = least if found is None else 2.0 * sum(found)
    if size > most * (1.0 + 1e-9):
        long = f"{_reaching(brief, reach)}, " if found is None or reach >= found[1] else ""
        return Bound(
            because=f"{long}palm and fingers that hold {_radii(wrap)} measure at least {_mm(size)} mm within the limits of"
            f" each, and at most {_mm(most)} mm are allowed",
            proven=proven or least > most * (1.0 + 1e-9),
        )
    assert found is not None
    return Bound(*found, proven=proven, least=size if proven else least)


def _least(brief: DesignBrief, wrap: Wrap, reach: float) -> float:
    """Length (m) below which neither the winding around the disk nor the reach leaves a hand."""
    limits = brief.limits
    return max(wrap.least_length(), limits.palm_width[0] + 2.0 * max(reach, limits.finger_length[0]))


def _is_all(wrap: Wrap, widest: float, reach: float) -> bool:
    """Whether the closed form's hand with half palm up to ``widest`` (m) is the shortest of all, also off the palm.

    It is where its palm need not be narrower than the best one. Else jointed fingers, or friction, may cradle the disk.
    """
    alone = wrap.links == 1
    if alone and wrap.friction_angle == 0.0:
        return True
    best = wrap.shortest((0.0, inf), (0.0, inf), reach if alone else 0.0)
    return best is not None and best[0] <= widest and (alone or reach <= best[1])


def _too_short(wrap: Wrap, most: float) -> str:
    angle, n = 90.0 - degrees(wrap.friction_angle), wrap.links
    return (
        f"a hand with {_links(n)} a finger that holds a disk of radius {_mm(wrap.largest)} mm reaches around it and is at"
        f" least 4 x {n} x {_mm(wrap.largest)} x tan({angle:.4g} deg / {2 * n}) = {_mm(wrap.least_length())} mm long, and at"
        f" most {_mm(most)} mm are allowed"
    )


def _reaching(brief: DesignBrief, reach: float) -> str:
    return (
        f"what lies farther ahead than the fingertips is only pushed away, so an error of {_mm(brief.error)} mm asks for"
        f" fingers of at least {_mm(reach)} mm"
    )


def _no_proportion(wrap: Wrap, brief: DesignBrief) -> str:
    palm, finger = (
        "..".join(_mm(end) for end in each) for each in (brief.limits.palm_width, brief.limits.finger_length)
    )
    limited = f" of {finger} mm in all" if brief.limits.finger_length[1] < LONGEST else ""
    return (
        f"no palm of {palm} mm with {_links(wrap.links)} a finger{limited} holds {_radii(wrap)}"
        f" at friction {brief.least_friction.friction:.4g}"
    )


def _radii(wrap: Wrap) -> str:
    if wrap.smallest == wrap.largest:
        return f"a disk of radius {_mm(wrap.largest)} mm"
    return f"disks of radius {_mm(wrap.smallest)} to {_mm(wrap.largest)} mm"


def _links(count: int) -> str:
    return f"{count} link" + "s" * (count > 1)


def _mm(length: float) -> str:
    return f"{1e3 * length:.5g}"
