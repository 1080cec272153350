"""``palmar push``: where a round pusher that moves in a straight line leaves the object."""

from __future__ import annotations

import csv
from collections import Counter
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from cyclopts import App, Parameter

from palmar.errors import InputError, NotCoveredError
from palmar.faces.cli.printing import AsJson, CaseName, number, progress, show
from palmar.faces.cli.texts import table, titled
from palmar.faces.exports.whole_file import write_whole
from palmar.models.case import Case
from palmar.models.shipped import open_case
from palmar.models.support import SupportKind

if TYPE_CHECKING:
    from palmar.faces.words import Row
    from palmar.mechanics.pushing.push import Pushed, Pusher
    from palmar.mechanics.pushing.slider import Slider
    from palmar.studies.pushes import EndErrors, RecordedPushes

app = App(name="push")

Radius = Annotated[
    str, Parameter(name="--pusher-radius-mm", help="Radius of the round pusher in mm.", allow_leading_hyphen=True)
]
Shape = Annotated[str | None, Parameter(help="Only the rows with this name in the column shape.")]
CHUNK = 20_000
"""Rows between two lines of progress."""


@app.default
def push(
    case: CaseName,
    *,
    paths: Annotated[
        Path,
        Parameter(
            help="A CSV file: x0_m,y0_m,theta0_rad of the object, tip_x0_m,tip_y0_m,tip_x1_m,tip_y1_m of the pusher."
        ),
    ],
    pusher_radius_mm: Radius,
    shape: Shape = None,
    out: Annotated[Path | None, Parameter(help="Also write a CSV file: the rows with the predicted ends.")] = None,
    json: AsJson = False,
) -> None:
    """Predict the object's pose after each push; with recorded ends in the file, also how far off the prediction is."""
    from palmar.faces.push_records import push_record
    from palmar.mechanics.pushing.push import Pusher
    from palmar.mechanics.pushing.resting import slider_of
    from palmar.studies.pushes import end_errors, read_pushes

    if out is not None and out.suffix.lower() != ".csv":
        raise InputError("--out", str(out), "the name must end in .csv")
    radius = pusher_radius(pusher_radius_mm)
    name, given = open_case(case)
    on_a_table(given)
    recorded = of_shape(read_pushes(paths), shape)
    pushed = _predicted(slider_of(given.object, given.support), Pusher(radius, given.contact.friction), recorded)
    errors = None if recorded.ends is None or not len(recorded) else end_errors(pushed.poses, recorded.ends)
    if out is not None:
        text = _csv(recorded, pushed)
        write_whole(out, lambda partial: _write_text(partial, text))
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, given, _text(pushed, errors), *written), push_record(pushed, errors), json)


def pusher_radius(text: str) -> float:
    """The radius (m) from the command line."""
    value = number(text, "--pusher-radius-mm")
    if not 0.0 < value <= 1e6:
        raise InputError("--pusher-radius-mm", repr(text), "must be greater than 0 and at most 1000000 mm")
    return 1e-3 * value


def on_a_table(case: Case) -> None:
    """Raise NotCoveredError unless the case has its object on a table, in plain numbers."""
    if case.support.kind is not SupportKind.TABLE:
        raise NotCoveredError('support.kind = "free": pushes are for objects on a table')
    if case.ranges:
        raise NotCoveredError("pushes take plain numbers, not ranges")


def of_shape(recorded: RecordedPushes, shape: str | None) -> RecordedPushes:
    """The pushes of one shape, all of them for None; raises InputError for a shape that the file does not hold."""
    from palmar.faces.push_records import shape_list

    if shape is None:
        return recorded
    if shape not in recorded.shapes:
        raise InputError("--shape", repr(shape[:60]), f"the file holds: {shape_list(recorded.shapes)}")
    return recorded.of(shape)


def _predicted(slider: Slider, pusher: Pusher, recorded: RecordedPushes) -> Pushed:
    """All rows, with progress where there are many; rows are independent."""
    from palmar.mechanics.pushing.push import Pushed
    from palmar.studies.pushes import predict

    parts = []
    for first in range(0, len(recorded), CHUNK):
        if len(recorded) > CHUNK:
            progress(f"push {first + 1} of {len(recorded)}")
        parts.append(predict(slider, pusher, recorded.rows(np.arange(first, min(first + CHUNK, len(recorded))))))
    if not parts:
        return Pushed(np.empty((0, 3)), (), np.empty(0, dtype=np.bool_))
    outcomes = tuple(each for part in parts for each in part.outcomes)
    return Pushed(
        np.concatenate([each.poses for each in parts]), outcomes, np.concatenate([each.ambiguous for each in parts])
    )


def _text(pushed: Pushed, errors: EndErrors | None) -> str:
    counts = Counter(each.name.lower() for each in pushed.outcomes)
    rows: list[Row] = [("pushes", str(len(pushed.poses))), *((name, str(count)) for name, count in counts.items())]
    if pushed.ambiguous.any():
        rows.append(("where Coulomb's law admits several motions", str(int(pushed.ambiguous.sum()))))
    return table([*rows, *(() if errors is None else [("mean error of the recorded ends", mean_words(errors))])])


def mean_words(errors: EndErrors) -> str:
    """Mean errors of position and angle."""
    return f"{1e3 * errors.position.mean():.2f} mm, {np.degrees(errors.angle.mean()):.2f} deg"


def _csv(recorded: RecordedPushes, pushed: Pushed) -> str:
    from palmar.studies.pushes import AFTER, BEFORE, PATH

    numbers = np.hstack((recorded.starts, recorded.paths, pushed.poses)).tolist()
    named = any(recorded.shapes)
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow([*(["shape"] if named else []), *BEFORE, *PATH, *AFTER])
    rows.writerows([*([shape] if named else []), *row] for shape, row in zip(recorded.shapes, numbers, strict=True))
    return text.getvalue()


def _write_text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
