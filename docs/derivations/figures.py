"""The drawings of the derivation pages: `python docs/derivations/figures.py` writes the SVG files beside it.

The output is the same byte for byte from run to run. Strokes are of middle brightness, so that one file is legible
on a light and on a dark page; the colours are told apart by colour-blind readers.
"""

from __future__ import annotations

from pathlib import Path as File

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon, Wedge
from matplotlib.path import Path
from numpy.typing import NDArray
from shapely import box

from palmar.faces.plots.closure_map_picture import map_picture
from palmar.faces.plots.style import save as write_picture
from palmar.geometry.planar_set import areal
from palmar.mechanics.closure.shortest_hand import shortest_hand
from palmar.mechanics.impact.three_impacts_4_2_1 import construction
from palmar.mechanics.pushing.hand_pose import LINK_WIDTH, MOVING, hand_motion, place_links
from palmar.mechanics.pushing.uniform_disk import secant_ratio
from palmar.regions.certified import certified_sets
from palmar.regions.three_impacts_4_2_1 import contact_points, three_impact_sets

Floats = NDArray[np.float64]
HERE = File(__file__).resolve().parent
INK, DISK, FORCE, REGION = "#7d7d7d", "#2f86c1", "#d55e00", "#009e73"
ALPHA = float(np.radians(35))
D, L, R = 1.0, 2.0, 0.5  # the example hand, line fingers


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


def sweep(alpha: float) -> float:
    """Finger angle A at which a fingertip grips the centred disk alpha below its equator."""
    return float(np.pi - np.arccos((D - R * np.cos(alpha)) / L))


def across(psi: Floats, beta: Floats | float = 0.0) -> Floats:
    """Unit vectors m, the finger's normal n at psi turned by beta towards the finger (beta = 0: n itself)."""
    return np.stack([-np.sin(psi - beta), np.cos(psi - beta)], axis=-1)


def linked(r: Floats | float, psi: Floats, beta: Floats | float = 0.0) -> Floats:
    """Centres of a disk that touches the right finger at r with the normal m (beta)."""
    along = np.stack([np.cos(psi), np.sin(psi)], axis=-1)
    return np.array([D, 0]) + np.asarray(r)[..., None] * along + R * across(psi, beta)


def force_angle(beta: Floats, alpha: float) -> Floats:
    """The angle gamma of tip_phase.md: the sticking one, at most alpha."""
    k = np.linspace(0, 6, 3001)
    ratio = np.array([each * secant_ratio(1 / each) if each > 0 else 0.0 for each in k])
    k, gamma = k[ratio < 0.99], np.arcsin(ratio[ratio < 0.99])
    sticking = np.interp(beta, np.arctan(np.tan(gamma) + k / np.cos(gamma)), gamma)
    return np.asarray(np.minimum(sticking, alpha))


def tip_rate(beta: Floats, alpha: float) -> Floats:
    """dbeta/dpsi on the tip."""
    gamma = force_angle(beta, alpha)
    return np.asarray(1 + L / R * np.sin(beta - gamma) / np.cos(gamma))


def last_caught(alpha: float) -> tuple[float, Floats]:
    """The last disk caught: the finger's turn on the tip, and the path of its centre there."""
    beta = np.linspace(0, sweep(alpha) - np.pi / 2 + alpha, 2001)
    slowness = 1 / tip_rate(beta, alpha)
    turn = np.concatenate([[0], np.cumsum((slowness[1:] + slowness[:-1]) / 2 * np.diff(beta))])
    return float(turn[-1]), linked(L, sweep(alpha) - turn[-1] + turn, beta)


def spiral(r0: float, begin: float, end: float) -> Floats:
    """Centres of the disks that touch the right finger at r0 + R (phi - begin) while phi goes from begin to end."""
    phi = np.linspace(begin, end, 1001)
    return linked(r0 + R * (phi - begin), phi)


def outlines(alpha: float) -> dict[str, Floats]:
    """Right halves of the published curves and of the solved edge, for one friction angle."""
    end = sweep(alpha) - alpha
    phi = np.linspace(0, end, 400)[:, None]
    along, normal = np.hstack([np.cos(phi), np.sin(phi)]), np.hstack([-np.sin(phi), np.cos(phi)])
    contact = [D, 0] + (L - R * end + R * phi) * along
    turn, on_tip = last_caught(alpha)
    reached = sweep(alpha) - turn
    solved = np.concatenate([spiral(L - R * reached, 0, reached), on_tip])
    return {
        "contact": contact,
        "centre": contact + R * normal,
        "whole": contact + R * (normal + along),
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


def arrow(axis: Axes, start: Floats, end: Floats, colour: str) -> None:
    """A vector from start to end."""
    style = {"arrowstyle": "->", "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0}
    axis.annotate("", (end[0], end[1]), (start[0], start[1]), arrowprops=style)


def round_disk(axis: Axes, centre: Floats, faint: bool = False) -> None:
    """A disk of the example hand anywhere."""
    style = {"lw": 1.2, "ls": ":"} if faint else {"lw": 2.0}
    axis.add_patch(Circle((centre[0], centre[1]), R, fill=False, color=DISK, **style))


def closing() -> None:
    """Phases of one start; the set of centres that the hand allows; the wedge that friction locks."""
    figure, axes = panels(3, 9.6, 3.6)
    draw_phases(axes[0])
    draw_allowed(axes[1], float(np.radians(84)))
    draw_wedge(axes[2])
    for axis in axes[:2]:
        axis.set(xlim=(-1.8, 1.8), ylim=(-0.2, 2.85))
    axes[2].set(xlim=(-0.75, 1.25), ylim=(-0.1, 1.36))
    save(figure, "sweeping")


def draw_phases(axis: Axes) -> None:
    """From the start (1.1, 1.3) on the right link to the axis, and between both links down to the palm."""
    q = np.array([0.1, 1.3])
    r0 = float(np.sqrt(q @ q - R**2))
    psi0 = float(np.arctan2(q[1], q[0]) - np.arcsin(R / np.hypot(*q)))
    path = spiral(r0, psi0, np.pi)
    path = path[: int(np.argmax(path[:, 0] < 0)) + 1]
    end = 2 * np.arctan2(D, R)
    hand(axis, D, L, float(end))
    round_disk(axis, path[0], faint=True)
    round_disk(axis, path[-1], faint=True)
    disk(axis, R, R)
    axis.plot(*path.T, color=FORCE, lw=2.2)
    axis.plot([0, 0], [path[-1, 1], R], color=REGION, lw=2.2)
    label(axis, 0.62, 1.78, "link", FORCE)
    label(axis, -0.45, 1.0, "both", REGION, ha="right")
    caption(axis, "link, both links, held")


def draw_allowed(axis: Axes, psi: float) -> None:
    """Centres that palm, links and tips allow at one finger angle, between the fingers and above them."""
    tip = hand(axis, D, L, psi)
    lean = np.linspace(0, np.pi / 2, 200)
    edge = np.concatenate([linked(np.linspace(0.3, L, 50), np.full(50, psi)), linked(L, np.full(200, psi), lean)])
    edge = edge[(edge[:, 1] >= R) & (edge[:, 0] >= 0)]
    corner = D - (R - R * np.cos(psi)) / np.sin(psi)
    right = np.concatenate([[[corner, R]], edge, [[edge[-1, 0], 2.85]]])
    outline = np.concatenate([right, (right * [-1, 1])[::-1]])
    axis.add_patch(Polygon(outline, color=REGION, alpha=0.22, lw=0))
    for side in (1, -1):
        axis.plot(side * right[:-1, 0], right[:-1, 1], color=REGION, lw=2)
        axis.add_patch(Circle((side * tip[0], tip[1]), R, fill=False, color=REGION, lw=0.9, ls=":"))
    axis.plot([-corner, corner], [R, R], color=REGION, lw=2)
    at = linked(L, np.array(psi), np.radians(40))
    arrow(axis, at, at + 0.4 * across(np.array(psi), np.radians(40)), FORCE)
    axis.plot(*at, "o", color=FORCE, ms=4)
    at = linked(0.75, np.array(psi))
    arrow(axis, at, at + 0.3 * across(np.array(psi)), FORCE)
    axis.plot(*at, "o", color=FORCE, ms=4)
    label(axis, at[0] - 0.37, at[1] + 0.03, "v", FORCE)
    label(axis, tip[0] + 0.28, tip[1] - 0.1, "ρ", REGION)
    axis.plot([tip[0], tip[0] + R * np.cos(0.1)], [tip[1], tip[1] + R * np.sin(0.1)], color=REGION, lw=0.9)
    caption(axis, "allowed centres")


def draw_wedge(axis: Axes) -> None:
    """A disk between palm and right link at the limit of the wedge, with chord and cones, for 35 degrees."""
    psi = np.pi - 2 * ALPHA
    x = D - (R - R * np.cos(psi)) / np.sin(psi)
    centre, foot = np.array([x, R]), np.array([x, 0.0])
    touch = centre - R * across(np.array(psi))
    axis.plot([-D, D], [0, 0], color=INK, lw=4, solid_capstyle="butt")
    axis.plot([D, D + 1.4 * np.cos(psi)], [0, 1.4 * np.sin(psi)], color=INK, lw=2.2)
    axis.plot([D], [0], "o", color=INK, ms=6)
    round_disk(axis, centre)
    for contact, other in ((foot, touch), (touch, foot)):
        middle = float(np.degrees(np.arctan2(*(centre - contact)[::-1])))
        wide = float(np.degrees(ALPHA))
        axis.add_patch(
            Wedge((contact[0], contact[1]), 0.42, middle - wide, middle + wide, color=FORCE, alpha=0.25, lw=0)
        )
        axis.plot(*np.array([contact, centre]).T, color=DISK, lw=0.8, ls=":")
        axis.plot(*contact, "o", color=FORCE, ms=5)
        axis.plot(*np.array([contact, other]).T, color=FORCE, lw=1.6)
    caption(axis, "wedge: half the angle is α")


def fingertip() -> None:
    """The disk on the tip with its angles, and the rate of the lean for three frictions."""
    figure, axes = panels(2, 9.6, 4.0)
    draw_tip(axes[0], float(np.radians(100)), float(np.radians(38)))
    figure.delaxes(axes[1])
    plot = figure.add_subplot(1, 2, 2)
    beta = np.linspace(0, np.pi / 2, 721)
    for alpha, colour, name, at in (
        (0.0, DISK, "α = 0", (17, 2.55)),
        (np.radians(10), REGION, "10°", (71, 4.25)),
        (ALPHA, FORCE, "35°", (78, 3.85)),
    ):
        rate, sticks = tip_rate(beta, alpha), force_angle(beta, alpha) < alpha
        plot.plot(np.degrees(beta[sticks]), rate[sticks], color=colour, lw=2)
        plot.plot(np.degrees(beta[~sticks]), rate[~sticks], color=colour, lw=2, ls="--")
        end = sweep(alpha) - np.pi / 2 + alpha
        plot.plot(np.degrees(end), np.interp(end, beta, tip_rate(beta, alpha)), "o", color=colour, ms=7)
        label(plot, *at, name, colour)
    plot.set(xlim=(0, 90), ylim=(1, 5.05), xticks=[0, 30, 60, 90], xticklabels=["0°", "30°", "60°", "90°"])
    plot.set_xlabel("β", color=INK, fontsize=10)
    plot.tick_params(colors=INK)
    plot.spines[["top", "right"]].set_visible(False)
    plot.spines[["left", "bottom"]].set_color(INK)
    plot.set_facecolor("none")
    caption(plot, "β′, per radian of finger")
    save(figure, "tip_phase")


def draw_tip(axis: Axes, psi: float, beta: float) -> None:
    """Finger, disk on its tip, both normals and the angle between them, and the elevation."""
    tip = np.array([D + L * np.cos(psi), L * np.sin(psi)])
    n, m = across(np.array(psi)), across(np.array(psi), beta)
    axis.plot([D, tip[0]], [0, tip[1]], color=INK, lw=2.6)
    axis.plot([D], [0], "o", color=INK, ms=6)
    axis.plot([-0.6, D], [0, 0], color=INK, lw=4, solid_capstyle="butt")
    centre = tip + R * m
    round_disk(axis, centre)
    axis.plot(*centre, "+", color=DISK, ms=7)
    axis.plot([centre[0] - 0.1, centre[0] + R + 0.25], [centre[1], centre[1]], color=DISK, lw=0.8, ls=":")
    axis.plot([tip[0], centre[0]], [tip[1], centre[1]], color=DISK, lw=0.8, ls=":")
    for vector, name in ((n, "n"), (m, "m")):
        arrow(axis, tip, tip + 0.8 * vector, FORCE)
        label(axis, *(tip + 0.92 * vector), name, FORCE)
    left = float(np.degrees(np.arctan2(n[1], n[0])))
    for middle, size, low, high, colour in (
        (tip, 0.6, left - np.degrees(beta), left, FORCE),
        (centre, 0.3, np.degrees(psi - beta) - 90, 0, DISK),
    ):
        arc = np.radians(np.linspace(low, high, 60))
        axis.plot(middle[0] + size * np.cos(arc), middle[1] + size * np.sin(arc), color=colour, lw=1.2)
        half = np.radians((low + high) / 2)
        name = "β" if colour == FORCE else "e"
        label(axis, middle[0] + (size + 0.13) * np.cos(half), middle[1] + (size + 0.13) * np.sin(half), name, colour)
    label(axis, 0.98, 1.0, "L")
    label(axis, 1.08, 0.12, "joint", ha="left")
    axis.set(xlim=(-0.7, 1.6), ylim=(-0.1, 2.95))


def certified() -> None:
    """Inner side and band before a bent hand, coarse and fine."""
    motion, radius = hand_motion(1.0, [1.1, 0.9], offsets=[0.4]), 0.5
    rows = np.zeros((2 * len(motion.links) + 1, LINK_WIDTH))
    place_links(motion, motion.first, MOVING, MOVING, rows)
    figure, axes = panels(2, 8.4, 2.6)
    for axis, share in zip(axes, (0.15, 0.05), strict=True):
        sets = certified_sets(motion, radius, share=share)
        band = areal(sets.outer - sets.inner)
        for whole, colour in ((sets.inner, REGION), (band, FORCE)):
            for part in whole.geoms:
                rings = [np.asarray(ring.coords) for ring in (part.exterior, *part.interiors)]
                path = Path.make_compound_path(*[Path(ring, closed=True) for ring in rings])
                axis.add_patch(PathPatch(path, color=colour, alpha=0.35 if colour == REGION else 0.9, lw=0))
        for row in rows:
            axis.plot(row[[0, 2]], row[[1, 3]], color=INK, lw=2.5, solid_capstyle="round")
        caption(axis, f"{sets.starts} starts, band {100.0 * sets.share:.1f} % of the inner area")
        axis.set(xlim=(-3.1, 3.1), ylim=(-0.15, 2.3))
    save(figure, "certified")


def free() -> None:
    """The disk of three impacts, and the centre regions of both constructions in the right half plane."""
    half_palm, length, radius = 6.0, 24.4, 3.8
    figure, axes = panels(2, 8.4, 4.2)
    right = construction(half_palm, length, radius)
    assert right is not None
    for axis in axes:
        axis.plot([0, half_palm], [0, 0], color=INK, lw=4, solid_capstyle="butt")
    centres = []
    turns = (right.first_angle, right.second_angle, right.end)
    for r, psi in zip((right.first, right.second, right.third), turns, strict=True):
        along, normal = np.array([np.cos(psi), np.sin(psi)]), np.array([-np.sin(psi), np.cos(psi)])
        base = np.array([half_palm, 0.0])
        axes[0].plot(*np.stack([base, base + length * along]).T, color=INK, lw=2)
        centres.append(base + r * along + radius * normal)
        axes[0].plot(*(base + r * along), "o", color=FORCE, ms=5, zorder=5)
        axes[0].add_patch(Circle(centres[-1], radius, fill=False, ec=DISK, lw=1.5))
    axes[0].plot(*np.array(centres).T, color=DISK, lw=1, ls="--")
    for published, colour in ((True, FORCE), (False, REGION)):
        region_at = three_impact_sets(half_palm, length, radius, 0.0, 1e-3, published=published).centre
        half = areal(region_at & box(0.0, 0.0, length, 2.0 * length))
        line = np.asarray(half.geoms[0].exterior.coords)
        axes[1].fill(*line.T, color=colour, alpha=0.25, lw=0)
        axes[1].plot(*line.T, color=colour, lw=1.5)
        numbers = construction(half_palm, length, radius, published=published)
        assert numbers is not None
        axes[1].plot(*contact_points(half_palm, numbers).T, color=colour, lw=0.8, marker="o", ms=3)
    for axis in axes:
        axis.set(xlim=(-4.5, 31.0), ylim=(-1.0, 29.0))
    save(figure, "zero_gravity")


def four_jointed() -> None:
    """The maps of chapter 5, and the length of the shortest hand over its number of links."""
    write_picture(map_picture(), HERE / "four_jointed_map.png")
    figure, axis = plt.subplots(figsize=(7.2, 3.0), layout="constrained")
    counts = range(1, 9)
    lengths = [shortest_hand(each, 1.0).length for each in counts]
    axis.axhline(np.pi, color=INK, lw=1, ls="--")
    axis.plot(counts, lengths, color=DISK, marker="o", lw=1.5)
    for count, length in zip(counts, lengths, strict=True):
        axis.annotate(
            f"{length:.3f}", (count, length), xytext=(4, 5), textcoords="offset points", color=INK, fontsize=9
        )
    axis.annotate("π", (8.4, np.pi), xytext=(0, -12), textcoords="offset points", color=INK)
    axis.set(xlim=(0.7, 8.6), ylim=(3.05, 4.1), xlabel="links a finger", ylabel="length of the shortest hand / R")
    axis.spines[["top", "right"]].set_visible(False)
    axis.spines[["left", "bottom"]].set_color(INK)
    axis.tick_params(colors=INK)
    axis.xaxis.label.set_color(INK)
    axis.yaxis.label.set_color(INK)
    save(figure, "four_jointed_links")


def main() -> None:
    """Write all figures."""
    plt.switch_backend("svg")
    plt.rcParams.update({"svg.hashsalt": "palmar", "svg.fonttype": "path", "font.family": "DejaVu Sans"})
    structural()
    frictional()
    region()
    closing()
    fingertip()
    certified()
    free()
    four_jointed()


if __name__ == "__main__":
    main()
