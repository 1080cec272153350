"""The one place that imports OpenCV, so that the rest of the package runs without it."""

from __future__ import annotations

from palmar.errors import NotCoveredError

try:
    import cv2
except ModuleNotFoundError:
    raise NotCoveredError("the cell's rendered camera needs OpenCV: pip install 'palmar[mujoco]'") from None

__all__ = ["cv2"]
