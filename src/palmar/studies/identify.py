"""Friction of the pusher and pressure under the object, estimated from recorded pushes.

The pressure is a PressureShape with five numbers (exponent, tilt, stretch, skew). They and the friction are fitted by
robust least squares (soft L1) to the recorded ends. The residuals of a push are its two errors of position, and its
error of angle times the characteristic length, all over one scale that is estimated from a first round. A weak
Gaussian prior keeps numbers that the pushes do not show near those of uniform pressure. Uncertainty: the sandwich covariance
at the optimum, pushes taken as independent.

Before the fit, offsets between the instruments are taken out by ``register`` (unless told otherwise).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import OptimizeResult, least_squares

from palmar.errors import InputError
from palmar.geometry.polygon import area_centroid
from palmar.mechanics.pushing.pressure_cells import PressureShape, disk_cells, polygon_cells, shaped
from palmar.mechanics.pushing.push import Pusher, push
from palmar.mechanics.pushing.resting import slider_of
from palmar.mechanics.pushing.slider import Slider, pressed_slider
from palmar.models.objects import Disk, Object
from palmar.models.support import Support
from palmar.studies.pushes import RecordedPushes, wrapped
from palmar.studies.registration import Registration, register

Floats = NDArray[np.float64]
NAMES = ("friction", "log_power", "tilt_x", "tilt_y", "stretch", "skew")
"""log_power = log((exponent + 2) / 2), so that any value gives a pressure."""
PRIOR = np.array([0.0, 1.0, 0.5, 0.5, 0.5, 0.5])
"""One over the prior's standard deviations; friction has none."""
STEPS = np.array([0.01, 0.05, 0.05, 0.05, 0.05, 0.05])
FRICTION_START, LARGEST_FRICTION = 0.2, 2.0
FIRST_SCALE, FINE = 2e-3, 1e-6
FEWEST_PUSHES = 12
RINGS, AROUND = 6, 24


@dataclass(frozen=True)
class Identified:
    """Estimates with standard errors; ``covariance`` is of the fitted numbers ``NAMES``.

    ``length`` is the largest moment over the largest friction force (m), ``centre`` the centre of pressure in the
    outline's frame (m), see Registration; their errors follow from the covariance to first order.
    """

    friction: float
    friction_error: float
    length: float
    length_error: float
    centre: tuple[float, float]
    centre_error: tuple[float, float]
    pressure: PressureShape
    covariance: Floats
    scale: float
    pushes: int
    registration: Registration
    slider: Slider
    pusher: Pusher

    def predict(self, recorded: RecordedPushes) -> Floats:
        """End poses (N, 3) of the object's frame, offsets between the instruments included."""
        starts, paths = self.registration.apply(recorded.starts, recorded.paths)
        return self.registration.back(push(self.slider, self.pusher, starts, paths, FINE).poses)


def split(count: int, share: float, seed: int) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """Row numbers to fit on and row numbers to test on, drawn without regard to anything but the seed."""
    order = np.random.default_rng(seed).permutation(count)
    cut = round(share * count)
    return np.sort(order[:cut]), np.sort(order[cut:])


def identify(thing: Object, pusher_radius: float, recorded: RecordedPushes, *, registered: bool = True) -> Identified:
    """Fit to all the pushes given, which must have recorded ends.

    Raises InputError if there are too few, or if none of them moves the object.
    """
    if recorded.ends is None or len(recorded) < FEWEST_PUSHES:
        received = "none" if recorded.ends is None else str(len(recorded))
        raise InputError(
            "recorded ends of pushes", received, f"at least {FEWEST_PUSHES} are needed to identify anything"
        )
    plain = slider_of(thing, Support())
    offsets = register(plain, pusher_radius, recorded.starts, recorded.paths) if registered else Registration()
    fit = _Fit(thing, pusher_radius, recorded, offsets, plain.surface.length)
    start = np.zeros(len(NAMES))
    start[0] = FRICTION_START
    if float(np.abs(fit.poses(start) - recorded.starts).max()) < FINE:
        raise InputError("recorded pushes", None, "none moves the object, so they show neither friction nor pressure")
    rough = fit.solve(start, FIRST_SCALE)
    scale = max(float(np.median(np.abs(fit.residuals(rough.x)))) / 0.6745, FINE)
    return fit.report(fit.solve(rough.x, scale).x, scale)


@dataclass(frozen=True)
class _Fit:
    thing: Object
    pusher_radius: float
    recorded: RecordedPushes
    offsets: Registration
    length: float

    def solve(self, start: Floats, scale: float) -> OptimizeResult:
        low, high = np.full(len(NAMES), -20.0), np.full(len(NAMES), 20.0)
        low[0], high[0] = 0.0, LARGEST_FRICTION

        def misfit(numbers: Floats) -> Floats:
            return np.append(self.residuals(numbers) / scale, numbers * PRIOR)

        def slopes(numbers: Floats) -> Floats:
            return np.vstack((self.derivatives(numbers) / scale, np.diag(PRIOR)))

        bounds, loss = (low, high), cast(Any, _loss)  # the stubs expect a loss without derivatives
        return least_squares(
            misfit, start, slopes, bounds, loss=loss, x_scale=10.0 * STEPS, xtol=1e-4, ftol=1e-5, max_nfev=30
        )

    def slider(self, numbers: Floats) -> Slider:
        shape = _shape(numbers)
        if isinstance(self.thing, Disk):
            core, rounding, about = np.zeros((1, 2)), self.thing.radius, (0.0, 0.0)
            cells = disk_cells(rounding, shape.exponent, RINGS, AROUND)
        else:
            core, rounding, about = np.array(self.thing.vertices), 0.0, area_centroid(self.thing.vertices)
            cells = polygon_cells(core, shape.exponent, RINGS, AROUND, about)
        return pressed_slider(core, rounding, shaped(cells, shape, 1.5 * self.length), about)

    def poses(self, numbers: Floats) -> Floats:
        """End poses (N, 3) of the object's frame."""
        starts, paths = self.offsets.apply(self.recorded.starts, self.recorded.paths)
        pusher = Pusher(self.pusher_radius, float(numbers[0]))
        return self.offsets.back(push(self.slider(numbers), pusher, starts, paths, FINE).poses)

    def residuals(self, numbers: Floats) -> Floats:
        """(2 N + N,) in m: errors of position, then of angle times the characteristic length."""
        assert self.recorded.ends is not None
        apart = self.poses(numbers) - self.recorded.ends
        return np.concatenate((apart[:, 0], apart[:, 1], self.length * wrapped(apart[:, 2])))

    def derivatives(self, numbers: Floats) -> Floats:
        """Central differences; the friction's lower neighbour stays at 0 or above."""
        columns = []
        for k, step in enumerate(STEPS):
            up, down = numbers.copy(), numbers.copy()
            up[k] += step
            down[k] = max(down[k] - step, 0.0) if k == 0 else down[k] - step
            columns.append((self.residuals(up) - self.residuals(down)) / (up[k] - down[k]))
        return np.stack(columns, axis=1)

    def report(self, numbers: Floats, scale: float) -> Identified:
        slider, covariance = self.slider(numbers), self.covariance(numbers, scale)
        turns = np.array([self._derived(numbers, k) for k in range(len(NAMES))])
        errors = np.sqrt(np.einsum("ki,kl,li->i", turns, covariance, turns))
        return Identified(
            float(numbers[0]), float(np.sqrt(covariance[0, 0])), slider.surface.length, float(errors[0]),
            slider.centre, (float(errors[1]), float(errors[2])), _shape(numbers), covariance, scale,
            len(self.recorded), self.offsets, slider, Pusher(self.pusher_radius, float(numbers[0])),
        )  # fmt: skip

    def _derived(self, numbers: Floats, k: int) -> Floats:
        """Derivative of (length, centre x, centre y) by one number."""
        values = []
        for sign in (1.0, -1.0):
            moved = numbers.copy()
            moved[k] += sign * STEPS[k]
            slider = self.slider(moved)
            values.append(np.array([slider.surface.length, *slider.centre]))
        slope: Floats = (values[0] - values[1]) / (2.0 * STEPS[k])
        return slope

    def covariance(self, numbers: Floats, scale: float) -> Floats:
        """Sandwich: inverse curvature times the scatter of the pushes' gradients times inverse curvature."""
        residuals, slopes = self.residuals(numbers) / scale, self.derivatives(numbers) / scale
        weights = 1.0 / np.sqrt(1.0 + residuals**2)  # of the soft L1 loss
        curvature = (slopes * (weights**3)[:, None]).T @ slopes + np.diag(PRIOR**2)
        pulls = (slopes * (weights * residuals)[:, None]).reshape(3, len(self.recorded), len(NAMES)).sum(axis=0)
        inverse = np.linalg.inv(curvature)
        spread: Floats = inverse @ (pulls.T @ pulls + np.diag(PRIOR**2)) @ inverse
        return spread


def _loss(squares: Floats) -> Floats:
    """Soft L1 of the squared residuals, with its derivatives; the prior's squares, which come last, as they are."""
    root = np.sqrt(1.0 + squares)
    values = np.stack((2.0 * (root - 1.0), 1.0 / root, -0.5 / root**3))
    prior = slice(len(squares) - len(NAMES), None)
    values[0, prior], values[1, prior], values[2, prior] = squares[prior], 1.0, 0.0
    return values


def _shape(numbers: Floats) -> PressureShape:
    return PressureShape(2.0 * exp(numbers[1]) - 2.0, *(float(value) for value in numbers[2:]))
