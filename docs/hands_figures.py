"""Picture and table of docs/hands.md: `python docs/hands_figures.py` writes hands.svg beside it and prints the rows."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt

from palmar.faces.plots.bent_picture import draw_stance, stance_extent
from palmar.faces.plots.dimensions import scale_bar
from palmar.faces.plots.sheet import Pad, Room, sheet
from palmar.faces.plots.style import Role
from palmar.faces.plots.style import save as write_picture
from palmar.models.case import Case
from palmar.models.shipped import open_case
from palmar.studies.jointed_closure import coupling_of, jointed_closure, largest_stance

HERE = Path(__file__).resolve().parent
HANDS = {
    "barrett_bh8_282": "Barrett BH8-282",
    "robotiq_2f_85": "Robotiq 2F-85",
    "robotiq_2f_140": "Robotiq 2F-140",
    "robotiq_3_finger": "Robotiq 3-Finger",
    "schunk_sdh_2": "Schunk SDH-2",
    "kinova_kg_3": "Kinova KG-3",
    "openhand_t42": "OpenHand T42",
    "reflex_takktile": "ReFlex TakkTile",
}


def rows(case: Case) -> tuple[str, ...]:
    """Diameters (mm) held without friction and with it, by bent and by straight fingers, and without joint limits."""
    answer = jointed_closure(case)
    free = case.hand.model_copy(update={"joint_limits": None})  # and nothing coupled
    unlimited = largest_stance(free, 0.0)
    assert unlimited is not None
    ranges = (answer.structural, answer.frictional, *answer.straight)
    said = [f"{2e3 * r.radius_min:.0f} to {2e3 * r.radius_max:.0f}" if r else "none" for r in ranges]
    said[2:] = ["coupled"] * 2 if answer.coupled else said[2:]
    return (*said, f"{2e3 * unlimited.radius:.0f}")


def picture() -> None:
    """All hands to one scale, each with the largest disk it holds without friction."""
    cases = {name: open_case(name)[1] for name in HANDS}
    found = {name: case.hand for name, case in cases.items()}
    stances = {name: largest_stance(case.hand, 0.0, coupling_of(case)) for name, case in cases.items()}
    names = list(HANDS)
    layout = [names[:4], names[4:]]
    extents = [[stance_extent(found[name], stances[name]) for name in row] for row in layout]
    page = sheet(extents, room=Room(inside=Pad(2.0, 5.0, 2.0, 8.0)))
    for row, panels in zip(layout, page.panels, strict=True):
        for name, axes in zip(row, panels, strict=True):
            draw_stance(axes, found[name], stances[name], Role.LARGEST)
            box = page.box(axes)
            at = (0.5 * (box.left + box.right), box.top - 3.0)
            page.write(at, HANDS[name], across="center", upright="top", bold=True)
    scale_bar(page.panels[1][0])
    write_picture(page.figure, HERE / "hands.svg")


if __name__ == "__main__":
    plt.switch_backend("svg")
    picture()
    for name, title in HANDS.items():
        print("|", " | ".join((title, *rows(open_case(name)[1]))), "|", flush=True)
