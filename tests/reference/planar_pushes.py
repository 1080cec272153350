"""The recorded planar pushes that palmar is tested against: where they are, their objects, and a peer's errors.

The data are not part of the project. They are looked for in the folder that PALMAR_DATA names, else beside the
checkout.
"""

from __future__ import annotations

import os
from math import cos, pi, sin
from pathlib import Path

from palmar.models.objects import ConvexPolygon, Disk, Object

NAME = "abs_10mm_s.csv"
BESIDE = Path(__file__).parents[2] / ".." / "shared" / "data" / "planar_pushes"
PUSHER_RADIUS = 0.00475


def polygon(*vertices: tuple[float, float]) -> ConvexPolygon:
    return ConvexPolygon(shape="polygon", vertices=vertices)


def rectangle(x: float, y: float) -> ConvexPolygon:
    return polygon((x, y), (-x, y), (-x, -y), (x, -y))


OBJECTS: dict[str, Object] = {
    "ellip1": Disk(radius=0.0525),
    "rect1": rectangle(0.045, 0.045),
    "rect3": rectangle(0.067505, 0.04497),
    "hex": polygon(*((0.0605 * cos(k * pi / 3), 0.0605 * sin(k * pi / 3)) for k in range(6))),
    "tri1": polygon((0.045, 0.045), (-0.0809, 0.045), (0.045, -0.08087)),
}
PEER = {"ellip1": (2.26, 4.95), "rect1": (2.51, 3.69), "rect3": (2.54, 2.75), "hex": (3.13, 4.61), "tri1": (3.26, 3.18)}
"""Mean errors (mm, deg) of the published ellipsoid model, fitted per object on 20 % of its pushes."""


def data_file(folder: str | None = None) -> Path | None:
    """The file of recorded pushes, None where it is not."""
    place = Path(folder or os.environ.get("PALMAR_DATA") or BESIDE)
    for candidate in (place / NAME, place / "planar_pushes" / NAME):
        if candidate.is_file():
            return candidate
    return None
