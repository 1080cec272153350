"""The frames of a film as pictures: what stands still is drawn once, what moves is drawn onto it frame by frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.ticker import FixedLocator
from matplotlib.transforms import Affine2D
from numpy.typing import NDArray

from palmar.faces.plots.film_scene import Scene, angle_words, place_words, ticks
from palmar.faces.plots.hand import JOINT_LEVEL, OBJECT_LEVEL, draw_finger, draw_object, draw_palm, draw_wall
from palmar.faces.plots.sheet import MARGIN, MM, Pad, Room, Sheet, per_paper_mm, sheet
from palmar.faces.plots.strokes import CENTRE_LINE, disc, stroke
from palmar.faces.plots.style import FINE, HEADING_SIZE, NORMAL, SMALL_SIZE, TEXT_SIZE, Role
from palmar.faces.words import headline

DPI = 120
RATE = 20
"""Pictures per second."""
HELD = 1.5
"""How long (s) the last picture stays."""
ROOM = Room(Pad(4.0, 4.0, 4.0, 4.0), Pad(13.0, 11.0, 2.0, 3.0), Pad(0.0, 5.0, 0.0, 6.0), highest=160.0)
MARK_SIZE, CONTACT_SIZE = 1.6, 2.0
"""Diameters on paper (mm)."""
GONE_LEVEL, CONTACT_LEVEL = OBJECT_LEVEL + 0.3, JOINT_LEVEL + 1.0


def moments(film: Scene) -> list[float]:
    """The motion's time (s) at each picture, RATE to the film's second; the first is the start and the last the end."""
    count = round(film.duration / film.pace * RATE)
    return [*np.linspace(0.0, film.duration, count + 1).tolist()] if count else [film.duration]


def frames(film: Scene, times: Sequence[float]) -> Iterator[NDArray[np.uint8]]:
    """RGB pictures (height, width, 3) of the motion at these times (s), both sizes even."""
    title = headline(film.doing, film.case)
    page = sheet([[film.extent]], title=f"{title}, {_friction(film)}", room=ROOM)
    axes = page.panels[0][0]
    _ticks(axes, film)
    _still(axes, film)
    clock, event = _lines(page)
    pace = "" if film.pace == 1.0 else f" ({film.pace_words})"
    moving = _Moving(axes, film)
    canvas: Any = FigureCanvasAgg(page.figure)
    page.figure.set_dpi(DPI)
    canvas.draw()
    box = page.figure.bbox
    paper = canvas.copy_from_bbox(box)
    for time in times:
        canvas.restore_region(paper)
        moving.draw(time)
        x, y, turn = film.at(time)[0]
        clock.set_text(f"t = {time:.2f} s{pace}    {film.place_name} {place_words(x, y)}    turned {angle_words(turn)}")
        event.set_text(_last_event(film, time))
        event.set_color(
            (Role.HELD if film.outcome.caught else Role.LOST).line if time == film.duration else Role.CAPTION.line
        )
        for text in (clock, event):
            page.figure.draw_artist(text)
        picture = np.asarray(canvas.buffer_rgba())[:, :, :3]
        yield picture[: len(picture) // 2 * 2, : picture.shape[1] // 2 * 2].copy()


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
    """Axis of symmetry, where the object started, and the way of its centre."""
    low, high = axes.get_ylim()
    stroke(axes, [(0.0, low), (0.0, high)], Role.GHOST, level=0.0, dashes=CENTRE_LINE)
    if film.case.support.wall is not None:
        draw_wall(axes, film.case.support.wall)
    x, y, turn = film.poses[0]
    draw_object(axes, film.case.object, (x, y), turn, ghost=True, mark=False, level=0.5)
    if film.duration:
        stroke(axes, MM * film.poses[:, :2], Role.GHOST, level=0.6, width=NORMAL)


class _Moving:
    """What moves and what lies on it, made once: rigid groups, the way gone so far, a dot for every contact."""

    def __init__(self, axes: Axes, film: Scene) -> None:
        self.axes, self.film, hand = axes, film, film.case.hand
        self.thing = _made(axes, lambda: _object(axes, film))
        self.bends = len(film.bodies) > 1
        self.right, self.left = self._fingers((0.0,), (0.0,))
        (self.gone,) = _made(axes, lambda: stroke(axes, [(0.0, 0.0)], Role.SMALLEST, level=GONE_LEVEL, width=NORMAL))
        self.palm = _made(axes, lambda: draw_palm(axes, hand))
        most = max(len(each) for each in film.contacts)
        self.dots = [_dot(axes, (0.0, 0.0), CONTACT_SIZE, Role.FORCE, CONTACT_LEVEL) for _ in range(most)]
        self._in_order()

    def draw(self, time: float) -> None:
        """Draw the moment (s) onto the canvas."""
        film, base = self.film, MM * self.film.case.hand.half_palm
        (x, y, turn), (right, left) = film.at(time)
        self._place(self.thing, Affine2D().rotate(turn).translate(MM * x, MM * y))
        height = MM * film.palm_at(time)
        self._place(self.palm, Affine2D().translate(0.0, height))
        if self.bends:
            for artist in (*self.right, *self.left):
                artist.remove()
            self.right, self.left = self._fingers(right, left)
            self._in_order()
        else:
            self._place(self.right, Affine2D().rotate_around(base, 0.0, right[0]).translate(0.0, height))
            self._place(self.left, Affine2D().rotate_around(-base, 0.0, -left[0]).translate(0.0, height))
        self.gone.set(data=MM * np.vstack((film.poses[film.times < time, :2], (x, y))).T)
        points = film.contacts[film.index(time)]
        for k, dot in enumerate(self.dots):
            dot.set_visible(k < len(points))
            if k < len(points):
                self._place([dot], Affine2D().translate(MM * points[k][0], MM * points[k][1]))
        for artist in self.artists:
            self.axes.draw_artist(artist)

    def _fingers(self, right: Sequence[float], left: Sequence[float]) -> tuple[list[Any], list[Any]]:
        """The artists of both fingers at joint angles (rad); fingers that bend are made anew for every picture."""
        axes, hand = self.axes, self.film.case.hand
        return (
            _made(axes, lambda: draw_finger(axes, hand, right)),
            _made(axes, lambda: draw_finger(axes, hand, left, left=True)),
        )

    def _in_order(self) -> None:
        every = [*self.thing, *self.palm, *self.left, *self.right, self.gone, *self.dots]
        self.artists = sorted(every, key=lambda each: float(each.get_zorder()))
        for artist in every:
            artist.set_animated(True)

    def _place(self, artists: list[Artist], motion: Affine2D) -> None:
        for artist in artists:
            artist.set_transform(motion + self.axes.transData)


def _made(axes: Axes, draw: Callable[[], object]) -> list[Any]:
    """The artists that ``draw`` adds."""
    before = set(axes.get_children())
    draw()
    return [each for each in axes.get_children() if each not in before]


def _object(axes: Axes, film: Scene) -> None:
    """The object about its frame's origin, with a mark that shows its turn."""
    draw_object(axes, film.case.object, (0.0, 0.0), fill=0.85)
    (x, y), length = film.mark
    x, y, far = MM * x, MM * y, MM * length
    stroke(axes, [(x, y), (x + far, y)], Role.OBJECT, level=OBJECT_LEVEL + 0.1, width=NORMAL)
    _dot(axes, (x + 0.8 * far, y), MARK_SIZE, Role.OBJECT, OBJECT_LEVEL + 0.2)


def _dot(axes: Axes, place: tuple[float, float], size: float, role: Role, level: float) -> Patch:
    """A solid dot, ``size`` mm across on paper, at a place in mm."""
    dot = disc(axes, place, 0.5 * size * per_paper_mm(axes), role, level=level, width=FINE)
    dot.set_facecolor(role.line)
    return dot


def _lines(page: Sheet) -> tuple[Text, Text]:
    """Two lines of text that change: time and place above the panel, the latest event below."""
    page.write((MARGIN, page.box(page.panels[0][0]).top + 2.5), "", size=HEADING_SIZE)
    page.write((MARGIN, MARGIN), "", size=HEADING_SIZE, bold=True)
    clock, event = page.figure.texts[-2:]
    for text in (clock, event):
        text.set_animated(True)
    return clock, event


def _ticks(axes: Axes, film: Scene) -> None:
    axes.set_axis_on()
    for axis, name in ((axes.xaxis, "x (mm)"), (axes.yaxis, "y (mm)")):
        low, high = axis.get_view_interval()
        axis.set_major_locator(FixedLocator(ticks(1e-3 * low, 1e-3 * high, film.extent)))
        axis.set_label_text(name, fontsize=TEXT_SIZE, color=Role.DIMENSION.line)
    axes.tick_params(labelsize=SMALL_SIZE, width=FINE, color=Role.DIMENSION.line, labelcolor=Role.DIMENSION.line)
    axes.ticklabel_format(style="plain", useOffset=False)
    for spine in axes.spines.values():
        spine.set(color=Role.DIMENSION.line, linewidth=FINE)
