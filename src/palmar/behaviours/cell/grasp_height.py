"""How high the fingertips may close on a standing cylinder, and whether they may come down on its rim, so that it stays up.

A tip that pushes at a height z slides the cylinder for certain, whatever its friction does up or down, if
z <= R (1/mu_t - mu) (``mechanics.pushing.cylinder_toppling``). The tips keep clear of the table, the palm stays on or over
the top. A tip that misses the top by little, its centre between ``rim_bands().topples`` and R + r_t from the axis, topples
the cylinder as it comes down: feeling for it is allowed only where that band is negligible.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from palmar.behaviours.cell.tip_circle import closing_curls, tips_at
from palmar.mechanics.pushing.cylinder_toppling import push_heights, rim_bands
from palmar.models.cell_task import Cylinder
from palmar.models.salisbury_hand import SalisburyHand

BACK_OFF = 0.002
"""How far (m) the palm draws back from the top to close."""
OVER_TABLE = 0.003
"""Least room (m) between tips and table."""
BAND = 0.001
"""Width (m) of a band on the rim that is neglected: what the place of the hand is uncertain by."""


@dataclass(frozen=True)
class GraspHeights:
    """Heights (m) over the table: of the palm as it closes, from ``lowest`` to ``highest``; of the tips' pushes then.

    ``by_palm``: whether the palm can be lowered until it touches the top; if not, the table is too near.
    ``pushes``: lowest and highest of the tips' centres with the palm at ``lowest``; ``bound``: up to where a push slides
    the cylinder for certain; ``rim``: width (m) of the band in which a tip that comes down on the rim topples it.
    """

    lowest: float
    highest: float
    by_palm: bool
    pushes: tuple[float, float]
    bound: float
    rim: float

    @property
    def refusal(self) -> str | None:
        """Why no height is allowed, None if one is."""
        if self.lowest <= self.highest:
            return None
        return (
            f"closed as low as they can, the tips push {1e3 * self.pushes[1]:.0f} mm over the table; the cylinder slides for"
            f" certain, and does not topple, only below {1e3 * self.bound:.0f} mm"
        )

    @property
    def may_feel(self) -> bool:
        """Whether tips may come down on the top to feel where it is."""
        return self.rim <= BAND


@lru_cache
def grasp_heights(hand: SalisburyHand, cylinder: Cylinder) -> GraspHeights:
    """For a hand that comes down along the axis of a cylinder that stands on a table."""
    radius, tip = cylinder.radius, hand.tip_radius
    deep = tips_at(hand, closing_curls(hand, radius + tip))[..., 2]
    deepest, least = float(deep.max()), float(deep.min())
    bound = push_heights(radius, cylinder.friction_table, cylinder.friction_hand).surely
    on_top, on_table = cylinder.height + BACK_OFF, OVER_TABLE + tip + deepest
    lowest = max(on_top, on_table)
    highest = min(bound, cylinder.height - tip) + least
    bands = rim_bands(radius, cylinder.height, tip, (cylinder.friction_hand, cylinder.friction_table))
    rim = max(radius + tip - bands.topples, 0.0)
    return GraspHeights(lowest, highest, on_table <= on_top, (lowest - deepest, lowest - least), bound, rim)
