"""``palmar testbed report``: the measurements of chapter 6, repeated on one page."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from palmar.faces.cli.pool import counting, processes
from palmar.faces.cli.printing import AsJson, progress, show
from palmar.faces.cli.texts import table
from palmar.models.shipped import open_case

CASE = "testbed_table"
Bed = Annotated[
    str, Parameter(help="A case file (TOML), or the name of a shipped case: its hand, disk, friction and [bed].")
]


def report(
    case: Bed = CASE,
    *,
    out: Annotated[Path, Parameter(help="Folder for the page; made if it does not exist.")],
    json: AsJson = False,
) -> None:
    """Limits on the table and in free space and the preshape that circles, against what the source printed; minutes."""
    from palmar.faces.cli.world_option import maker_of
    from palmar.faces.exports.whole_file import make_folder, write_whole
    from palmar.faces.pages.bed_page import bed_page, effects_table, limits_table, meanings_table, preshapes_table
    from palmar.studies.bed_report import ANGLES, FREE_ANGLES, Worlds, bed_report

    ideal, bed = maker_of("mujoco"), maker_of("bed")
    assert ideal is not None and bed is not None
    _, given = open_case(case)
    path = make_folder(out) / "testbed.html"
    with processes() as pool, counting(1, "rows") as count:

        def tell(done: int, whole: int, what: str) -> None:
            count(done, whole)
            if what:
                progress(what)

        found = bed_report(given, Worlds(ideal, bed), pool, tell)
    page = bed_page(found)
    write_whole(path, lambda partial: _write(partial, page))
    tables = (
        limits_table(found.table, ANGLES), limits_table(found.free, FREE_ANGLES), effects_table(found),
        meanings_table(found), preshapes_table(found),
    )  # fmt: skip
    parts = [table([heads, *cells]) for heads, cells in tables if cells]
    record = {"page": str(path), "angles_rad": list(ANGLES), "free_angles_rad": list(FREE_ANGLES), **asdict(found)}
    show("\n\n".join([*parts, f"Page: {path}"]), record, json)


def _write(path: Path, page: str) -> None:
    path.write_text(page, encoding="utf-8")
