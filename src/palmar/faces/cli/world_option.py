"""The option ``--world``: which physics."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from palmar.worlds.world import WorldMaker

Physics = Annotated[
    Literal["planar", "soft", "mujoco", "bed"],
    Parameter(
        help="The physics: this project's kernels; those with soft contacts of a free disk; or MuJoCo (the extra mujoco),"
        " there also with the test bed's servos."
    ),
]


def maker_of(world: str) -> WorldMaker | None:
    """What makes the world of that name, None for the planar one; raises NotCoveredError where MuJoCo is not installed."""
    if world == "mujoco":
        from palmar.worlds.mujoco.world import mujoco_world

        return mujoco_world
    if world == "bed":
        from palmar.worlds.mujoco.world import bed_world

        return bed_world
    if world == "soft":
        from palmar.worlds.planar.soft import soft_world

        return soft_world
    return None
