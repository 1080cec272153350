"""The cell's camera: renders what it sees, adds the sensor's noise, and finds the cylinder in it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from palmar.models.cell_messages import Sighting
from palmar.models.cell_task import CellTask, TaskKind
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.camera_model import PinholeCamera
from palmar.worlds.cell.cylinder_finder import CylinderFinder, Found, Picture
from palmar.worlds.mujoco.cell.renderer import Renderer
from palmar.worlds.mujoco.cell.scene import cell_xml
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.engine import mujoco

Floats = NDArray[np.float64]
SIZE = (240, 320)
"""Height and width of a frame (px)."""
FACETS, STACKS, SAMPLES = 60, 6, 4
"""Around a round shape: a cylinder of 28, MuJoCo's default, is 0.2 mm thinner than it should be."""
BOB = {TaskKind.TABLE: 0.0, TaskKind.FLOATING: 3e-4, TaskKind.ALIGN: 0.0}
"""How well the height (m) is known: on its thread the cylinder goes up and down a little."""
BANK = 1 << 20
"""So many draws of noise are made once; each frame takes a stretch of them that begins anywhere."""


class RenderedCamera:
    """With a copy of the scene of its own, so that it can work in a process of its own; ``rest`` (nq,): its state as built.

    Where it believes to be is off by ``settings.camera.bias``: its calibration error. Raises NotCoveredError where nothing
    can be rendered, or OpenCV is missing.
    """

    def __init__(self, hand: SalisburyHand, task: CellTask, settings: CellSettings) -> None:
        self._model: Any = mujoco.MjModel.from_xml_string(cell_xml(hand, task))
        self._model.vis.quality.numslices, self._model.vis.quality.numstacks = FACETS, STACKS
        self._model.vis.quality.offsamples = SAMPLES
        self._data: Any = mujoco.MjData(self._model)
        self.rest: Floats = self._data.qpos.copy()
        self._renderer = Renderer(self._model, "eye", SIZE)
        random = np.random.default_rng([settings.seed, 1])
        self._noise = (settings.camera.grain * random.standard_normal(BANK, np.float32)).round().astype(np.int16)
        self._random = random
        low, high = (task.place[2] + sign * 0.5 * task.cylinder.height for sign in (-1.0, 1.0))
        shift = np.array([*settings.camera.bias, 0.0])
        self.true = self._pinhole()
        self.finder = CylinderFinder(self.true.moved(shift, np.zeros(3)), low, high, task.place[:2], BOB[task.kind])

    def _pinhole(self) -> PinholeCamera:
        """The scene's own; MuJoCo's camera looks along its minus z axis, its y up."""
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
        eye = self._model.camera("eye").id
        axes = self._data.cam_xmat[eye].reshape(3, 3) * (1.0, -1.0, -1.0)
        focal = 0.5 * SIZE[0] / np.tan(0.5 * np.radians(self._model.cam_fovy[eye]))
        return PinholeCamera(self._data.cam_xpos[eye].copy(), axes, float(focal), (SIZE[1], SIZE[0]))

    def picture(self, qpos: Floats) -> Picture:
        """RGB (height, width, 3) at joint state ``qpos`` of the scene, with the sensor's noise."""
        self._data.qpos[:] = qpos
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
        mujoco.mj_tendon(self._model, self._data)
        clean = self._renderer.picture(self._data)
        start = int(self._random.integers(BANK - clean.size))
        noise = self._noise[start : start + clean.size].reshape(clean.shape)
        grainy: Picture = np.clip(clean + noise, 0, 255).astype(np.uint8)
        return grainy

    def find(self, qpos: Floats) -> Found | None:
        """What is found in a picture of joint state ``qpos``."""
        return self.finder.find(self.picture(qpos))

    def sight(self, qpos: Floats, stamp_s: float) -> Sighting | None:
        """Of the cylinder at joint state ``qpos``, stamped; None where it is not found."""
        found = self.find(qpos)
        if found is None:
            return None
        body = found.body
        return Sighting(stamp_s, body.x, body.y, body.radius, found.sigma)
