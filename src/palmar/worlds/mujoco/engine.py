"""The one place that imports MuJoCo, so that the rest of the package runs without it."""

from __future__ import annotations

import os

from palmar.errors import NotCoveredError

_way = os.environ.get("MUJOCO_GL")
os.environ["MUJOCO_GL"] = (
    "disable"  # or the import fails where a graphics library is missing; ``cell.renderer`` opens it
)
try:
    import mujoco
except ModuleNotFoundError:
    raise NotCoveredError("the world mujoco needs the package mujoco: pip install 'palmar[mujoco]'") from None
finally:
    if _way is None:
        del os.environ["MUJOCO_GL"]
    else:
        os.environ["MUJOCO_GL"] = _way

__all__ = ["mujoco"]
