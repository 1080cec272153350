"""The outline against brute force: the hull of both rims, and finite differences."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from palmar.worlds.cell.camera_model import looking
from palmar.worlds.cell.upright_outline import Upright, off_outline, outline

BODY = Upright(0.48, 0.02, 0.03, -0.30, -0.17)
CENTRE = np.array([0.48, 0.0, -0.235])
PLACES = {
    "from above": (0.50, 0.60, 0.10),
    "level, between the rims": (1.10, 0.20, -0.22),
    "from below": (0.20, -0.50, -0.60),
    "from near": (0.48, 0.15, -0.10),
}


def seen_from(place):
    return looking(np.array(place), CENTRE, 40.0, (320, 240))


@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
def test_the_outline_is_the_hull_of_both_rims(place):
    camera = seen_from(place)
    angles = np.linspace(0.0, 2.0 * np.pi, 4000, endpoint=False)
    rim = np.stack([BODY.x + BODY.radius * np.cos(angles), BODY.y + BODY.radius * np.sin(angles)], axis=1)
    rims = np.concatenate([np.c_[rim, np.full(len(rim), height)] for height in (BODY.low, BODY.high)])
    hull = ConvexHull(camera.pixels(rims))
    line = outline(camera, BODY, 1.0)
    inside = hull.equations[:, :2] @ line.pixels.T + hull.equations[:, 2:]
    assert np.abs(inside.max(axis=0)).max() < 0.02
    around = np.linalg.norm(np.diff(line.pixels, axis=0, append=line.pixels[:1]), axis=1)
    assert around.sum() == pytest.approx(hull.area, rel=0.01)  # the area of a plane hull is its perimeter
    assert around.max() < 2.5
    assert set(line.pieces) == {0, 1, 2, 3}


@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
def test_points_of_the_outline_move_as_foretold(place):
    camera, small = seen_from(place), 1e-6
    line = outline(camera, BODY, 3.0)
    off, _ = off_outline(camera, BODY, line.pixels)
    assert np.abs(off).max() < 1e-9
    for k, name in enumerate(("x", "y", "radius")):
        moved = replace(BODY, **{name: getattr(BODY, name) + small})
        far, _ = off_outline(camera, moved, line.pixels + small * line.moves[:, k, None] * line.out)
        corners = np.abs(np.diff(line.pieces, append=line.pieces[0], prepend=line.pieces[-1]))
        away = (corners[1:] == 0) & (corners[:-1] == 0)
        slope = np.abs(off_outline(camera, BODY, line.pixels + line.out)[0])
        assert np.abs(far / slope)[away].max() < 0.02 * small * np.abs(line.moves).max()
