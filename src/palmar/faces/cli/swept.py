"""``--sweep``: a planar region along the axis of a finite cylinder, written as a solid."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import Any

from shapely import MultiPolygon, box

from palmar.errors import InputError
from palmar.faces.cli.printing import numbers
from palmar.faces.exports.solid_file import SOLIDS, write_solid
from palmar.geometry.planar_set import areal, coordinates
from palmar.geometry.prism import prism
from palmar.models.case import Case
from palmar.models.quantity import Unit

FORM = "LENGTH_MM[,WIDTH_MM]"
Record = dict[str, Any]


def swept_lengths(text: str) -> tuple[float, float]:
    """Of the cylinder, and of the hand along it (m); raises InputError."""
    values = [Unit.MILLIMETRE.to_si(each) for each in numbers(text, "--sweep", (1, 2), FORM)]
    length, width = values[0], values[1] if len(values) > 1 else 0.0
    if not length > 0.0 or width < 0.0:
        raise InputError("--sweep", text[:60], f"must be {FORM}, the length above 0, the width not below")
    if length <= width:
        raise InputError(
            "--sweep", text[:60], "the cylinder is no longer than the hand is wide: it slips out between the fingers"
        )
    return length, width


def write_swept(out: Path | None, centre: MultiPolygon, text: str, palm: float | None = None) -> tuple[str, Record]:
    """Write the region of the hand's middle along the cylinder; what to say of it, and its record. Raises InputError.

    A hand of width w along the axis of a cylinder of length l has all of it beside the cylinder while its middle is within
    (l - w) / 2 of the cylinder's: so long is the region swept. The source asks for l of at least 2 w. With ``palm``, half
    the palm's width (m), only the palm feels the object, so that it has to meet the palm first: only that strip is left.
    """
    length, width = swept_lengths(text)
    if out is None or out.suffix.lower() not in SOLIDS:
        raise InputError("--out", None if out is None else str(out), f"--sweep writes {', '.join(SOLIDS)}")
    if palm is not None and not centre.is_empty:
        left, low, right, high = centre.bounds
        centre = areal(centre & box(max(left, -palm), low, min(right, palm), high))
    if centre.is_empty:
        raise InputError("--sweep", text[:60], "nothing is caught, so there is no region to sweep")
    reach = 0.5 * (length - width)
    mesh = prism(centre, -reach, reach)
    write_solid(out, mesh)
    size = f"{1e6 * mesh.volume:.4g} cm3, {2e3 * reach:.4g} mm along the axis"
    said = [f"Written: {out} ({len(mesh.triangles)} triangles, {size})"]
    if palm is not None:
        said.append(f"Only the palm feels: {1e4 * centre.area:.4g} cm2 are left, the strip of its width.")
    if length < 2.0 * width:
        said.append("The source asks for a cylinder at least twice as long as the hand is wide; this one is shorter.")
    record = {
        "file": str(out),
        "length_m": length,
        "width_m": width,
        "along_axis_m": 2.0 * reach,
        "twice_as_long": length >= 2.0 * width,
        "palm_only": palm is not None,
        "area_m2": centre.area,
        "centre": coordinates(centre),
        "volume_m3": mesh.volume,
        "triangles": len(mesh.triangles),
    }
    return "\n".join(said), record


def tilt_of(case: Case, text: str) -> tuple[str, list[Record]]:
    """What a tilted wrist leaves of a case's region, in words and as records; nothing to say where that is not known."""
    from palmar.studies.tilted_hand import tilted_hand

    found = tilted_hand(case, swept_lengths(text)[1])
    if not found:
        return "", []
    lines = ["The wrist tilted against the cylinder's axis leaves"]
    for each in found[1:]:
        part = f"  {degrees(each.angle):.0f} deg: {_share(each.certain, found[0].certain)} of what is certain"
        if each.estimate is not None and found[0].estimate is not None:
            part += f", about {_share(each.estimate, found[0].estimate)} of the region"
        lines.append(part)
    records = [
        {
            "tilt_rad": each.angle,
            "certain_area_m2": each.certain,
            "estimated_area_m2": each.estimate,
            "estimated_error_m": None if each.room is None else each.room.radius,
        }
        for each in found
    ]
    return "\n".join(lines), records


def _share(part: float, whole: float) -> str:
    return "none" if whole == 0.0 else f"{100.0 * part / whole:.0f} %"
