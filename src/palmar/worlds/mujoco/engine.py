"""The one place that imports MuJoCo, so that the rest of the package runs without it."""

from __future__ import annotations

from palmar.errors import NotCoveredError

try:
    import mujoco
except ModuleNotFoundError:
    raise NotCoveredError("the world mujoco needs the package mujoco: pip install 'palmar[mujoco]'") from None

__all__ = ["mujoco"]
