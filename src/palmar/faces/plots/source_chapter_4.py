"""Figure 4.4, drawn anew: the pre-image of closing on a free disk, as printed and with the right sign."""

from __future__ import annotations

from matplotlib.figure import Figure

from palmar.faces.plots.areas import LEGEND_ROW, Band, draw_area, legend
from palmar.faces.plots.dimensions import dimension, label
from palmar.faces.plots.hand import draw_hand, draw_object
from palmar.faces.plots.lettering import NO_BREAK, angle, millimetres
from palmar.faces.plots.sheet import MARGIN, Extent, Pad, Room, sheet
from palmar.faces.plots.strokes import DASHES
from palmar.faces.plots.style import Role
from palmar.mechanics.impact.three_impacts_4_2_1 import Construction, construction
from palmar.models.case import Case
from palmar.models.contact import Contact
from palmar.models.hand import Hand
from palmar.models.objects import Disk
from palmar.models.support import Support, SupportKind
from palmar.regions.build import build_region
from palmar.regions.region import Model
from palmar.regions.three_impacts_4_2_1 import contact_points

HAND, RADIUS = Hand(palm_width=0.12, finger_links=(0.244,)), 0.038
"""Section 4.2.2; one unit of the source is one centimetre."""
EXAMPLE = Case(
    hand=HAND, object=Disk(radius=RADIUS), contact=Contact(friction=0.0), support=Support(kind=SupportKind.FREE)
)

WHOLE = Band(Role.WHOLE, "as printed: all of the disk starts inside", 0.0, dashes=(0, (1, 1.2)))
CENTRE = Band(Role.CENTRE, "as printed: the disk's centre starts inside", 1.0)
CORRECTED = Band(Role.HELD, "with the right sign: the centre starts inside", 3.0, filled=False, dashes=DASHES)
WORDS = (
    "Fingers {finger}, palm {palm}, disk radius {radius}, at rest, frictionless and elastic. The disk of three impacts is "
    "struck at R₁, R₂ and the fingertip, about the base joint at {printed} as printed, {corrected} with the right sign in "
    "equation 4.9."
)


def zero_gravity_pre_image() -> Figure:
    """Figure 4.4: centre and whole region by the printed equations, and the centre region by the corrected ones."""
    published, corrected = (build_region(EXAMPLE, model) for model in (Model.PUBLISHED, Model.CORRECTED))
    d, length = HAND.half_palm, HAND.finger_length
    printed, right = (construction(d, length, RADIUS, published=each) for each in (True, False))
    assert printed is not None and right is not None
    words = {"finger": length, "palm": HAND.palm_width, "radius": RADIUS}
    named = {name: millimetres(each) for name, each in words.items()}
    bands = [CENTRE, CORRECTED, WHOLE]
    page = sheet(
        [[Extent(-d - length, 0.0, d + length, float(published.whole.bounds[3]))]],
        title="Figure 4.4: Where a disk at rest in free space may start for closing to catch it",
        footer=WORDS.format(printed=_places(printed), corrected=_places(right), **named),
        room=Room(Pad(4.0, 11.0, 4.0, 4.0), sides=Pad(bottom=2.0 * LEGEND_ROW + 2.0)),
    )
    axes = page.panels[0][0]
    draw_area(axes, published.whole, WHOLE)
    draw_area(axes, published.centre, CENTRE)
    draw_area(axes, corrected.centre, CORRECTED)
    start = (-0.05, 0.09)
    draw_object(axes, EXAMPLE.object, start, fill=0.8)
    label(axes, start, "a disk that is caught", (-30.0, 6.0))
    for name, (x, y) in zip(("R₁", "R₂", "R₃"), contact_points(d, printed), strict=True):
        label(axes, (float(x), float(y)), name, (9.0, 4.0), role=Role.CONTACT)
    draw_hand(axes, HAND, 0.0)
    dimension(axes, (-d, 0.0), (d, 0.0), named["palm"], -5.0)
    dimension(axes, (d, 0.0), (d + length, 0.0), named["finger"], -5.0)
    legend(page, (MARGIN, page.box(axes).bottom), bands)
    return page.figure


def _places(numbers: Construction) -> str:
    """The construction points as distance and angle."""
    polar = ((numbers.first, numbers.first_angle), (numbers.second, numbers.second_angle))
    return " and ".join(f"{1e3 * r:.1f} mm, {angle(phi)}".replace(" ", NO_BREAK) for r, phi in polar)
