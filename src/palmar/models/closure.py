"""The two ways a closed hand holds a disk."""

from __future__ import annotations

from enum import Enum


class Closure(Enum):
    """Chapter 2; both resist any external force by squeezing, neither resists spin of a frictionless disk."""

    STRUCTURAL = "structural"
    """No friction needed: the fingers press the object onto the palm from beyond its equator (a cage)."""
    FRICTIONAL = "frictional"
    """Contact forces inside the friction cones balance: palm and fingers, or two opposed fingers."""
