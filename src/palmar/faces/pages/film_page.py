"""The film of one closing motion as one self-contained HTML page: a drawing, the poses, and the script that moves it."""

from __future__ import annotations

import json
from html import escape
from importlib import resources
from importlib.metadata import version
from itertools import accumulate
from math import degrees
from string import Template

import numpy as np

from palmar.faces.plots.film_scene import Scene, ticks
from palmar.faces.plots.sheet import MM, Extent
from palmar.faces.words import headline
from palmar.models.objects import Disk

PACES = (0.01, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0)
"""Speeds to choose from, besides the film's own."""
SIDE, BELOW, ABOVE = 0.07, 0.07, 0.03
"""Free room around the motion, as shares of the drawing's width; tick labels stand there."""


def film_page(film: Scene) -> str:
    """The page's HTML; no request leaves it."""
    return Template(_resource("film.html")).substitute(
        title=escape(f"{headline(film.doing, film.case)}, friction {film.case.contact.friction:.3g}"),
        style=_resource("film.css"),
        script=_resource("film.js"),
        verdict=escape(f"{film.verdict}."),
        mood="held" if film.outcome.caught else "lost",
        drawing=_drawing(film),
        place=film.place_name,
        duration=repr(film.duration),
        marks="".join(f'<option value="{time!r}"></option>' for time, _ in film.events),
        paces=_paces(film.pace),
        events="\n".join(
            f'<li><button type="button" data-time="{time!r}"><time>{time:.3f} s</time> {escape(words)}</button></li>'
            for time, words in film.events
        )
        or "<li>none</li>",
        version=escape(version("palmar")),
        data=json.dumps(_data(film), allow_nan=False, separators=(",", ":")),
    )


def _data(film: Scene) -> dict[str, object]:
    """Everything that changes with time: s, mm, degrees; fingers right and left, joint by joint; the palm's height."""
    places = np.column_stack((MM * film.poses[:, :2], np.degrees(film.poses[:, 2])))
    return {
        "times": [float(f"{each:.9g}") for each in film.times[:-1]] + [film.duration],
        "poses": _short(places),
        "fingers": _short(np.degrees(film.fingers)),
        "palm": _short(MM * np.array([[film.palm_at(time)] for time in film.times])),
        "contacts": [_short(MM * np.array(each).reshape(-1, 2)) for each in film.contacts],
    }


def _short(rows: np.ndarray) -> list[list[float]]:
    """Six significant digits, which is finer than a screen shows."""
    return [[float(f"{value:.6g}") + 0.0 for value in row] for row in rows.tolist()]


def _paces(own: float) -> str:
    names = {pace: f"{pace:g} × real time" for pace in sorted({*PACES, own})} | {1.0: "real time"}
    chosen = {pace: " selected" if pace == own else "" for pace in names}
    return "".join(f'<option value="{pace!r}"{chosen[pace]}>{name}</option>' for pace, name in names.items())


def _drawing(film: Scene) -> str:
    extent = film.extent
    width = MM * extent.size[0]
    left, right = MM * extent.left - SIDE * width, MM * extent.right + 0.5 * SIDE * width
    low, high = MM * extent.bottom - BELOW * width, MM * extent.top + ABOVE * width
    way = " ".join(f"{_mm(x)},{_mm(-y)}" for x, y in film.poses[:, :2])
    x, y, turn = film.poses[0]
    at = f'transform="translate({_mm(x)} {_mm(-y)}) rotate({-degrees(turn):.6g})"'
    parts = [
        f'<svg viewBox="{left:.6g} {-high:.6g} {right - left:.6g} {high - low:.6g}" role="img" '
        f'aria-label="The hand closing on the object, seen from above; lengths in mm">',
        *_grid(extent, (left, right), (low, high)),
        f'<line class="axis" x1="0" x2="0" y1="{-low:.6g}" y2="{-high:.6g}"/>',
        *_wall(film, (left, right), high),
        f"<g {at}>{_outline(film, 'start')}</g>",
        f'<polyline class="way" points="{way}"/>',
        f'<g id="object" {at}>{_outline(film, "object")}{_mark(film)}</g>',
        '<polyline id="gone" class="gone" points=""/>',
        _fingers(film),
        '<circle class="contact" data-r="4.5" r="0" style="display: none"/>' * max(map(len, film.contacts)),
        "</svg>",
    ]
    return "\n".join(parts)


def _grid(extent: Extent, across: tuple[float, float], upright: tuple[float, float]) -> list[str]:
    """Grid lines at round millimetres, labelled below and at the left."""
    (left, right), (low, high) = across, upright
    edge, parts = 0.006 * (right - left), []
    for x in ticks(extent.left, extent.right, extent):
        parts.append(f'<line class="grid" x1="{x:.6g}" x2="{x:.6g}" y1="{-low:.6g}" y2="{-high:.6g}"/>')
        parts.append(f'<text x="{x:.6g}" y="{-low - edge:.6g}" text-anchor="middle">{_label(x)}</text>')
    for y in ticks(extent.bottom, extent.top, extent):
        parts.append(f'<line class="grid" y1="{-y:.6g}" y2="{-y:.6g}" x1="{left:.6g}" x2="{right:.6g}"/>')
        parts.append(f'<text y="{-y - 0.5 * edge:.6g}" x="{left + edge:.6g}">{_label(y)}</text>')
    return [
        *parts,
        f'<text class="units" x="{right - edge:.6g}" y="{-high:.6g}" dy="1.3em" text-anchor="end">x, y in mm</text>',
    ]


def _wall(film: Scene, across: tuple[float, float], high: float) -> list[str]:
    """What is behind the wall, if there is one."""
    if film.case.support.wall is None:
        return []
    (left, right), wall = across, MM * film.case.support.wall
    return [
        f'<rect class="wall" x="{left:.6g}" y="{-high:.6g}" width="{right - left:.6g}" height="{high - wall:.6g}"/>'
    ]


def _outline(film: Scene, name: str) -> str:
    item = film.case.object
    if isinstance(item, Disk):
        return f'<circle class="{name}" r="{_mm(item.radius)}"/>'
    points = " ".join(f"{_mm(x)},{_mm(-y)}" for x, y in item.vertices)
    return f'<polygon class="{name}" points="{points}"/>'


def _mark(film: Scene) -> str:
    """A line along the x axis of the object's frame, which shows its turn."""
    (x, y), far = film.mark
    line = f'<line class="mark" x1="{_mm(x)}" y1="{_mm(-y)}" x2="{_mm(x + far)}" y2="{_mm(-y)}"/>'
    return f'{line}<circle class="dot" cx="{_mm(x + 0.8 * far)}" cy="{_mm(-y)}" data-r="4" r="0"/>'


def _fingers(film: Scene) -> str:
    """Palm and both fingers along the x axis from their base joints; the script turns each part about its joint."""
    base = MM * film.case.hand.half_palm
    right, left = film.at(0.0)[1]
    return (
        f'<g id="hand" transform="translate(0 {_mm(-film.palm_at(0.0))})">'
        f'<line class="palm" x1="{-base:.6g}" x2="{base:.6g}"/>'
        f'<g transform="translate({-base:.6g} 0) scale(-1 1)">{_finger(film, "left", left)}</g>'
        f'<g transform="translate({base:.6g} 0)">{_finger(film, "right", right)}</g></g>'
    )


def _finger(film: Scene, side: str, joints: tuple[float, ...]) -> str:
    """Its parts, each in the frame of the one before, turned about its own joint; those at the tip are drawn first."""
    hand, drawn = film.case.hand, ""
    count = len(film.bodies)
    for k in reversed(range(count)):
        links = hand.finger_links if count == 1 else hand.finger_links[k : k + 1]
        at = MM * sum(film.bodies[:k][-1:])
        drawn = (
            f'<g transform="translate({at:.6g} 0)"><g id="{side}-{k}" transform="rotate({-degrees(joints[k]):.6g})">'
            f"{drawn}{_part(links, hand.half_thickness)}</g></g>"
        )
    return drawn


def _part(links: tuple[float, ...], half_thickness: float) -> str:
    """Links in a row along the x axis, with their joints."""
    length, h = MM * sum(links), MM * half_thickness
    if h:
        size = f'width="{length + 2.0 * h:.6g}" height="{2.0 * h:.6g}"'
        body = f'<rect class="capsule" x="{-h:.6g}" y="{-h:.6g}" {size} rx="{h:.6g}"/>'
        body += f'<line class="axis" x2="{length:.6g}"/>'
    else:
        body = f'<line class="finger" x2="{length:.6g}"/>'
    joints = [0.0, *accumulate(links[:-1])]
    return body + "".join(f'<circle class="joint" cx="{_mm(each)}" data-r="4" r="0"/>' for each in joints)


def _mm(length: float) -> str:
    """A length (m) in mm."""
    return f"{MM * length + 0.0:.6g}"


def _label(value: float) -> str:
    return f"{value + 0.0:g}".replace("-", "\N{MINUS SIGN}")


def _resource(name: str) -> str:
    return resources.files("palmar.faces.pages").joinpath(name).read_text(encoding="utf-8")
