"""``--sweep``: a planar region along the axis of a finite cylinder, written as a solid."""

from __future__ import annotations

from pathlib import Path

from shapely import MultiPolygon

from palmar.errors import InputError
from palmar.faces.cli.printing import numbers
from palmar.faces.exports.solid_file import SOLIDS, write_solid
from palmar.geometry.prism import prism
from palmar.models.quantity import Unit

FORM = "LENGTH_MM[,WIDTH_MM]"


def write_swept(out: Path | None, centre: MultiPolygon, text: str) -> str:
    """Write the region of the hand's middle along the cylinder, and say how long it is; raises InputError.

    A hand of width w along the axis of a cylinder of length l has all of it beside the cylinder while its middle is within
    (l - w) / 2 of the cylinder's: so long is the region swept. The source asks for l of at least 2 w.
    """
    values = [Unit.MILLIMETRE.to_si(each) for each in numbers(text, "--sweep", (1, 2), FORM)]
    length, width = values[0], values[1] if len(values) > 1 else 0.0
    if not length > 0.0 or width < 0.0:
        raise InputError("--sweep", text[:60], f"must be {FORM}, the length above 0, the width not below")
    if out is None or out.suffix.lower() not in SOLIDS:
        raise InputError("--out", None if out is None else str(out), f"--sweep writes {', '.join(SOLIDS)}")
    if length <= width:
        raise InputError(
            "--sweep", text[:60], "the cylinder is no longer than the hand is wide: it slips out between the fingers"
        )
    if centre.is_empty:
        raise InputError("--sweep", text[:60], "nothing is caught, so there is no region to sweep")
    reach = 0.5 * (length - width)
    mesh = prism(centre, -reach, reach)
    write_solid(out, mesh)
    size = f"{1e6 * mesh.volume:.4g} cm3, {2e3 * reach:.4g} mm along the axis"
    said = f"Written: {out} ({len(mesh.triangles)} triangles, {size})"
    if length < 2.0 * width:
        said += "\nThe source asks for a cylinder at least twice as long as the hand is wide; this one is shorter."
    return said
