"""What only MuJoCo's worlds have of a test bed (chapter 6): its motors, its puck's hose and tilt, its table's stiction."""

from __future__ import annotations

from math import pi
from typing import Annotated, Self

from pydantic import Field, StrictBool, model_validator

from palmar.models.quantity import Real, Unit, Value

Share = Annotated[Real, Field(ge=0.0, le=1.0)]
Positive = Annotated[Real, Field(gt=0.0, le=1e6)]
Gain = Annotated[Real, Field(ge=0.0, le=1e6)]


class Bed(Value):
    """The source prints no numbers: only ``coupled``, a threshold and a limit of the duty are its own, the rest is ours.

    Motors are those of the world ``bed``; hose, spin limit, tilt and stiction are of every MuJoCo world.
    """

    counts: Annotated[Real, Field(ge=4.0, le=1e9)] = 40_000.0
    """Of the encoder in a turn of the joint."""
    sample: Annotated[Real, Field(ge=1e-5, le=1.0), Unit.SECOND] = 1e-3
    """Time between two looks of the servos."""
    stall_torque: Annotated[Positive, Unit.NEWTON_METRE] = 3.0
    """Of a joint at standstill and full duty."""
    no_load_rate: Annotated[Positive, Unit.DEGREE_PER_SECOND] = 10.0
    """Rate (rad/s) of a joint without a load at full duty."""
    joint_inertia: Annotated[Positive, Unit.KILOGRAM_SQUARE_METRE] = 0.02
    proportional: Gain = 6.5
    """Duty per error (1/rad)."""
    integral: Gain = 13.0
    """Duty per integral of the error (1/(rad s))."""
    derivative: Gain = 0.4
    """Duty per rate of the error (s/rad)."""
    duty_limit: Share = 0.8
    threshold: Annotated[Real, Field(gt=0.0, le=1.0)] = 0.6
    """Duty from which a motor tells of a contact ..."""
    dwell: Annotated[Real, Field(ge=0.0, le=10.0), Unit.SECOND] = 0.05
    """... once it has had it for so long."""
    coupled: StrictBool = True
    """Whether the distal joints stay straight by their gear: the hand is 2-jointed."""
    hose_drag: Annotated[Real, Field(ge=0.0, le=1e6), Unit.NEWTON_SECOND_PER_METRE] = 0.0
    """How a free puck's air hose slows it."""
    spin_limit: Annotated[Real | None, Field(gt=0.0, le=200.0 * pi), Unit.DEGREE] = None
    """How far the hose lets a free puck turn either way; absent = without an end."""
    tilt_loss: Share = 0.0
    """Of the speed that an impact gives a free puck: how much it loses at once, its edge striking the table."""
    stiction: Annotated[Real, Field(ge=1.0, le=10.0)] = 1.0
    """A point of the base at rest is held by so many times the friction of one that slides fast."""
    stiction_speed: Annotated[Real, Field(gt=0.0, le=1e3), Unit.MILLIMETRE_PER_SECOND] = 2e-3
    """Speed at which all but 1/e of what is more is gone."""

    @model_validator(mode="after")
    def _threshold_within_the_limit(self) -> Self:
        if self.threshold > self.duty_limit:
            raise ValueError("threshold must not be more than duty_limit")
        return self
