"""The motors of the source's test bed in MuJoCo's language, driven by ``bed_servos``, and what its hose does to a puck."""

from __future__ import annotations

from palmar.models.bed import Bed


def bed_motors(bed: Bed, joints: list[str], arm: str) -> str:
    """Actuators in MuJoCo's language, and the coupling of distal joints; ``arm``: what holds the wrist."""
    motors = "".join(f'<motor joint="{each}"/>' for each in joints)
    distal = [each for each in joints if not each.endswith("_1")] if bed.coupled else []
    tied = "".join(f'<joint joint1="{each}" polycoef="0 0 0 0 0"/>' for each in distal)
    return f"<actuator>{motors}{arm}</actuator><equality>{tied}</equality>"


def puck_joints(bed: Bed) -> tuple[str, str]:
    """What the hose does to a free puck's slides, and to its turning."""
    limit = bed.spin_limit
    turn = "" if limit is None else f' limited="true" range="{-limit} {limit}"'
    return f' damping="{bed.hose_drag}"', turn
