"""``palmar sweep``: one case made millions, on this machine or a cluster, and questions to what came of it."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import App, Parameter

from palmar.errors import InputError, NotCoveredError
from palmar.faces.cli.device_option import Processor, device_of
from palmar.faces.cli.pool import counting
from palmar.faces.cli.printing import AsJson, show
from palmar.faces.cli.texts import table

if TYPE_CHECKING:
    from palmar.models.sweep import Sweep
    from palmar.studies.sweep.run import Engine
    from palmar.studies.sweep.store import Store

app = App(name="sweep")
Folder = Annotated[str, Parameter(help="A folder, or an address such as s3://bucket/folder.")]
MOST_SHOWN = 50
"""Rows of an answer that are printed for people."""


@app.default
def sweep(
    spec: Annotated[str, Parameter(help="A specification (TOML), or the name of a shipped one: sweep_table.")],
    *,
    out: Folder,
    engine: Annotated[Literal["local", "dask"], Parameter(help="Processes here, or a Dask cluster.")] = "local",
    address: Annotated[str | None, Parameter(help="Of the Dask scheduler, tcp://HOST:PORT.")] = None,
    workers: Annotated[int | None, Parameter(help="Processes here, else one for each processor.")] = None,
    device: Processor = "cpu",
    json: AsJson = False,
) -> None:
    """Answer every row into Parquet files; the same command goes on where an interrupted one stopped."""
    from palmar.models.sweep_file import open_sweep

    asked = _on_device(open_sweep(spec), device, engine)
    store, run_sweep = _store(out), _parts().run_sweep
    with _engine(engine, address, workers) as chosen, counting(asked.rows, "rows") as report:
        done = run_sweep(asked, store, chosen, report)
    resumed = [("found already there", f"{done.found} shards")] if done.found else []
    text = table([("rows", str(done.rows)), ("shards", str(done.shards)), *resumed, ("seconds", f"{done.seconds:.2f}")])
    record = {"rows": done.rows, "seconds": done.seconds, "shards": done.shards, "found": done.found, "out": out}
    show(f"{asked.command.value}, into {out}\n\n{text}", record, json)


@app.command
def status(folder: Folder, *, json: AsJson = False) -> None:
    """How much of a sweep is there."""
    store = _store(folder)
    from palmar.studies.sweep.query import status as status_of

    found = status_of(store)
    whole = found.manifest
    rows = [
        ("command", whole.command),
        ("rows", f"{found.rows} of {whole.rows}"),
        ("shards", f"{found.shards} of {whole.shards}"),
        ("specification", whole.digest[:16]),
    ]
    record = {
        "command": whole.command, "rows": found.rows, "rows_in_all": whole.rows, "shards": found.shards,
        "shards_in_all": whole.shards, "complete": found.complete, "digest": whole.digest,
    }  # fmt: skip
    show(table(rows), record, json)


@app.command
def query(
    folder: Folder,
    *,
    sql: Annotated[str, Parameter(help="A SELECT; the table is called sweep, and its columns are in double quotes.")],
    json: AsJson = False,
) -> None:
    """Ask the rows in SQL."""
    store = _store(folder)
    from palmar.studies.sweep.query import query as ask

    found = ask(store, sql)
    shown = [tuple(_word(each) for each in row) for row in found.rows[:MOST_SHOWN]]
    more = len(found.rows) - len(shown)
    text = table([found.columns, *shown]) + (f"\nand {more} more: --json has them" if more else "")
    show(text, {"columns": found.columns, "rows": found.rows}, json)


@app.command
def plot(
    folder: Folder,
    *,
    by: Annotated[str, Parameter(help="KEY or KEY,KEY: what the mean is taken by.")],
    value: Annotated[str, Parameter(help="The column that is averaged.")] = "caught",
    bins: Annotated[int, Parameter(help="Of a drawn number.")] = 60,
    out: Annotated[Path, Parameter(help="svg, pdf or png.")],
    json: AsJson = False,
) -> None:
    """Draw the mean of a column, over one number as a line or over two as a map."""
    if not 2 <= bins <= 1000:
        raise InputError("--bins", str(bins), "must be 2 to 1000")
    keys = by.split(",")
    if len(keys) > 2:
        raise InputError("--by", repr(by[:60]), "must be KEY or KEY,KEY")
    store = _store(folder)
    from palmar.faces.plots.sweep_plot import draw_sweep
    from palmar.studies.sweep.query import mean_by

    found = mean_by(store, value, keys, bins)
    draw_sweep(out, value, keys, found.rows)
    show(f"{out}: {len(found.rows)} points", {"out": str(out), "columns": found.columns, "rows": found.rows}, json)


def _parts() -> Any:
    try:
        from palmar.studies.sweep import run
    except ImportError as error:
        raise NotCoveredError(
            f'sweep: needs the extra, pip install "palmar[sweep]" ({error.name} is missing)'
        ) from None
    return run


def _store(url: str) -> Store:
    _parts()
    from palmar.studies.sweep.store import Store

    return Store(url)


def _on_device(asked: Sweep, device: str, engine: str) -> Sweep:
    from palmar.models.sweep import SweepCommand

    if device == "cpu":
        return asked
    if asked.command is not SweepCommand.SIMULATE or engine != "local":
        raise InputError("--device", device, "is for the command simulate and --engine local")
    return replace(asked, device=device_of(device))


def _engine(name: str, address: str | None, workers: int | None) -> AbstractContextManager[Engine]:
    if name == "dask":
        if address is None or workers is not None:
            raise InputError("--engine", "dask", "takes --address tcp://HOST:PORT, and no --workers")
        from palmar.studies.sweep.on_dask import dask_engine

        return dask_engine(address)
    if address is not None:
        raise InputError("--address", repr(address[:60]), "is for --engine dask")
    if workers is not None and not 1 <= workers <= 1024:
        raise InputError("--workers", str(workers), "must be 1 to 1024")
    from palmar.studies.sweep.local import local_engine

    return local_engine(workers)


def _word(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
