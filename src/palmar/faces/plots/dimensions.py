"""Engineering annotations: dimension lines, radii, angles, friction cones, forces, labels with leaders, scale bars.

Places are given in m in the panel's frame, distances on paper in mm.
"""

from __future__ import annotations

from math import atan2, cos, degrees, floor, log10, pi, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Wedge
from numpy.typing import NDArray

from palmar.faces.plots.lettering import millimetres, text_width
from palmar.faces.plots.sheet import MM, per_paper_mm
from palmar.faces.plots.strokes import CENTRE_LINE, disc, shape, stroke
from palmar.faces.plots.style import FINE, NORMAL, SMALL_SIZE, TEXT_SIZE, Role

Floats = NDArray[np.float64]
Place = tuple[float, float]

ARROW_LENGTH, ARROW_WIDTH = 2.2, 0.8
CONE_LEVEL, LINE_LEVEL, TEXT_LEVEL = 3.0, 8.0, 9.0


def dimension(axes: Axes, start: Place, end: Place, text: str, offset: float, *, role: Role = Role.DIMENSION) -> None:
    """The distance from ``start`` to ``end``, drawn ``offset`` mm on paper to the left of that direction, with arrows.

    The text stands above the line where it is long enough, else level beside it, on the far side of what is measured.
    """
    unit = per_paper_mm(axes)
    first, last = MM * np.array(start), MM * np.array(end)
    along = (last - first) / np.linalg.norm(last - first)
    outward = np.array([-along[1], along[0]]) * (1.0 if offset >= 0.0 else -1.0)
    for point in (first, last) if abs(offset) > 1.5 else ():
        reach = np.array([[0.8], [abs(offset) + 1.2]]) * unit
        stroke(axes, point + reach * outward, role, level=LINE_LEVEL)
    first, last = first + abs(offset) * unit * outward, last + abs(offset) * unit * outward
    span = float(np.linalg.norm(last - first)) / unit
    inside = span >= 2.0 * ARROW_LENGTH + 1.0
    tail = 0.0 if inside else 2.0 * ARROW_LENGTH * unit
    stroke(axes, [first - tail * along, last + tail * along], role, level=LINE_LEVEL)
    _arrow(axes, first, -along if inside else along, role)
    _arrow(axes, last, along if inside else -along, role)
    middle = 0.5 * (first + last)
    if text_fits(axes, float(np.hypot(end[0] - start[0], end[1] - start[1])), text):
        _text_along(axes, middle, along, text, role)
    else:
        _text(axes, middle + 1.8 * unit * outward, text, role, *_sides(atan2(outward[1], outward[0])))


def text_fits(axes: Axes, length: float, text: str) -> bool:
    """Whether a dimension line of this length (m) has room for its text between the arrows."""
    return MM * length / per_paper_mm(axes) >= text_width(text, TEXT_SIZE) + 2.0 * ARROW_LENGTH


def radius_dimension(
    axes: Axes, centre: Place, radius: float, direction: float, text: str = "", *, role: Role = Role.DIMENSION
) -> bool:
    """An arrow from the centre to the circle at angle ``direction`` (rad), with text along it; False if too short."""
    unit = per_paper_mm(axes)
    middle, outward = MM * np.array(centre), _unit_vector(direction)
    rim = middle + MM * radius * outward
    text = text or millimetres(radius)
    if MM * radius / unit < text_width(text, TEXT_SIZE) + ARROW_LENGTH + 2.0:
        return False
    stroke(axes, [middle, rim], role, level=LINE_LEVEL)
    _arrow(axes, rim, outward, role)
    _text_along(axes, 0.5 * (middle + rim) - 0.5 * ARROW_LENGTH * unit * outward, outward, text, role)
    return True


def angle_arc(
    axes: Axes, corner: Place, start: float, end: float, text: str, *, reach: float = 9.0, role: Role = Role.DIMENSION
) -> None:
    """An arc with an arrow from angle ``start`` to ``end`` (rad, counter-clockwise), ``reach`` mm from the corner."""
    unit = per_paper_mm(axes)
    middle = MM * np.array(corner)
    size = 2.0 * reach * unit
    turn = min(ARROW_LENGTH / reach, 0.6 * (end - start))
    look = {"color": role.line, "linewidth": FINE, "zorder": LINE_LEVEL, "clip_on": False}
    arc = Arc(_pair(middle), size, size, theta1=degrees(start), theta2=degrees(end - 0.8 * turn))
    axes.add_patch(arc).set(**look)
    _arrow(axes, middle + reach * unit * _unit_vector(end), _unit_vector(end - 0.5 * turn + 0.5 * pi), role)
    halfway = 0.5 * (start + end)
    _text(axes, middle + (reach + 1.2) * unit * _unit_vector(halfway), text, role, *_sides(halfway))


def friction_cone(axes: Axes, contact: Place, inward: float, half_angle: float, *, length: float = 11.0) -> None:
    """The forces that finger or palm can put on the object: a cone from the contact about the direction ``inward``."""
    size = length * per_paper_mm(axes)
    point, role = MM * np.array(contact), Role.FORCE
    wedge = Wedge(_pair(point), size, degrees(inward - half_angle), degrees(inward + half_angle))
    look = {"facecolor": role.fill, "edgecolor": role.line, "alpha": 0.75, "linewidth": FINE}
    axes.add_patch(wedge).set(**look, zorder=CONE_LEVEL, clip_on=False)
    axis = [point, point + size * _unit_vector(inward)]
    stroke(axes, axis, role, level=CONE_LEVEL + 0.1, dashes=CENTRE_LINE)


def force(
    axes: Axes, tip: Place, direction: float, text: str = "", *, length: float = 12.0, role: Role = Role.FORCE
) -> None:
    """A force arrow that ends at ``tip``, pointing along ``direction`` (rad); its text stands at the tail."""
    unit, towards = per_paper_mm(axes), _unit_vector(direction)
    end = MM * np.array(tip)
    tail = end - length * unit * towards
    stroke(axes, [tail, end - ARROW_LENGTH * unit * towards], role, level=LINE_LEVEL, width=1.3 * NORMAL)
    _arrow(axes, end, towards, role, 1.5)
    _text(axes, tail - unit * towards, text, role, *_sides(direction + pi))


def label(axes: Axes, target: Place, text: str, shift: tuple[float, float], *, role: Role = Role.DIMENSION) -> None:
    """Text ``shift`` mm on paper from what it names, joined to it by a thin leader that ends in a dot."""
    unit = per_paper_mm(axes)
    point = MM * np.array(target)
    place = point + unit * np.array(shift)
    direction = atan2(shift[1], shift[0])
    stroke(axes, [point, place], role, level=LINE_LEVEL)
    disc(axes, point, 0.4 * unit, Role.CAPTION if role is Role.DIMENSION else role, level=LINE_LEVEL, width=FINE)
    _text(axes, place + 0.8 * unit * _unit_vector(direction), text, role, *_sides(direction))


def note(
    axes: Axes,
    place: Place,
    text: str,
    *,
    role: Role = Role.CAPTION,
    size: float = TEXT_SIZE,
    upright: str = "center",
    bold: bool = False,
) -> None:
    """Plain text centred at a place."""
    _text(axes, MM * np.array(place), text, role, "center", upright, size=size, bold=bold)


def scale_bar(axes: Axes, *, share: float = 0.3) -> None:
    """A bar of a round length in the panel's lower left corner, at most ``share`` of its width."""
    unit = per_paper_mm(axes)
    (left, right), bottom = axes.get_xlim(), axes.get_ylim()[0]
    longest = share * (right - left)
    power = 10.0 ** floor(log10(longest))
    length = max(step * power for step in (1.0, 2.0, 5.0) if step * power <= longest)
    start = np.array([left + 1.5 * unit, bottom + 2.0 * unit])
    end, tick = start + np.array([length, 0.0]), np.array([0.0, 0.8 * unit])
    stroke(axes, [start, end], Role.DIMENSION, level=LINE_LEVEL, width=NORMAL)
    for point in (start, end):
        stroke(axes, [point - tick, point + tick], Role.DIMENSION, level=LINE_LEVEL)
    place = 0.5 * (start + end) + 1.2 * tick
    _text(axes, place, millimetres(length / MM), Role.DIMENSION, "center", "bottom", size=SMALL_SIZE)


def _arrow(axes: Axes, tip: Floats, towards: Floats, role: Role, factor: float = 1.0) -> None:
    """A filled arrow head with its point at ``tip``."""
    unit = factor * per_paper_mm(axes)
    side = np.array([-towards[1], towards[0]]) * 0.5 * ARROW_WIDTH * unit
    foot = tip - ARROW_LENGTH * unit * towards
    head = shape(axes, [tip, foot + side, foot - side], role, level=LINE_LEVEL, width=0.0)
    head.set_facecolor(role.line)


def _text(
    axes: Axes,
    place: Floats,
    text: str,
    role: Role,
    across: str,
    upright: str,
    *,
    size: float = TEXT_SIZE,
    turned: float = 0.0,
    bold: bool = False,
) -> None:
    drawn = axes.text(place[0], place[1], text, color=role.line, fontsize=size, rotation=turned, rotation_mode="anchor")
    drawn.set(ha=across, va=upright, fontweight="bold" if bold else "normal", zorder=TEXT_LEVEL, clip_on=False)


def _text_along(axes: Axes, middle: Floats, along: Floats, text: str, role: Role) -> None:
    """Text centred above a line, never upside down."""
    turn = atan2(along[1], along[0])
    if not -0.5 * pi + 1e-9 < turn <= 0.5 * pi + 1e-9:
        turn += pi
    place = middle + 0.7 * per_paper_mm(axes) * _unit_vector(turn + 0.5 * pi)
    _text(axes, place, text, role, "center", "baseline", turned=degrees(turn) % 360.0)


def _sides(direction: float) -> tuple[str, str]:
    """How text must be aligned to stand clear of a point that it is seen from in ``direction``."""
    x, y = cos(direction), sin(direction)
    across = "center" if abs(x) < 0.35 else ("left" if x > 0.0 else "right")
    upright = "center" if abs(y) < 0.5 else ("bottom" if y > 0.0 else "top")
    return across, upright


def _unit_vector(direction: float) -> Floats:
    return np.array([cos(direction), sin(direction)])


def _pair(point: Floats) -> Place:
    return float(point[0]), float(point[1])
