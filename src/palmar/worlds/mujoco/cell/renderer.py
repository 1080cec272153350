"""Pictures of a cell, rendered off the screen: through EGL, by software where there is no graphics card.

``MUJOCO_GL`` may be osmesa, or switch rendering off; whatever else it is, EGL is used, which needs no screen.
"""

from __future__ import annotations

import os
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.errors import NotCoveredError
from palmar.worlds.mujoco.engine import mujoco

Picture = NDArray[np.uint8]
MOST_SHAPES = 200
OFF = ("disable", "disabled", "off", "false", "0")
"""Values of MUJOCO_GL with which MuJoCo renders nothing."""
HELP = "Debian's packages libegl1, libgl1 and libgl1-mesa-dri allow it"


@cache
def surface() -> Any:
    """What all renderers of a process draw on, for each draws into a buffer of its own; raises NotCoveredError.

    With one for each, what a renderer gives back when it is gone would be taken from another that is current by then.
    """
    asked = os.environ.get("MUJOCO_GL", "").lower().strip()
    if asked in OFF:
        raise NotCoveredError(f"nothing can be rendered: MUJOCO_GL={asked} forbids it")
    way = "osmesa" if asked == "osmesa" else "egl"
    try:
        return import_module(f"mujoco.{way}").GLContext(1, 1)
    except (ImportError, AttributeError, RuntimeError) as error:  # no library, none of its functions, no device
        raise NotCoveredError(f"nothing can be rendered off the screen here ({way}: {error}); {HELP}") from None


class Renderer:
    """Of one model through one of its cameras, in pictures of one size (height, width).

    Raises NotCoveredError where nothing can be rendered.
    """

    def __init__(self, model: Any, camera: str, size: tuple[int, int]) -> None:
        height, width = size
        model.vis.global_.offwidth, model.vis.global_.offheight = width, height
        model.vis.quality.shadowsize = 0  # nothing casts one, and its map takes 64 MB
        surface().make_current()
        try:
            self._drawer: Any = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        except mujoco.FatalError as error:
            raise NotCoveredError(f"nothing can be rendered: MuJoCo says {error}; {HELP}") from None
        self._model, self._scene = model, mujoco.MjvScene(model, MOST_SHAPES)
        self._options, self._view = mujoco.MjvOption(), mujoco.MjvCamera()
        self._view.type, self._view.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, model.camera(camera).id
        self._frame, self._pixels = mujoco.MjrRect(0, 0, width, height), np.empty((height, width, 3), np.uint8)

    def picture(self, data: Any) -> Picture:
        """Of a state whose kinematics are up to date: RGB (height, width, 3), its first row the uppermost."""
        surface().make_current()
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._drawer)
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, data, self._options, None, self._view, everything, self._scene)
        mujoco.mjr_render(self._frame, self._scene, self._drawer)
        mujoco.mjr_readPixels(self._pixels, None, self._frame, self._drawer)
        return self._pixels[::-1].copy()
