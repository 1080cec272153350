"""Questions to the rows of a sweep, in SQL: the table is called ``sweep``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import duckdb

from palmar.errors import InputError
from palmar.studies.sweep.store import Manifest, Store


@dataclass(frozen=True)
class Found:
    """Names of the columns, and rows."""

    columns: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]


@dataclass(frozen=True)
class Status:
    """What a folder is for, and how much of it is there."""

    manifest: Manifest
    shards: int
    rows: int

    @property
    def complete(self) -> bool:
        """Whether nothing is missing."""
        return self.shards == self.manifest.shards


def status(store: Store) -> Status:
    """Of a sweep's folder; raises InputError where there is none."""
    manifest = store.manifest()
    if manifest is None:
        raise InputError(store.url[:200], None, "holds no sweep")
    there = store.done()
    return Status(manifest, len(there), sum(last - first for first, last in map(manifest.stretch, there)))


def query(store: Store, sql: str, parameters: Sequence[Any] = ()) -> Found:
    """Rows that a SELECT over ``sweep`` finds; raises InputError with what DuckDB says of it."""
    if status(store).shards == 0:
        raise InputError(store.url[:200], None, "holds no rows yet")
    with duckdb.connect() as database:
        if not store.local:
            database.register_filesystem(store.system)
        try:
            database.execute(f"CREATE VIEW sweep AS SELECT * FROM read_parquet({store.shards!r})")
            asked = database.execute(sql, list(parameters))
            columns = tuple(each[0] for each in asked.description or ())
            return Found(columns, tuple(tuple(row) for row in asked.fetchall()))
        except duckdb.Error as error:
            raise InputError("--sql", None, str(error).splitlines()[0]) from None


def mean_by(store: Store, value: str, keys: Sequence[str], bins: int) -> Found:
    """Mean of a column and how many rows it has, by one or two numbers, sorted; a drawn number is cut into bins.

    ``caught`` and other truths are averaged as shares.
    """
    known = query(store, "SELECT * FROM sweep LIMIT 0").columns
    for name in (value, *keys):
        if name not in known:
            raise InputError(
                "--value" if name == value else "--by", repr(name[:60]), f"must be one of {', '.join(known)}"
            )
    parts = []
    for key in keys:
        low, high, different = query(
            store, f"SELECT min({_quoted(key)}), max({_quoted(key)}), approx_count_distinct({_quoted(key)}) FROM sweep"
        ).rows[0]
        if different <= bins:
            parts.append(_quoted(key))
            continue
        width = (high - low) / bins or 1.0
        cell = f"least(floor(({_quoted(key)} - {low!r}) / {width!r}), {bins - 1})"
        parts.append(f"{low!r} + ({cell} + 0.5) * {width!r}")
    listed = ", ".join(f"{part} AS k{i}" for i, part in enumerate(parts))
    names = ", ".join(f"k{i}" for i in range(len(parts)))
    mean = f"avg(CAST({_quoted(value)} AS DOUBLE))"
    sql = (
        f"SELECT {listed}, {mean} AS mean, count({_quoted(value)}) AS rows FROM sweep GROUP BY {names} ORDER BY {names}"
    )
    return query(store, sql)


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'
