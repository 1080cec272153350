"""An object as it rests on its table: outline and limit surface from the case."""

from __future__ import annotations

from palmar.errors import InputError
from palmar.geometry.polygon import area_centroid
from palmar.mechanics.pushing.pressure_cells import PRESSURE_EXPONENT
from palmar.mechanics.pushing.slider import Slider, disk_slider, polygon_slider
from palmar.models.objects import Disk, Object
from palmar.models.support import Support


def slider_of(thing: Object, support: Support) -> Slider:
    """The object on its support: pressure as the support says, about the area centroid plus the given offset.

    Raises InputError where no pressure under it has the centre that is given.
    """
    exponent, offset = PRESSURE_EXPONENT[support.pressure], support.pressure_centre
    try:
        if isinstance(thing, Disk):
            return disk_slider(thing.radius, exponent, offset)
        return polygon_slider(thing.vertices, area_centroid(thing.vertices), exponent, offset)
    except ValueError:
        words = f"[{1e3 * offset[0]:g}, {1e3 * offset[1]:g}]"
        raise InputError("support.pressure_centre_mm", words, "must lie well inside the object") from None
