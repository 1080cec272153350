"""The drawings of the derivation pages: `python docs/derivations/figures.py` writes the SVG files beside it.

The output is the same byte for byte from run to run. Strokes are of middle brightness, so that one file is legible
on a light and on a dark page; the colours are told apart by colour-blind readers.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from check_region import D, L, R, latest_loss, spiral, sweep, tip_phase
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Wedge
from numpy.typing import NDArray

Floats = NDArray[np.float64]
HERE = Path(__file__).resolve().parent
INK, DISK, FORCE, REGION = "#7d7d7d", "#2f86c1", "#d55e00", "#009e73"
ALPHA = float(np.radians(35))


def panels(count: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """Empty drawings side by side, to scale and without axes."""
    figure, axes = plt.subplots(1, count, figsize=(width, height), layout="constrained")
    for axis in axes:
        axis.set_aspect("equal")
        axis.axis("off")
    return figure, list(axes)


def save(figure: Figure, name: str) -> None:
    """Write a figure beside this script, without a date."""
    figure.savefig(HERE / f"{name}.svg", transparent=True, metadata={"Date": None, "Creator": None})
    plt.close(figure)


def label(axis: Axes, x: float, y: float, text: str, colour: str = INK, **options: str) -> None:
    """Text in the colour of what it names."""
    axis.text(x, y, text, color=colour, ha=options.get("ha", "center"), va=options.get("va", "center"), fontsize=10)


def caption(axis: Axes, text: str) -> None:
    """The line above a drawing."""
    axis.set_title(text, color=INK, fontsize=10)


def hand(axis: Axes, half_palm: float, length: float, psi: float) -> Floats:
    """Palm and both line fingers; returns the right fingertip."""
    axis.plot([-half_palm, half_palm], [0, 0], color=INK, lw=4, solid_capstyle="butt")
    tip = np.array([half_palm + length * np.cos(psi), length * np.sin(psi)])
    for side in (1, -1):
        axis.plot([side * half_palm, side * tip[0]], [0, tip[1]], color=INK, lw=2.2, solid_capstyle="round")
        axis.plot([side * half_palm], [0], "o", color=INK, ms=6)
    return tip


def disk(axis: Axes, y: float, radius: float) -> None:
    """Outline and centre of a disk on the axis."""
    axis.add_patch(Circle((0, y), radius, fill=False, color=DISK, lw=2))
    axis.plot([0], [y], "+", color=DISK, ms=7)


def cone(axis: Axes, contact: Floats, towards: Floats, alpha: float, size: float) -> None:
    """Friction cone at a contact, opening towards the disk."""
    middle = float(np.degrees(np.arctan2(*(towards - contact)[::-1])))
    half = float(np.degrees(alpha))
    axis.add_patch(Wedge((contact[0], contact[1]), size, middle - half, middle + half, color=FORCE, alpha=0.25, lw=0))
    axis.annotate(
        "",
        (contact[0] - size, contact[1]),
        (contact[0], contact[1]),
        arrowprops={"arrowstyle": "->", "color": FORCE, "lw": 1.4},
    )


def dot(axis: Axes, contact: Floats) -> None:
    """A contact and its mirror image."""
    for side in (1, -1):
        axis.plot([side * contact[0]], [contact[1]], "o", color=FORCE, ms=5, zorder=5)


def structural() -> None:
    """The largest disk between long fingers, and the smallest and largest between short ones."""
    figure, axes = panels(3, 9.6, 3.6)
    hand(axes[0], 1, 1.4, np.pi / 2)
    disk(axes[0], 1, 1)
    dot(axes[0], np.array([1, 1]))
    caption(axes[0], "D ≤ L: largest, R = D")
    for axis, sign, name in ((axes[1], -1, "smallest"), (axes[2], 1, "largest")):
        radius = (1.2 + sign * np.sqrt(2 - 1.2**2)) / 2
        hand(axis, 1.2, 1, float(np.arctan2(radius, radius - 1.2)))
        disk(axis, radius, radius)
        dot(axis, np.array([radius, radius]))
        axis.plot([-radius, radius], [radius, radius], color=DISK, lw=0.8, ls=":")
        caption(axis, f"D = 1.2 L: {name}, R = {radius:.3f} L")
    for axis in axes:
        axis.set(xlim=(-1.35, 1.35), ylim=(-0.1, 2.1))
    save(figure, "closure_structural")


def frictional() -> None:
    """Largest off the palm, largest on the palm, smallest: the contact at the edge of the cone or at the tip."""
    s, c = np.sin(ALPHA), np.cos(ALPHA)
    figure, axes = panels(3, 9.6, 4.4)
    radius = (0.7 + s) / c
    tip = hand(axes[0], 0.7, 1, np.pi / 2 - ALPHA)
    caption(axes[0], f"D = 0.7 L: largest, R = {radius:.3f} L")
    draw_hold(axes[0], tip, np.array([0, tip[1] + radius * s]), radius)
    radius = (1.2 * c + np.sqrt(2 * (1 - s) - (1.2 * (1 - s)) ** 2)) / (2 * (1 - s))
    tip = hand(axes[1], 1.2, 1, float(np.arctan2(radius * (1 - s), radius * c - 1.2)))
    caption(axes[1], f"D = 1.2 L: largest, R = {radius:.3f} L")
    draw_hold(axes[1], tip, np.array([0, radius]), radius)
    radius = (1.2**2 - 1) / 2
    tip = hand(axes[2], 1.2, 1, float(np.arctan2(radius, -1.2)))
    caption(axes[2], f"D = 1.2 L: smallest, R = {radius:.3f} L")
    draw_hold(axes[2], tip, np.array([0, radius]), radius)
    for axis in axes[:2]:
        axis.set(xlim=(-2.15, 2.15), ylim=(-0.15, 4.2))
    axes[2].set(xlim=(-1.3, 1.3), ylim=(-0.5, 0.8))
    save(figure, "closure_friction")


def draw_hold(axis: Axes, tip: Floats, centre: Floats, radius: float) -> None:
    """A disk held by both tips, with the right one's friction cone."""
    disk(axis, centre[1], radius)
    dot(axis, tip)
    for side in (1, -1):
        axis.plot([side * tip[0], 0], [tip[1], centre[1]], color=DISK, lw=0.8, ls=":")
    cone(axis, tip, centre, ALPHA, 0.4 * radius + 0.12)


def outlines(alpha: float) -> dict[str, Floats]:
    """Right halves of the published curves and of the solved edge, for one friction angle."""
    end = sweep(alpha) - alpha
    phi = np.linspace(0, end, 400)[:, None]
    along, across = np.hstack([np.cos(phi), np.sin(phi)]), np.hstack([-np.sin(phi), np.cos(phi)])
    contact = [D, 0] + (L - R * end + R * phi) * along
    reached = latest_loss(alpha)
    solved = np.concatenate([spiral(L - R * reached, reached), tip_phase(reached, alpha)[2]])
    return {
        "contact": contact,
        "centre": contact + R * across,
        "whole": contact + R * (across + along),
        "solved": solved,
    }


def region() -> None:
    """Contact, centre and whole regions of the example hand; the band that friction does not keep."""
    figure, axes = panels(2, 9.6, 4.6)
    for axis, alpha, name in ((axes[0], 0.0, "without friction"), (axes[1], ALPHA, "friction angle 35°")):
        curves = outlines(alpha)
        centre, solved = curves["centre"], curves["solved"]
        top = [[0, centre[-1, 1]]]
        axis.add_patch(Polygon(np.concatenate([[[0, R]], centre, top]), color=REGION, alpha=0.25, lw=0))
        axis.plot(*np.concatenate([centre, top]).T, color=REGION, lw=2.2)
        axis.plot(*solved.T, color=FORCE, lw=1.6, ls="--")
        axis.plot(*curves["contact"].T, color=DISK, lw=1.4)
        axis.plot(*curves["whole"].T, color=DISK, lw=1.4, ls=":")
        axis.plot([0, 0], [-0.1, 3], color=INK, lw=0.8, ls=(0, (8, 3, 2, 3)))
        axis.plot([0, D], [0, 0], color=INK, lw=4, solid_capstyle="butt")
        axis.plot([D, D + L], [0, 0], color=INK, lw=2.2)
        axis.plot([D], [0], "o", color=INK, ms=6)
        caption(axis, name)
        label(axis, 0.5, -0.14, "half palm")
        label(axis, 2.55, -0.14, "open finger")
        label(axis, 0.9, 1.1, "centre region", REGION)
        axis.set(xlim=(-0.1, 3.2), ylim=(-0.25, 3.05))
    label(axes[0], 0.62, 2.08, "solved edge", FORCE)
    label(axes[0], 2.24, 0.24, "contact", DISK, ha="left")
    label(axes[0], 2.2, 1.85, "whole", DISK, ha="left")
    label(axes[1], 0.6, 2.28, "solved edge", FORCE)
    label(axes[1], 2.4, 2.1, "whole", DISK, ha="left")
    label(axes[1], 2.55, 0.24, "contact", DISK, ha="left")
    save(figure, "published_region")


def main() -> None:
    """Write all figures."""
    plt.switch_backend("svg")
    plt.rcParams.update({"svg.hashsalt": "palmar", "svg.fonttype": "path", "font.family": "DejaVu Sans"})
    structural()
    frictional()
    region()


if __name__ == "__main__":
    main()
