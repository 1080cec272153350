"""The options of ``palmar region`` that ask for more than the region, from mm and degrees to SI."""

from __future__ import annotations

from math import pi, radians

from palmar.errors import InputError
from palmar.faces.cli.printing import number, numbers
from palmar.models.case import Case
from palmar.models.quantity import LARGEST_LENGTH
from palmar.regions.region import Model
from palmar.studies.capture import PoseError
from palmar.studies.region_questions import Questions

FINEST = 1e-8
"""Least tolerance in finger lengths."""


def questions(
    error: str | None, correlation: str | None, uncertainty: str | None, at: str | None, ends: bool,
    offset: str | None, velocities: bool,
) -> Questions:  # fmt: skip
    """What the options ask for; raises InputError in one line."""
    errors = None
    if uncertainty is not None:
        from palmar.faces.cli.uncertainty import parse_uncertainty

        errors = parse_uncertainty(uncertainty)
    if correlation is not None and error is None:
        raise InputError("--correlation", None, "needs --error")
    return Questions(
        error=None if error is None else _pose_error(error, correlation),
        uncertainty=errors,
        ends=ends,
        offset=None if offset is None else _offset(offset),
        at=None if at is None else place_given(at),
        velocities=velocities,
    )


def orientations(text: str | None) -> tuple[float, float] | None:
    """Degrees, LOW..HIGH or all -> first and last orientation (rad)."""
    if text is None:
        return None
    if text == "all":
        return 0.0, 2.0 * pi
    low, between, high = text.partition("..")
    first = number(low, "--theta")
    last = number(high, "--theta") if between else first
    if not first <= last <= first + 360.0 or abs(first) > 1e4:
        raise InputError("--theta", repr(text[:60]), "must be DEG, LOW..HIGH with at most 360 between, or all")
    return radians(first), radians(last)


def fineness(text: str | None, case: Case) -> float | None:
    """Tolerance or spacing in mm -> m, within what can be computed and drawn for a hand of this size."""
    if text is None:
        return None
    value, length = 1e-3 * number(text, "--tolerance"), case.hand.finger_length
    if not FINEST * length <= value <= length:
        allowed = f"must be from {1e3 * FINEST * length:.2g} to {1e3 * length:.4g} mm for this hand"
        raise InputError("--tolerance", repr(text[:60]), allowed)
    return value


def models(text: str) -> list[Model]:
    """Two or three different models."""
    names = text.split(",")
    known = [each.value for each in Model]
    if len(names) < 2 or len(set(names)) < len(names) or any(each not in known for each in names):
        raise InputError("--compare", repr(text[:60]), f"must be two or three of {', '.join(known)}, commas between")
    return [Model(each) for each in names]


def _pose_error(text: str, correlation: str | None) -> PoseError:
    values = numbers(text, "--error", (2, 3), "SX_MM,SY_MM[,STHETA_DEG]")
    x, y = _positive(values[:2], "--error")
    turn = values[2] if len(values) == 3 else 0.0
    if not 0.0 <= turn <= 180.0:
        raise InputError("--error", repr(text[:60]), "the angle's standard deviation must be between 0 and 180 deg")
    shared = 0.0 if correlation is None else number(correlation, "--correlation")
    if not abs(shared) <= 0.999999:
        raise InputError("--correlation", repr(str(correlation)[:60]), "must be above -1 and below 1")
    return PoseError((1e-3 * x, 1e-3 * y), shared, radians(turn))


def _offset(text: str) -> float:
    option = "--pressure-offset"
    return 1e-3 * _positive([number(text, option)], option)[0]


def _positive(values: list[float], option: str) -> list[float]:
    if not all(1e-6 <= value <= 1e3 * LARGEST_LENGTH for value in values):
        raise InputError(option, ",".join(f"{each:g}" for each in values), "lengths must be 0.000001 to 1000000 mm")
    return values


def place_given(text: str) -> tuple[float, float]:
    """X_MM,Y_MM -> m."""
    x, y = numbers(text, "--at", (2,), "X_MM,Y_MM")
    return 1e-3 * x, 1e-3 * y
