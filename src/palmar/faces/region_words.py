"""What is said beside a region, in words and table rows; lengths in mm, angles in degrees."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, isfinite, radians

from palmar.faces.words import Row
from palmar.models.case import Case
from palmar.models.guarantee import Guarantee
from palmar.regions.opening import Openings
from palmar.studies.capture import Capture, Chance, Pair
from palmar.studies.final_angles import FinalAngles
from palmar.studies.final_poses import FinalPoses, Interval
from palmar.studies.pre_opening import PreOpening, time_saved, tip_gap
from palmar.studies.validity import Validity
from palmar.studies.velocity_tolerance import VelocityTolerance

RARE, SURE, ROUNDED = 1e-3, 1e-12, 1e-9


def capture_rows(given: Capture) -> Iterator[Row]:
    """(what, value) for the chance of a catch."""
    about = "about " if given.guarantee is Guarantee.SAMPLED else ""
    yield f"chance of a catch at {_place(given.nominal.at)}", _chance(given.nominal, about)
    if given.best is not None and given.offset is not None:
        x, y = given.offset
        yield f"the best place, {_place(given.best.at)}", _chance(given.best, about)
        yield "to get there, move the hand by", _place((x, y))
    for each in given.tolerances:
        here = "none" if each.nominal is None else _sigmas(given, each.nominal)
        best = "none" if each.best is None else _sigmas(given, each.best)
        yield f"standard deviations for {100.0 * each.wanted:g}%", f"{here}; {best} at the best place"


def _sigmas(given: Capture, scale: float) -> str:
    x, y = (1e3 * scale * each for each in given.error.sigma)
    return f"{x:.3g} x {y:.3g} mm"


def _chance(given: Chance, about: str) -> str:
    if given.probability < SURE:
        return "none, less than 1 in 1e12 caught"
    low, high = given.at_least, given.at_most
    between = ""
    sampled = low is not None and low < given.probability
    if low is not None and high is not None and (sampled or high - low > RARE):
        between = f" ({100.0 * low:.4g} to {100.0 * high:.4g}%)"
    if given.loss > RARE or between:
        return f"{100.0 * given.probability:.4g}%{between}"
    if given.loss < SURE:
        return "certain, less than 1 in 1e12 lost"
    odds = 1.0 / given.loss
    return f"1 in {odds:,.0f} lost" if odds < 1e7 and not about else f"{about}1 in {odds:.1e} lost"


def velocity_line(given: VelocityTolerance) -> str:
    """Which velocities a free disk may have at a place."""
    x, y = (1e3 * each + 0.0 for each in given.about)
    about = "rest" if given.about == (0.0, 0.0) else f"({x:.4g}, {y:.4g}) mm/s"
    if given.radius == 0.0:
        return f"At {_place(given.at)} a disk with the velocity {about} is lost."
    return f"At {_place(given.at)} a disk is caught with any velocity within {1e3 * given.radius:.3g} mm/s of {about}."


def pre_opening_rows(case: Case, given: PreOpening) -> Iterator[Row]:
    """(what, value) for the smallest safe opening."""
    caught = "caught" if given.now else "not all caught"
    yield (
        f"all errors about {_place(given.at)}",
        f"{caught} from the case's opening of {_deg(case.hand.open)}",
    )
    yield "smallest safe opening there", _opening(case, given.nominal)
    if given.best.at is not None:
        yield f"smallest safe opening, at {_place(given.best.at)}", _opening(case, given.best)
    elif not given.best.works:
        yield "smallest safe opening anywhere", "none: the errors are too large for this hand"
    if given.widest is not None:
        most = f"{1e3 * given.widest.allowed:.1f} mm in every direction"
        yield "most error allowed", f"{most}, up to a base angle of {_deg(given.widest.angle)}"


def _opening(case: Case, given: Openings) -> str:
    angle = given.smallest
    if angle is None:
        return "none"
    gap = 1e3 * tip_gap(case.hand, angle)
    tips = f"tips {gap:.0f} mm apart" if gap > 0.0 else "tips crossed"
    others = f"; works {' and '.join(_degs(each) for each in given.works)}" if len(given.works) > 1 else ""
    return f"base angle {_deg(angle)}, {tips}, {time_saved(case.hand, angle):.2f} s saved{others}"


def ends_rows(given: FinalPoses) -> list[Row]:
    """(way to end, share, meaning, place, turn, finger angles) with a heading."""
    heads = ("how it ends", "share", "x, mm", "y, mm", "turned, deg", "fingers, deg", "meaning")
    rows = [
        (
            each.name,
            f"{100.0 * each.share:.3g}%",
            _mms(each.x),
            _mms(each.y),
            _degs(each.turn),
            _degs(each.smaller) if each.smaller == each.larger else f"{_degs(each.smaller)}; {_degs(each.larger)}",
            each.meaning,
        )
        for each in given.kinds
    ]
    return [heads, *rows]


def ends_lines(given: FinalPoses, angles: FinalAngles | None) -> Iterator[str]:
    """What the final poses and angles mean."""
    if given.centring is not None:
        yield (
            f"Self-centring: {1e3 * given.before:.3g} mm of spread before (rms), {_after(given)}; "
            f"{given.starts} starts, {1e3 * given.spacing:.2g} mm apart."
        )
    if angles is None:
        return
    if angles.caught_from_missed > 0.0:
        half = degrees(0.5 * angles.caught_from_missed)
        yield (
            f"Fingers that have missed end at {_deg(angles.missed)}; every catch stops one at least "
            f"{degrees(angles.caught_from_missed):.3g} deg short of it: read angles to better than {half:.3g} deg."
        )
    else:
        yield f"Fingers that have missed end at {_deg(angles.missed)}, and so do some that have caught: angles cannot tell."
    if angles.centred is not None and angles.radius_per_angle is not None:
        per_degree = abs(1e3 * angles.radius_per_angle) * radians(1.0)
        yield (
            f"A disk held on the palm stops both fingers at {_deg(angles.centred)}; one degree less means "
            f"{per_degree:.2g} mm more radius."
        )
    close = [each for each in angles.apart if each.angle < radians(1.0)]
    if close:
        pairs = ", ".join(f"{each.one} from {each.other} ({degrees(each.angle):.2g} deg apart)" for each in close)
        yield f"The angles alone hardly tell {pairs}."


def _after(given: FinalPoses) -> str:
    if given.centring is None or given.centring < ROUNDED:
        return "none after"
    return f"{1e3 * given.after:.3g} mm after, ratio {given.centring:.3g}"


def validity_lines(given: Validity) -> Iterator[str]:
    """One or two lines: how far the numbers above apply."""
    slow = given.quasi_static
    if slow is not None and not isfinite(slow.ratio):
        yield "Nothing slows the object down on this table: pushed, it glides away, so the region does not apply."
    elif slow is not None:
        yield (
            f"Closing at {degrees(slow.rate):.3g} deg/s is {slow.verdict} (limit {_rate(slow.rate_limit)}): inertia is "
            f"{slow.ratio:.2g} of the table's friction; keep {_mm(slow.drift)} mm for drift and {_mm(slow.coasting)} mm "
            f"for coasting off the {1e3 * slow.allowed:.1f} mm of allowed error."
        )
        if slow.squeeze_speed > slow.push_speed:
            yield f"Between both fingers, or finger and palm, it then moves at up to {slow.squeeze_speed:.2g} m/s."
    if given.toppling is None and given.alike_at_any_rate:
        yield "At rest in free space it fares alike at any closing rate, and at any mass where nothing slows the fingers."
    elif given.toppling is not None and isfinite(given.toppling.height):
        yield f"It topples if pushed above {_mm(given.toppling.height)} mm."
    elif given.toppling is not None:
        yield "It cannot topple: nothing holds it back."
    if given.offset is not None:
        yield (
            f"With the pressure's centre {_mm(given.offset.offset)} mm off, {1e3 * given.offset.allowed:.1f} mm of error "
            f"are allowed, {given.offset.lost_per_offset:.2g} mm less per mm (sampled)."
        )
    for each in given.uncovered:
        yield f"Not known: {each}."


def _rate(rate: float) -> str:
    return f"{degrees(rate):.3g} deg/s" if isfinite(rate) else "none"


def _place(place: Pair) -> str:
    x, y = (round(1e3 * each, 1) + 0.0 for each in place)
    return f"({x:.1f}, {y:.1f}) mm"


def _mm(length: float) -> str:
    return f"{1e3 * length:.3g}"


def _deg(angle: float) -> str:
    return f"{degrees(angle):.4g} deg"


def _degs(angles: Interval) -> str:
    return _between(*(degrees(each) for each in angles))


def _mms(lengths: Interval) -> str:
    return _between(*(1e3 * each for each in lengths))


def _between(low: float, high: float) -> str:
    low, high = round(low, 1) + 0.0, round(high, 1) + 0.0
    return f"{low:.1f}" if low == high else f"{low:.1f} to {high:.1f}"
