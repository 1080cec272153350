"""``palmar strategies``: closing strategies of a hand of two joints a finger, by the region each catches from."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from palmar.errors import InputError
from palmar.faces.cli.printing import AsJson, CaseName, Check, answer, progress, show
from palmar.faces.cli.texts import table, titled
from palmar.models.behaviour import BehaviourName
from palmar.models.shipped import open_case

if TYPE_CHECKING:
    from palmar.faces.words import Row
    from palmar.studies.strategies import Strategy

app = App(name="strategies")
ENDINGS = (".svg", ".pdf", ".png")


@app.default
def strategies(
    case: CaseName,
    *,
    out: Annotated[Path | None, Parameter(help="Also draw them: svg, pdf or png.")] = None,
    json: AsJson = False,
    check: Check = False,
) -> None:
    """Straight closing, curling first, and both joints together: areas of their regions, and the winner."""
    from palmar.studies.strategies import strategies as compared
    from palmar.studies.strategies import winner

    if out is not None and out.suffix.lower() not in ENDINGS:
        raise InputError("--out", str(out), "this is drawn as svg, pdf or png")
    name, given = open_case(case)
    found = compared(given, lambda words: progress(f"simulating: {words}"))
    best = winner(found)
    if out is not None:
        from palmar.faces.plots.strategies_picture import strategies_picture
        from palmar.faces.plots.style import save

        save(strategies_picture(given, found), out)
    written = [f"Written: {out}"] if out is not None else []
    show(titled(name, given, _text(found, best), *written), _record(found, best), json)
    answer(best.region.area > 0.0, check)


def _text(found: tuple[Strategy, ...], best: Strategy) -> str:
    straight = found[0].region.area
    rows: list[Row] = [("strategy", "", "area", "of straight closing", "guarantee")]
    for each in found:
        gain = "" if straight == 0.0 else f"{100.0 * each.region.area / straight:.1f} %"
        rows.append((each.name, _value(each), f"{1e4 * each.region.area:.4g} cm2", gain, each.region.guarantee.value))
    verdict = f"The largest region: {best.name}{', ' + _value(best) if best.value is not None else ''}."
    if best.region.area == 0.0:
        verdict = "None of them catches anything."
    return f"{verdict}\n\n{table(rows)}"


def _value(each: Strategy) -> str:
    if each.value is None:
        return ""
    if each.behaviour.name is BehaviourName.CLOSE_COUPLED:
        return f"distal {each.value:.3g} times as fast"
    return f"curled by {degrees(each.value):.3g} deg"


def _record(found: tuple[Strategy, ...], best: Strategy) -> dict[str, Any]:
    return {
        "best": best.name,
        "strategies": [
            {
                "name": each.name,
                "behaviour": each.behaviour.name.value,
                "preshape_rad": each.value if each.behaviour.name is BehaviourName.CURL_AND_CLOSE else None,
                "ratio": each.value if each.behaviour.name is BehaviourName.CLOSE_COUPLED else None,
                "area_m2": each.region.area,
                "guarantee": each.region.guarantee.value,
                "spacing_m": each.region.spacing,
            }
            for each in found
        ],
    }
