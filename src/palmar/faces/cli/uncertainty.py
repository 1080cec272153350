"""A set of position errors as given on the command line: disk:R_MM, box:W_MM,H_MM or the name of a GeoJSON file."""

from __future__ import annotations

import json
from math import cos, pi
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely import Point
from shapely.errors import GEOSException
from shapely.geometry.base import BaseGeometry

from palmar.errors import InputError
from palmar.faces.cli.printing import numbers
from palmar.geometry.planar_set import areal
from palmar.models.quantity import LARGEST_LENGTH
from palmar.models.text_file import read_text

FORM = "disk:R_MM, box:W_MM,H_MM or the name of a GeoJSON file in mm"
CORNERS, MOST_CORNERS = 128, 500
"""A disk is the regular polygon of so many corners around it; the most a file may have, and its size in bytes."""


def parse_uncertainty(text: str, option: str = "--uncertainty") -> BaseGeometry:
    """The set (m) of errors about the nominal place, which is its origin; polygons only, with an area.

    Raises InputError in one line.
    """
    kind, _, rest = text.partition(":")
    if kind == "disk" and rest:
        (radius,) = _lengths(rest, option, 1, "disk:R_MM")
        return Point(0.0, 0.0).buffer(radius / cos(pi / CORNERS), quad_segs=CORNERS // 4)
    if kind == "box" and rest:
        wide, high = _lengths(rest, option, 2, "box:W_MM,H_MM")
        return shapely.box(-0.5 * wide, -0.5 * high, 0.5 * wide, 0.5 * high)
    if not Path(text).suffix:
        raise InputError(option, repr(text[:60]), f"must be {FORM}")
    return _read(Path(text))


def _lengths(text: str, option: str, count: int, form: str) -> list[float]:
    values = [1e-3 * each for each in numbers(text, option, (count,), form)]
    if min(values) <= 0.0 or max(values) > LARGEST_LENGTH:
        raise InputError(option, repr(text[:60]), f"lengths must be above 0 and at most {1e3 * LARGEST_LENGTH:g} mm")
    return values


def _read(path: Path) -> BaseGeometry:
    """The polygons of a GeoJSON file (geometry, feature or collection), from mm to m."""
    text = read_text(path)
    try:
        given = json.loads(text)
        found = shapely.union_all([part for each in _geometries(given) for part in areal(each).geoms])
    except (ValueError, TypeError, KeyError, AttributeError, IndexError, RecursionError, GEOSException):
        raise InputError(str(path), None, "is not GeoJSON with polygons in mm") from None
    return _checked(shapely.transform(found, lambda points: 1e-3 * points), path)


def _geometries(given: dict[str, Any]) -> list[BaseGeometry]:
    if given["type"] == "FeatureCollection":
        return [each for feature in given["features"] for each in _geometries(feature)]
    return [shapely.geometry.shape(given["geometry"] if given["type"] == "Feature" else given)]


def _checked(found: BaseGeometry, path: Path) -> BaseGeometry:
    corners = shapely.get_coordinates(found)
    if found.is_empty or not found.area > 0.0:
        raise InputError(str(path), None, "must hold a polygon with an area")
    if len(corners) > MOST_CORNERS:
        raise InputError(str(path), f"{len(corners)} corners", f"must be at most {MOST_CORNERS}")
    if not np.isfinite(corners).all() or np.abs(corners).max() > LARGEST_LENGTH:
        raise InputError(str(path), None, f"coordinates must be within {1e3 * LARGEST_LENGTH:g} mm")
    return found if found.geom_type == "Polygon" else areal(found)
