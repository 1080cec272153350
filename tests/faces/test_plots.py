"""Pictures: they save as promised, are to scale, nothing is cut off or overlaps, and colours stay apart."""

from __future__ import annotations

import re
from itertools import combinations
from math import radians
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from palmar.errors import OutputError
from palmar.faces.plots import source_figures
from palmar.faces.plots.closure_picture import closure_picture
from palmar.faces.plots.dimensions import dimension, scale_bar
from palmar.faces.plots.hand import draw_finger, draw_hand, finger_points
from palmar.faces.plots.lettering import angle, millimetres, square_millimetres, text_width, wrapped
from palmar.faces.plots.region_picture import region_picture, region_pictures
from palmar.faces.plots.sheet import Extent, Room, per_paper_mm, sheet
from palmar.faces.plots.source_figures import FIGURES, write_source_figures
from palmar.faces.plots.style import Role, encoded, save
from palmar.models.case import Case
from palmar.models.case_file import dump_case, parse_case
from palmar.models.closure import Closure
from palmar.models.contact import Contact
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.regions.build import published_region
from palmar.studies.closure import ClosureAnswer, RadiusRange, Verdict, closure_answer

SIGNATURES = {"svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG"}


def case(palm: float, links: tuple[float, ...], radius: float, friction: float = 0.7, **hand: object) -> Case:
    return Case.model_validate(
        {
            "hand": Hand.model_validate({"palm_width": palm, "finger_links": links, **hand}),
            "object": Disk(radius=radius),
            "contact": Contact(friction=friction),
        }
    )


CASES = {
    "line fingers": case(2.0, (2.0,), 0.5),
    "wide palm": case(2.4, (1.0,), 0.6),
    "thick and colliding": case(0.12, (0.137, 0.107), 0.038, finger_thickness=0.025, fingers=Fingers.COLLIDING),
    "half open jaws": case(0.03, (0.06,), 0.012, 0.3, open=radians(60.0), finger_thickness=0.01),
    "only with much friction": case(0.3, (0.1,), 0.15, 3.0),
    "nothing is held": case(0.5, (0.1,), 0.05, 0.1),
    "small": case(0.01, (0.012,), 0.0005),
    "large, endless friction": case(2.0, (1.5, 0.5), 0.7, 100.0),
    "frictionless": case(0.1, (0.12,), 0.04, 0.0),
    "object far too large": case(0.1, (0.12,), 1.0, 0.3),
    "tiny object": case(0.1, (0.12,), 0.0002, 0.3, fingers=Fingers.COLLIDING, finger_thickness=0.01),
    "slender": case(0.002, (0.2,), 0.0009, 0.3),
}

SEEN = ("line fingers", "half open jaws", "nothing is held", "slender")
"""Cases also seen from the object."""


def texts(figure: Figure) -> list[tuple[Text, Bbox]]:
    """Every visible text with its box on the paper (pixels)."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    shown = [each for each in figure.findobj(Text) if each.get_visible() and each.get_text().strip()]
    ticks = [text for axes in figure.axes for text in unseen_tick_labels(axes)]
    return [(each, each.get_window_extent(renderer)) for each in shown if each not in ticks]


def unseen_tick_labels(axes: Axes) -> list[Text]:
    """Labels that Matplotlib makes but does not draw."""
    found = []
    for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        outside = [not (axes.axison and limits[0] <= tick.get_loc() <= limits[1]) for tick in axis.get_major_ticks()]
        found += [tick.label1 for tick, unseen in zip(axis.get_major_ticks(), outside, strict=True) if unseen]
    return found


def assert_tidy(figure: Figure, insets: int = 0) -> None:
    """All text on the paper, no text on other text; x and y alike, all panels but the last ``insets`` at one scale."""
    found = texts(figure)
    for text, box in found:
        assert box.x0 >= 0.0 and box.y0 >= 0.0 and box.x1 <= figure.bbox.x1 and box.y1 <= figure.bbox.y1, text
    for (one, first), (other, second) in combinations(found, 2):
        width = min(first.x1, second.x1) - max(first.x0, second.x0)
        height = min(first.y1, second.y1) - max(first.y0, second.y0)
        assert width < 1.0 or height < 1.0, (one, other)
    boxes = [axes.get_window_extent() for axes in figure.axes]
    across = [np.ptp(axes.get_xlim()) / box.width for axes, box in zip(figure.axes, boxes, strict=True)]
    upright = [np.ptp(axes.get_ylim()) / box.height for axes, box in zip(figure.axes, boxes, strict=True)]
    np.testing.assert_allclose(across, upright, rtol=1e-9)
    np.testing.assert_allclose(across[: len(across) - insets], across[0], rtol=1e-9)


def words(figure: Figure) -> str:
    return " ".join(text.get_text().replace("\n", " ") for text, _ in texts(figure))


CONTOURS = ("5.3", "5.4", "5.5", "5.6", "5.7")
"""Maps over dimensionless lengths, with a hand beside them."""


@pytest.mark.parametrize("number", FIGURES)
def test_source_figures_are_tidy_and_the_same_on_every_run(number: str) -> None:
    figure = FIGURES[number]()
    assert_tidy(figure, insets=1 if number in CONTOURS else 0)
    assert f"Figure {number}: " in words(figure)
    again = FIGURES[number]()
    for kind in ("svg", "pdf"):
        assert encoded(again, kind) == encoded(figure, kind)


def test_source_figures_are_written_in_every_format(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []
    monkeypatch.setattr(source_figures, "FIGURES", {number: FIGURES[number] for number in ("2.7", "4.4")})
    paths = write_source_figures(tmp_path, tuple(SIGNATURES), told.append)
    assert len(paths) == len(set(paths)) == 2 * len(SIGNATURES)
    assert sorted(paths) == sorted(tmp_path.iterdir())
    assert told == ["figure 2.7", "figure 4.4"]
    for path in paths:
        assert path.read_bytes().startswith(SIGNATURES[path.suffix.removeprefix(".")])


@pytest.mark.parametrize("name", CASES)
def test_closure_pictures_are_tidy(name: str) -> None:
    figure = closure_picture(CASES[name], closure_answer(CASES[name]))
    assert_tidy(figure)
    assert len(figure.axes) == (3 if name == "frictionless" else 6)


def test_closure_picture_says_the_limits_of_the_published_example() -> None:
    told = words(closure_picture(CASES["wide palm"], closure_answer(CASES["wide palm"])))
    for expected in ("radius 225.8 mm", "radius 974.2 mm", "radius 220 mm", "radius 2054 mm", "2400 mm", "1000 mm"):
        assert expected in told
    assert told.count("✓ held") == 2


def test_closure_picture_says_that_numbers_are_ranges() -> None:
    text = dump_case(CASES["line fingers"]).replace("friction = 0.7", 'friction = "0.2..0.8"')
    ranged = parse_case(text)
    figure = closure_picture(ranged, closure_answer(ranged))
    assert_tidy(figure)
    assert "With friction 0.2 to 0.8, drawn at 0.5" in words(figure)
    assert "drawn at the middle of the given ranges" in words(figure)


@pytest.mark.parametrize("radii", [RadiusRange(0.01, 0.04), RadiusRange(0.0, 0.02), RadiusRange(0.03, 5.0), None])
def test_closure_picture_of_a_polygon(radii: RadiusRange | None) -> None:
    corners = ((-0.025, -0.015), (0.025, -0.015), (0.03, 0.01), (-0.025, 0.015))
    given = CASES["line fingers"].model_copy(
        update={
            "hand": Hand(palm_width=0.08, finger_links=(0.06, 0.05)),
            "object": ConvexPolygon(shape="polygon", vertices=corners),
        }
    )
    answer = ClosureAnswer(radii, radii, Verdict(False, False, "a reason"), (), (), None, ())
    figure = closure_picture(given, answer)
    assert_tidy(figure, insets=2)
    assert words(figure).count("✗ not at every orientation") == 2


@pytest.mark.parametrize(("name", "from_object"), [(name, False) for name in CASES] + [(name, True) for name in SEEN])
def test_region_pictures_are_tidy(name: str, from_object: bool) -> None:
    regions = [published_region(CASES[name], closure) for closure in Closure]
    figure = region_pictures(CASES[name], regions, seen_from_object=from_object)
    assert_tidy(figure)
    told = words(figure)
    for region in regions:
        expected = region.reason if region.allowed_error is None else millimetres(region.allowed_error.radius)
        assert expected is not None
        assert expected in told


def test_region_picture_puts_the_object_where_it_is_told() -> None:
    region = published_region(CASES["line fingers"], Closure.STRUCTURAL)
    first = region_picture(CASES["line fingers"], region, object_at=(0.3, 1.0))
    assert encoded(first) == encoded(region_picture(CASES["line fingers"], region, object_at=(0.3, 1.0)))
    assert encoded(first) != encoded(region_picture(CASES["line fingers"], region))


def test_text_in_svg_stays_text_and_there_is_no_date() -> None:
    text = encoded(FIGURES["2.1"]()).decode("utf-8")
    assert ">Figure 2.1: The planar hand and its object</text>" in text
    assert "<dc:date>" not in text


def test_saving_says_what_is_wrong_and_leaves_nothing(tmp_path: Path) -> None:
    figure = FIGURES["2.3"]()
    with pytest.raises(OutputError, match=r"\.svg, \.pdf or \.png"):
        save(figure, tmp_path / "figure.bmp")
    with pytest.raises(OutputError, match="cannot be written"):
        save(figure, tmp_path / "nowhere" / "figure.svg")
    assert list(tmp_path.iterdir()) == []
    save(figure, tmp_path / "FIGURE.PNG")
    assert (tmp_path / "FIGURE.PNG").read_bytes().startswith(SIGNATURES["png"])


def test_panels_share_one_scale_and_the_paper_is_as_wide_as_asked() -> None:
    page = sheet([[Extent(0.0, 0.0, 0.1, 0.05), Extent(-0.2, 0.0, 0.2, 0.3)]], room=Room(width=120.0, highest=100.0))
    assert page.size[0] == pytest.approx(120.0)
    assert page.size[1] <= 100.0 + 1e-9
    left, right = page.panels[0]
    assert per_paper_mm(left) == pytest.approx(per_paper_mm(right))
    assert left.get_ylim() == pytest.approx(right.get_ylim())


def test_finger_points_follow_the_joints() -> None:
    hand = Hand(palm_width=0.2, finger_links=(0.1, 0.05))
    points = finger_points(hand, (radians(90.0), radians(90.0)))
    np.testing.assert_allclose(points, [[0.1, 0.0], [0.1, 0.1], [0.05, 0.1]], atol=1e-15)
    np.testing.assert_allclose(finger_points(hand, (0.0,), left=True)[-1], [-0.25, 0.0])


def test_fingers_can_be_drawn_one_by_one_and_as_ghosts() -> None:
    hand = Hand(palm_width=0.2, finger_links=(0.1, 0.05), finger_thickness=0.02)
    axes = sheet([[Extent(-0.3, 0.0, 0.3, 0.2)]]).panels[0][0]
    draw_hand(axes, hand, 0.3, distal=(0.5,), ghost=True)
    before = len(axes.patches)
    draw_finger(axes, hand, (1.2, 0.8), left=True)
    assert len(axes.patches) == before + 3
    scale_bar(axes)
    assert axes.texts[-1].get_text() == "100 mm"


@pytest.mark.parametrize("span", [0.001, 0.01, 0.1])
def test_dimension_text_stands_clear_of_its_line(span: float) -> None:
    page = sheet([[Extent(-0.05, -0.05, 0.15, 0.05)]])
    axes = page.panels[0][0]
    dimension(axes, (0.0, 0.0), (span, 0.0), millimetres(span), -5.0)
    (text, box), *_ = texts(page.figure)
    assert text.get_text() == millimetres(span)
    for line in axes.lines:
        points = axes.transData.transform(np.asarray(line.get_xydata()))
        for point in points[:1] + np.linspace(0.0, 1.0, 50)[:, None] * (points[1:] - points[:1]):
            assert not box.contains(*point)


def test_numbers_read_well() -> None:
    lengths = [0.0, 4e-18, 0.00022567, 0.012, 0.9742, 2.0535, 300.0]
    assert [millimetres(each) for each in lengths] == [
        "0 mm", "0 mm", "0.2257 mm", "12 mm", "974.2 mm", "2054 mm", "300000 mm",
    ]  # fmt: skip
    assert [square_millimetres(each) for each in (5.286, 0.0123, 3.1e-4)] == ["5.286 m²", "123 cm²", "310 mm²"]
    assert [angle(each) for each in (0.0, -1e-9, radians(35.0), radians(-16.66))] == ["0°", "0°", "35°", "-16.7°"]


def test_wrapped_text_fits_and_keeps_numbers_with_their_units() -> None:
    text = "fingers are 12 mm thick and the disk has a radius of 225.8 mm at most"
    for width in (20.0, 30.0, 45.0):
        lines = wrapped(text, width, 8.0).split("\n")
        assert " ".join(lines) == text
        assert all(text_width(line, 8.0) <= width for line in lines)
        assert not any(re.match(r"mm\b", line) for line in lines)


DEFICIENCIES = {
    "none": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
"""Machado, Oliveira and Fernandes (2009), severity 1, on linear RGB."""


def seen(colour: str, deficiency: str) -> np.ndarray:
    """CIE L*a*b* of a colour as seen."""
    encoded_rgb = np.array(to_rgb(colour))
    linear = np.where(encoded_rgb <= 0.04045, encoded_rgb / 12.92, ((encoded_rgb + 0.055) / 1.055) ** 2.4)
    linear = np.clip(np.array(DEFICIENCIES[deficiency]) @ linear, 0.0, 1.0)
    to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    x, y, z = np.cbrt(to_xyz @ linear / np.array([0.9505, 1.0, 1.089]))
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


@pytest.mark.parametrize("deficiency", DEFICIENCIES)
def test_colours_that_share_a_picture_stay_apart(deficiency: str) -> None:
    together = (
        (Role.HAND, Role.OBJECT, Role.SMALLEST, Role.LARGEST, Role.FORCE),
        (Role.HAND, Role.OBJECT, Role.CENTRE, Role.CONTACT, Role.WHOLE, Role.LARGEST),
    )
    for roles in together:
        for one, other in combinations(roles, 2):
            assert np.linalg.norm(seen(one.line, deficiency) - seen(other.line, deficiency)) > 14.0, (one, other)
