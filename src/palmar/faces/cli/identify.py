"""``palmar identify``: friction and pressure from recorded pushes, and how well they predict pushes not looked at."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, number, progress, show
from palmar.faces.cli.push import Radius, Shape, mean_words, of_shape, on_a_table, pusher_radius
from palmar.faces.cli.texts import table, titled
from palmar.models.case import Case
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.faces.push_records import Trial
    from palmar.studies.pushes import RecordedPushes

app = App(name="identify")

UNKNOWN = 100.0
"""A friction or length whose standard error is this many times itself was not determined."""


@app.default
def identify(
    case: CaseName,
    *,
    pushes: Annotated[Path, Parameter(help="A CSV file as for push, with the recorded ends x1_m,y1_m,theta1_rad.")],
    shape: Shape = None,
    share: Annotated[str, Parameter(help="Share of the pushes to fit to.", allow_leading_hyphen=True)] = "0.2",
    seed: Annotated[str, Parameter(help="Which pushes these are.", allow_leading_hyphen=True)] = "0",
    pusher_radius_mm: Radius = "4.75",
    json: AsJson = False,
) -> None:
    """Fit the pusher's friction and the pressure under the object on some pushes, test them on the others."""
    from palmar.faces.push_records import shape_list, trial_record
    from palmar.studies.pushes import read_pushes

    radius, part = pusher_radius(pusher_radius_mm), number(share, "--share")
    if not 0.0 < part < 1.0:
        raise InputError("--share", repr(share), "must lie between 0 and 1, both excluded")
    chosen = number(seed, "--seed")
    if not (chosen.is_integer() and 0.0 <= chosen < 2.0**53):
        raise InputError("--seed", repr(seed[:60]), "must be a whole number, at least 0")
    name, given = open_case(case)
    on_a_table(given)
    recorded = of_shape(read_pushes(pushes), shape)
    if len(set(recorded.shapes)) > 1:
        raise InputError("--shape", None, f"must name one of: {shape_list(recorded.shapes)}")
    trial = _trial(given, radius, recorded, part, int(chosen))
    show(titled(name, given, _text(given, trial)), trial_record(trial), json)


def _trial(case: Case, radius: float, recorded: RecordedPushes, share: float, seed: int) -> Trial:
    from palmar.faces.push_records import Trial
    from palmar.mechanics.pushing.push import Pusher
    from palmar.mechanics.pushing.resting import slider_of
    from palmar.studies.identify import identify as fitted
    from palmar.studies.identify import split
    from palmar.studies.pushes import end_errors, predict

    fit, test = split(len(recorded), share, seed)
    if recorded.ends is not None and not len(test):
        raise InputError("--share", f"{share:g}", f"leaves none of the {len(recorded)} pushes to test on")
    progress(f"fit on {len(fit)} of {len(recorded)} pushes")
    found = fitted(case.object, radius, recorded.rows(fit))
    progress(f"test on the other {len(test)}")
    rest = recorded.rows(test)
    assert rest.ends is not None  # else there was nothing to fit to
    plain = predict(slider_of(case.object, case.support), Pusher(radius, case.contact.friction), rest)
    return Trial(found, end_errors(plain.poses, rest.ends), end_errors(found.predict(rest), rest.ends), share, seed)


def _text(case: Case, trial: Trial) -> str:
    found, offsets = trial.found, trial.found.registration
    pressure = ", ".join(f"{name.replace('_', ' ')} {value:.2f}" for name, value in found.pressure._asdict().items())
    estimates = [
        ("estimated from", f"{found.pushes} pushes, with standard errors"),
        ("friction of the pusher", _with_error(found.friction, found.friction_error, 3)),
        ("largest moment / largest force", f"{_with_error(1e3 * found.length, 1e3 * found.length_error, 1)} mm"),
        *(
            (f"centre of pressure, {axis}", f"{1e3 * value:.1f} +- {1e3 * error:.1f} mm")
            for axis, value, error in zip("xy", found.centre, found.centre_error, strict=True)
        ),
        ("pressure", pressure),
        ("offset of the pusher's path", f"({1e3 * offsets.path[0]:.2f}, {1e3 * offsets.path[1]:.2f}) mm"),
        ("place of the outline in its frame", f"({1e3 * offsets.outline[0]:.2f}, {1e3 * offsets.outline[1]:.2f}) mm, "
         f"{np.degrees(offsets.turn):.2f} deg"),
    ]  # fmt: skip
    errors = [
        ("tested on", f"the other {len(trial.after.position)} pushes"),
        (f"mean error as the case says, friction {case.contact.friction:.3g}", mean_words(trial.before)),
        ("mean error as identified", mean_words(trial.after)),
    ]
    return f"{table(estimates)}\n\n{table(errors)}"


def _with_error(value: float, error: float, digits: int) -> str:
    if not isfinite(error) or error > UNKNOWN * abs(value):
        return f"{value:.{digits}f}, which these pushes do not show"
    return f"{value:.{digits}f} +- {error:.{digits}f}"
