"""A region as a file for other programs or for print; the ending of the name chooses the format."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from shapely import MultiPolygon

from palmar.errors import InputError
from palmar.faces.exports.whole_file import write_whole
from palmar.faces.records import finite, region_record
from palmar.geometry.planar_set import coordinates, seen_from_object
from palmar.models.case import Case
from palmar.regions.region import Region

DRAWN = (".svg", ".pdf", ".png")
ENDINGS = (*DRAWN, ".dxf", ".geojson", ".csv", ".json")


def known_ending(path: Path) -> None:
    """Raise InputError unless the path's ending is one that can be written."""
    if path.suffix.lower() not in ENDINGS:
        raise InputError("--out", str(path), f"the name must end in one of {', '.join(ENDINGS)}")


def write_region(
    path: Path, case: Case, region: Region, *, from_object: bool = False, record: dict[str, Any] | None = None
) -> None:
    """Write the region whole or not at all; lengths in mm, except json, which is the command's ``record`` in SI.

    Raises InputError for an unknown ending, OutputError where the file cannot be written.
    """
    known_ending(path)
    ending = path.suffix.lower()
    if ending in DRAWN:
        from palmar.faces.plots.region_picture import region_picture
        from palmar.faces.plots.style import save

        save(region_picture(case, region, seen_from_object=from_object), path)
        return
    if ending == ".dxf":
        from palmar.faces.exports.region_dxf import write_dxf

        write_whole(path, lambda partial: write_dxf(partial, case, _sets(region, from_object), from_object=from_object))
        return
    texts: dict[str, Callable[[], str]] = {
        ".geojson": lambda: _geojson(region, from_object),
        ".csv": lambda: _csv(region, from_object),
        ".json": lambda: json.dumps(finite(record or region_record(region, from_object=from_object)), allow_nan=False),
    }
    text = texts[ending]()
    write_whole(path, lambda partial: _write_text(partial, text))


def _sets(region: Region, from_object: bool) -> dict[str, MultiPolygon]:
    sets = {"centre": region.centre, "contact": region.contact, "whole": region.whole}
    return {name: seen_from_object(each) for name, each in sets.items()} if from_object else sets


def _geojson(region: Region, from_object: bool) -> str:
    features: list[dict[str, Any]] = [
        {
            "type": "Feature",
            "properties": {
                "region": name,
                "unit": "mm",
                "frame": "object" if from_object else "hand",
                "model": region.model.value,
                "closure": region.closure.value,
                "guarantee": region.guarantee.value,
            },
            "geometry": {"type": "MultiPolygon", "coordinates": _millimetres(coordinates(each))},
        }
        for name, each in _sets(region, from_object).items()
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}, allow_nan=False)


def write_places(path: Path, sets: dict[str, MultiPolygon]) -> None:
    """Write named sets of places (m, the arm's base frame) as GeoJSON in mm, whole or not at all."""
    features = [
        {
            "type": "Feature",
            "properties": {"region": name, "unit": "mm", "frame": "base"},
            "geometry": {"type": "MultiPolygon", "coordinates": _millimetres(coordinates(each))},
        }
        for name, each in sets.items()
    ]
    text = json.dumps({"type": "FeatureCollection", "features": features}, allow_nan=False)
    write_whole(path, lambda partial: _write_text(partial, text))


def _csv(region: Region, from_object: bool) -> str:
    rows: list[list[object]] = [["region", "polygon", "ring", "x_mm", "y_mm"]]
    for name, each in _sets(region, from_object).items():
        for number, polygon in enumerate(_millimetres(coordinates(each))):
            rows += [[name, number, ring, x, y] for ring, points in enumerate(polygon) for x, y in points]
    return "".join(",".join(map(str, row)) + "\n" for row in rows)


def _millimetres(value: Any) -> Any:
    """Nested coordinate lists from m to mm, to the nearest nanometre."""
    return [_millimetres(each) for each in value] if isinstance(value, list) else round(1e3 * value, 6)


def _write_text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
