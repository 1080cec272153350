"""Every figure of the source's chapters that palmar redraws, by its number."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from matplotlib.figure import Figure

from palmar.faces.plots.source_chapter_2 import (
    fingertip_geometry,
    force_closure,
    frictional_closure,
    model_of_hand_and_object,
    smallest_and_largest,
    structural_closure,
)
from palmar.faces.plots.source_chapter_3 import pre_image, spiral_coordinates
from palmar.faces.plots.source_chapter_4 import zero_gravity_pre_image
from palmar.faces.plots.source_chapter_5 import all_cases, case_1, case_2, case_3, case_4, optimal_hands
from palmar.faces.plots.source_polygons import any_orientation, particular_orientations
from palmar.faces.plots.style import save

FIGURES: dict[str, Callable[[], Figure]] = {
    "2.1": model_of_hand_and_object,
    "2.2": force_closure,
    "2.3": structural_closure,
    "2.4": frictional_closure,
    "2.5": smallest_and_largest,
    "2.6": fingertip_geometry,
    "2.7": any_orientation,
    "2.8": particular_orientations,
    "3.2": pre_image,
    "3.3": spiral_coordinates,
    "4.4": zero_gravity_pre_image,
    "5.3": case_1,
    "5.4": case_2,
    "5.5": case_3,
    "5.6": case_4,
    "5.7": all_cases,
    "5.8": optimal_hands,
}


def write_source_figures(
    folder: Path, suffixes: Iterable[str] = ("svg",), progress: Callable[[str], None] | None = None
) -> list[Path]:
    """Write ``figure_N_M.SUFFIX`` for every figure into an existing folder, announcing each; the paths in order.

    Raises OutputError where a file cannot be written.
    """
    written = []
    for number, draw in FIGURES.items():
        if progress is not None:
            progress(f"figure {number}")
        figure = draw()
        for suffix in suffixes:
            path = folder / f"figure_{number.replace('.', '_')}.{suffix.removeprefix('.')}"
            save(figure, path)
            written.append(path)
    return written
