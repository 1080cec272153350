"""The measurements of chapter 6, repeated, as one self-contained page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from importlib import resources
from importlib.metadata import version

from palmar.faces.pages.html import picture, table
from palmar.faces.plots.bed_picture import bed_picture
from palmar.studies.bed_causes import BED, LINES
from palmar.studies.bed_report import ANGLES, FREE_ANGLES, FREE_TOLERANCE, TOLERANCE, BedReport, Row

PICTURED = (LINES, BED, "pressure 4 mm aside", "the bed at 15 deg/s")
SAID = {
    "table": "Published: at most 1 cm (5.5 %) smaller than theory, less at large angles; the disk turned by 15 deg;"
    " closing up to 20 deg/s, grasps failed above. Each row below the theory changes one thing.",
    "free": "Published: theory radially 34 % smaller than the experiment."
    " Restitution and the fingers' mass were not measured.",
    "effects": "How much one change adds to the limits of the row that it changes, over the directions."
    " Both limits were searched to the step in the last column, so their difference is known to that.",
    "meanings": "By how much the exact region on the table reaches further than the printed one, in four senses.",
    "preshape": "Published: 19.5 deg for lines and 28.5 deg with the thickness, by theory; 35 deg measured at 1 deg/s.",
}
PRINTED = {LINES: "19.5 deg, theory", "fingers 25 mm thick": "28.5 deg, theory; 35 deg, measured"}


def bed_page(report: BedReport) -> str:
    """The page's HTML."""
    style = resources.files("palmar.faces.pages").joinpath("report.css").read_text(encoding="utf-8")
    shown = [row for name in PICTURED for row in report.table if row.name == name]
    body = [
        "<h1>The planar test bed: chapter 6 measured again</h1>",
        f"<h2>On the table</h2><p>{escape(SAID['table'])}</p>",
        f"<p>Limits of the disk's centre from the palm's middle, each known to {1e3 * TOLERANCE:g} mm.</p>",
        table(*limits_table(report.table, ANGLES)),
        picture(bed_picture(report.table[0], shown), "Differences from the published theory by direction"),
        f"<h3>What radially means</h3><p>{escape(SAID['meanings'])}</p>",
        table(*meanings_table(report)),
        "<h3>How far the disk has turned at the end</h3>",
        table(
            ("hand", "median", "largest"),
            [(each.name, _angle(each.median), _angle(each.largest)) for each in report.turns],
        ),
        f"<h2>In free space</h2><p>{escape(SAID['free'])}</p>",
        f"<p>Reach of the first contact from the right joint, each known to {1e3 * FREE_TOLERANCE:g} mm.</p>",
        table(*limits_table(report.free, FREE_ANGLES)),
        f"<h2>Candidate causes, one at a time</h2><p>{escape(SAID['effects'])}</p>",
        table(*effects_table(report)),
        f"<h2>The preshape that keeps the disk on a circle</h2><p>{escape(SAID['preshape'])}</p>",
        table(*preshapes_table(report)),
    ]
    return "\n".join(
        [
            '<!doctype html><html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>Test bed - palmar</title><style>{style}</style></head><body><main>",
            *body,
            f"<footer>palmar {escape(version('palmar'))}</footer></main></body></html>",
        ]
    )


def limits_table(rows: Sequence[Row], angles: Sequence[float]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads and rows: limits in mm, behind each how far it is from the first row's."""
    heads = ("", "found by", *(f"{math.degrees(each):g} deg" for each in angles))
    return heads, [
        (row.name, row.physics, *(_cell(found, told) for found, told in zip(row.limits, rows[0].limits, strict=True)))
        for row in rows
    ]


def effects_table(report: BedReport) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads and rows: what each change does to the limits, in mm."""
    heads = ("cause", "change", "found by", "least", "largest", "known to")
    return heads, [
        (each.cause, each.name, each.physics, _apart(each.least), _apart(each.largest), f"{1e3 * each.known:g} mm")
        for each in report.effects
    ]


def meanings_table(report: BedReport) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads and rows: by what share the exact region reaches further than the printed one."""
    heads = ("radially", "hand", "least", "largest")
    return heads, [
        (each.name, each.hand, f"{100.0 * each.least:+.1f} %", f"{100.0 * each.largest:+.1f} %")
        for each in report.meanings
    ]


def preshapes_table(report: BedReport) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads and rows: the curl found, and what the source prints."""
    return ("hand", "kernels", "MuJoCo", "published"), [
        (
            each.name,
            "-" if each.kernels is None else _angle(each.kernels),
            _angle(each.other),
            PRINTED.get(each.name, "-"),
        )
        for each in report.preshapes
    ]


def _cell(found: float | None, told: float | None) -> str:
    if found is None:
        return "-"
    share = "" if told is None or found == told else f" ({100.0 * (found / told - 1.0):+.1f} %)"
    return f"{1e3 * found:.1f} mm{share}"


def _angle(value: float) -> str:
    return f"{math.degrees(value):.2f} deg"


def _apart(value: float) -> str:
    return f"{1e3 * value:+.1f} mm"
