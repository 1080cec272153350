"""The source's test bed as numbers (section 6.1), and its motors in MuJoCo's language; they are driven by ``bed_servos``."""

from __future__ import annotations

from dataclasses import dataclass

from palmar.errors import InputError


@dataclass(frozen=True)
class Bed:
    """What the source does not print is ours: only ``coupled``, a threshold and a limit of the duty are its own.

    ``counts`` of the encoder in a turn of the joint; ``sample`` (s); torque (N m) at standstill and full duty; rate
    (rad/s) without a load at full duty; ``inertia`` (kg m^2) of a joint; duty per error (1/rad), per its integral
    (1/(rad s)) and per its rate (s/rad); largest duty; duty and time (s) by which a contact is told. ``coupled``: the
    distal joints stay straight by their gear, the hand is 2-jointed. Of a free puck: ``hose_drag``, how its
    air hose slows it (N s/m), and ``spin_limit``, how far (rad) that lets it turn either way; None: without an end.
    """

    counts: int = 40_000
    sample: float = 1e-3
    stall_torque: float = 3.0
    no_load_rate: float = 10.0
    inertia: float = 0.02
    proportional: float = 6.5
    integral: float = 13.0
    derivative: float = 0.4
    duty_limit: float = 0.8
    threshold: float = 0.6
    dwell: float = 0.05
    coupled: bool = True
    hose_drag: float = 0.0
    spin_limit: float | None = None

    def __post_init__(self) -> None:
        if not 0.0 < self.threshold <= self.duty_limit <= 1.0:
            raise InputError(
                "bed",
                f"threshold {self.threshold:g}, duty limit {self.duty_limit:g}",
                "must be in this order in 0 to 1",
            )
        if (
            min(self.counts, self.sample, self.stall_torque, self.no_load_rate, self.inertia) <= 0.0
            or self.hose_drag < 0.0
        ):
            raise InputError(
                "bed",
                None,
                "counts, sample, stall torque, no-load rate and inertia must be positive, drag not negative",
            )


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
