"""A region as a DXF drawing in millimetres: named layers for the hand, the object and each set."""

from __future__ import annotations

from itertools import accumulate
from math import cos, sin
from pathlib import Path

from ezdxf import units
from ezdxf.document import Drawing
from ezdxf.enums import TextEntityAlignment
from ezdxf.layouts.layout import Modelspace
from shapely import MultiPolygon

from palmar.geometry.planar_set import coordinates
from palmar.models.case import Case
from palmar.models.objects import Disk

_COLOURS = {"PALMAR_HAND": 7, "PALMAR_OBJECT": 30, "PALMAR_CENTRE": 5, "PALMAR_CONTACT": 3, "PALMAR_WHOLE": 8}


def write_dxf(path: Path, case: Case, sets: dict[str, MultiPolygon], *, from_object: bool) -> None:
    """Closed polylines, one layer a set; with them the hand in its open pose, or seen from it the object at the origin."""
    drawing = Drawing.new("R2010")
    drawing.units = units.MM
    for layer, colour in _COLOURS.items():
        drawing.layers.add(layer, color=colour)
    space = drawing.modelspace()
    for name, region in sets.items():
        for polygon in coordinates(region):
            for ring in polygon:
                points = [(1e3 * x, 1e3 * y) for x, y in ring[:-1]]
                space.add_lwpolyline(points, close=True, dxfattribs={"layer": f"PALMAR_{name.upper()}"})
    if from_object:
        _draw_object(space, case)
    else:
        _draw_hand(space, case)
    drawing.saveas(path)


def _draw_hand(space: Modelspace, case: Case) -> None:
    hand = case.hand
    d, length = 1e3 * hand.half_palm, 1e3 * hand.finger_length
    space.add_line((-d, 0.0), (d, 0.0), dxfattribs={"layer": "PALMAR_HAND"})
    for side in (1.0, -1.0):
        x, y = side * d, 0.0
        for link, lean in _links(case):
            tip = (x + side * 1e3 * link * cos(lean), y + 1e3 * link * sin(lean))
            space.add_line((x, y), tip, dxfattribs={"layer": "PALMAR_HAND"})
            x, y = tip
    label = space.add_text("palmar: lengths in mm", height=0.04 * length, dxfattribs={"layer": "PALMAR_HAND"})
    label.set_placement((0.0, -0.1 * length), align=TextEntityAlignment.MIDDLE_CENTER)


def _links(case: Case) -> list[tuple[float, float]]:
    """Length (m) and direction (rad) of each link of the open hand; a straight finger is one."""
    hand, joints = case.hand, case.open_joints
    if not any(joints[1:]):
        return [(hand.finger_length, hand.open)]
    return list(zip(hand.finger_links, accumulate(joints), strict=True))


def _draw_object(space: Modelspace, case: Case) -> None:
    if isinstance(case.object, Disk):
        space.add_circle((0.0, 0.0), 1e3 * case.object.radius, dxfattribs={"layer": "PALMAR_OBJECT"})
    else:
        points = [(1e3 * x, 1e3 * y) for x, y in case.object.vertices]
        space.add_lwpolyline(points, close=True, dxfattribs={"layer": "PALMAR_OBJECT"})
