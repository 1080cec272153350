"""The frames of a film as pictures: what stands still is drawn once, what moves is drawn onto it frame by frame."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, sin

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from palmar.faces.plots.film_scene import Scene, angle_words, place_words
from palmar.faces.plots.hand import JOINT_LEVEL, OBJECT_LEVEL, draw_finger, draw_object, draw_palm
from palmar.faces.plots.sheet import MARGIN, MM, Pad, Room, Sheet, per_paper_mm, sheet
from palmar.faces.plots.strokes import CENTRE_LINE, disc, stroke
from palmar.faces.plots.style import FINE, HEADING_SIZE, NORMAL, SMALL_SIZE, TEXT_SIZE, Role
from palmar.faces.words import headline
from palmar.models.objects import Disk

DPI = 120
RATE = 20
"""Pictures per second."""
HELD = 1.5
"""How long (s) the last picture stays."""
ROOM = Room(Pad(4.0, 4.0, 4.0, 4.0), Pad(13.0, 11.0, 2.0, 3.0), Pad(0.0, 5.0, 0.0, 6.0), highest=160.0)
MARK_SIZE, CONTACT_SIZE = 1.6, 2.0
"""Diameters on paper (mm)."""


def frames(film: Scene) -> Iterator[NDArray[np.uint8]]:
    """RGB pictures (height, width, 3), both sizes even, RATE to the film's second."""
    title = headline("Closing", film.case)
    page = sheet([[film.extent]], title=f"{title}, {_friction(film)}", room=ROOM)
    axes = page.panels[0][0]
    _ticks(axes)
    _still(axes, film)
    clock, event = _lines(page)
    canvas = FigureCanvasAgg(page.figure)
    page.figure.set_dpi(DPI)
    canvas.draw()
    box = page.figure.bbox
    paper = canvas.copy_from_bbox(box)
    for time in _moments(film):
        canvas.restore_region(paper)
        for artist in _moving(axes, film, time):
            axes.draw_artist(artist)
            artist.remove()
        x, y, turn = _at(film, time)[0]
        clock.set_text(f"t = {time:.2f} s    centre {place_words(x, y)}    turned {angle_words(turn)}")
        event.set_text(_last_event(film, time))
        event.set_color((Role.HELD if film.outcome.caught else Role.LOST).line if time == film.duration else "#1A1A1A")
        for text in (clock, event):
            page.figure.draw_artist(text)
        picture = np.asarray(canvas.buffer_rgba())[:, :, :3]
        yield picture[: len(picture) // 2 * 2, : picture.shape[1] // 2 * 2].copy()


def _moments(film: Scene) -> list[float]:
    """The motion's time (s) at each picture; the first is the start and the last the end."""
    count = round(film.duration / film.pace * RATE)
    return [*np.linspace(0.0, film.duration, count + 1).tolist()] if count else [film.duration]


def _at(film: Scene, time: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Pose (m, m, rad) and base angles right and left at any time, linear between the poses."""
    pose = tuple(float(np.interp(time, film.times, column)) for column in film.poses.T)
    return pose, tuple(float(np.interp(time, film.times, column)) for column in film.fingers.T)


def _friction(film: Scene) -> str:
    return f"friction {film.case.contact.friction:.3g}"


def _last_event(film: Scene, time: float) -> str:
    if time == film.duration:
        return film.verdict
    past = [(when, words) for when, words in film.events if when <= time]
    if not past:
        return ""
    last = past[-1][0]
    return f"{last:.2f} s: {', '.join(words for when, words in past if when > last - 1e-3)}"


def _still(axes: Axes, film: Scene) -> None:
    """Axis of symmetry, palm, where the object started, and the way of its centre."""
    low, high = axes.get_ylim()
    stroke(axes, [(0.0, low), (0.0, high)], Role.GHOST, level=0.0, dashes=CENTRE_LINE)
    x, y, turn = film.poses[0]
    draw_object(axes, film.case.object, (x, y), turn, ghost=True, mark=False, level=0.5)
    draw_palm(axes, film.case.hand)
    if film.duration:
        stroke(axes, MM * film.poses[:, :2], Role.GHOST, level=0.6, width=NORMAL)


def _moving(axes: Axes, film: Scene, time: float) -> list[Artist]:
    """The artists of one moment, lowest first."""
    before = set(axes.get_children())
    (x, y, turn), (right, left) = _at(film, time)
    draw_object(axes, film.case.object, (x, y), turn, fill=0.85)
    item = film.case.object
    far = item.radius if isinstance(item, Disk) else 0.6 * float(np.linalg.norm(item.vertices, axis=1).min())
    mark = MM * np.array([(x, y), (x + far * cos(turn), y + far * sin(turn))])
    stroke(axes, mark, Role.OBJECT, level=OBJECT_LEVEL + 0.1, width=NORMAL)
    _dot(axes, mark[0] + 0.8 * (mark[1] - mark[0]), MARK_SIZE, Role.OBJECT, OBJECT_LEVEL + 0.2)
    past = np.vstack((film.poses[film.times < time, :2], (x, y)))
    if np.ptp(past, axis=0).max() > 0.0:
        stroke(axes, MM * past, Role.SMALLEST, level=OBJECT_LEVEL + 0.3, width=NORMAL)
    for psi, is_left in ((left, True), (right, False)):
        draw_finger(axes, film.case.hand, (psi,), left=is_left)
    for point in film.contacts[int(np.searchsorted(film.times, time, side="right")) - 1]:
        _dot(axes, MM * np.array(point), CONTACT_SIZE, Role.FORCE, JOINT_LEVEL + 1.0)
    new = [each for each in axes.get_children() if each not in before]
    return sorted(new, key=lambda each: float(each.get_zorder()))


def _dot(axes: Axes, place: NDArray[np.float64], size: float, role: Role, level: float) -> None:
    """A solid dot, ``size`` mm across on paper, at a place in mm."""
    disc(axes, place, 0.5 * size * per_paper_mm(axes), role, level=level, width=FINE).set_facecolor(role.line)


def _lines(page: Sheet) -> tuple[Text, Text]:
    """Two lines of text that change: time and place above the panel, the latest event below."""
    page.write((MARGIN, page.box(page.panels[0][0]).top + 2.5), "", size=HEADING_SIZE)
    page.write((MARGIN, MARGIN), "", size=HEADING_SIZE, bold=True)
    clock, event = page.figure.texts[-2:]
    for text in (clock, event):
        text.set_animated(True)
    return clock, event


def _ticks(axes: Axes) -> None:
    axes.set_axis_on()
    for axis, name in ((axes.xaxis, "x (mm)"), (axes.yaxis, "y (mm)")):
        axis.set_major_locator(MaxNLocator(nbins=8, steps=[1, 2, 5, 10]))
        axis.set_label_text(name, fontsize=TEXT_SIZE, color=Role.DIMENSION.line)
    axes.tick_params(labelsize=SMALL_SIZE, width=FINE, color=Role.DIMENSION.line, labelcolor=Role.DIMENSION.line)
    axes.ticklabel_format(style="plain", useOffset=False)
    for spine in axes.spines.values():
        spine.set(color=Role.DIMENSION.line, linewidth=FINE)
