"""The one place that imports MuJoCo, so that the rest of the package runs without it."""

from __future__ import annotations

import os

from palmar.errors import NotCoveredError

try:
    import mujoco
except ModuleNotFoundError:
    raise NotCoveredError("the world mujoco needs the package mujoco: pip install 'palmar[mujoco]'") from None
except (ImportError, AttributeError) as error:  # what its graphics raise where MUJOCO_GL names a way that is not there
    raise NotCoveredError(f"mujoco does not start with MUJOCO_GL={os.environ.get('MUJOCO_GL')}: {error}") from None

__all__ = ["mujoco"]
