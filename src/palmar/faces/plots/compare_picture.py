"""Regions of two or three models on top of one another, and what one promises and the other denies."""

from __future__ import annotations

from matplotlib.figure import Figure

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.dimensions import label
from palmar.faces.plots.hand import draw_hand, draw_object, object_reach
from palmar.faces.plots.lettering import square_millimetres
from palmar.faces.plots.sheet import MARGIN, Extent, Pad, Room, sheet
from palmar.faces.plots.style import Role
from palmar.models.case import Case
from palmar.regions.region import Region
from palmar.studies.compare import Comparison, Difference

NUMBERS = {2: "two", 3: "three"}
_LOOKS = ((Role.CENTRE, "-", True), (Role.DIMENSION, (0, (4, 1.5)), False), (Role.CONTACT, (0, (1, 1.2)), False))


def compare_picture(case: Case, comparison: Comparison) -> Figure:
    """All regions of the comparison in the hand's frame; broken promises filled, each with a start that shows it."""
    broken = [each for each in comparison.differences if each.outcome is not None and not each.outcome.caught]
    kept = [each for each in comparison.differences if each.outcome is not None and each.outcome.caught]
    untried = [each for each in comparison.differences if each.outcome is None]
    lost = Band(Role.LOST, "promised, but lost", 2.0, dashes=(0, (2.5, 1.5)))
    more = Band(Role.HELD, "caught, but not promised", 1.0, dashes=(0, (1, 1)))
    models = [
        (region, Band(role, _words(region), 0.0 if filled else 3.0, filled, dashes))
        for region, (role, dashes, filled) in zip(comparison.regions, _LOOKS, strict=False)
    ]
    bands = [*(band for _, band in models), *([lost] if broken else []), *([more] if kept else [])]
    rows = (len(bands) + 1) // 2
    page = sheet(
        [[_extent(case, comparison)]],
        title=f"Where the object may start: {NUMBERS[len(comparison.regions)]} models compared",
        footer=" ".join(map(_sentence, [*broken, *untried])),
        room=Room(Pad(4.0, 8.0, 4.0, 4.0), sides=Pad(bottom=LEGEND_ROW * rows + 2.0)),
    )
    axes = page.panels[0][0]
    for region, band in sorted(models, key=lambda each: not each[1].filled):
        draw_area(axes, region.centre, band)
    for each in kept:
        draw_area(axes, each.where, more)
    for each in broken:
        draw_area(axes, each.where, lost)
        draw_object(axes, case.object, each.start, case.start.theta, fill=0.5)
        label(axes, each.start, "starts here", (9.0, 5.0))
        if each.end is not None and each.outcome is not None:
            draw_object(axes, case.object, each.end, case.start.theta, role=Role.GHOST, fill=0.3)
            label(axes, each.end, f"ends here: {each.outcome.value}", (9.0, 5.0))
    draw_hand(axes, case.hand, case.hand.open, distal=case.open_joints[1:])
    legend(page, (MARGIN, page.box(axes).bottom), bands)
    return page.figure


def _words(region: Region) -> str:
    return f"{region.model.value} model, {square_millimetres(region.area)}"


def _sentence(each: Difference) -> str:
    x, y = (1e3 * value for value in each.start)
    promise = (
        f"The {each.promised_by.value} model promises {square_millimetres(each.where.area)} that the "
        f"{each.denied_by.value} one denies"
    )
    if each.outcome is None:
        return f"{promise}."
    return f"{promise}; simulated from ({x:.1f}, {y:.1f}) mm the object ends {each.outcome.value}."


def _extent(case: Case, comparison: Comparison) -> Extent:
    hand = case.hand
    side = hand.half_palm + hand.finger_length
    extent = Extent(-side, 0.0, side, 0.0)
    for region in comparison.regions:
        if not region.centre.is_empty:
            extent = extent.joined(Extent(*region.centre.bounds))
    size = object_reach(case.object)
    shown = [each for each in comparison.differences if each.outcome is not None]
    for x, y in [place for each in shown for place in (each.start, each.end) if place is not None]:
        extent = extent.joined(Extent(x - size, y - size, x + size, y + size))
    return extent
