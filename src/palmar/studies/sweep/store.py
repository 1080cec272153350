"""Where a sweep's rows are kept: a folder, local or of any file system that fsspec knows, of shards whole or not there.

A shard is written under another name, flushed to the disk, and renamed. Beside them lies the specification with its digest.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import fsspec
import pyarrow as pa
import pyarrow.parquet as parquet
from fsspec.implementations.local import LocalFileSystem

from palmar.errors import InputError, OutputError

MANIFEST, LOCK, UNFINISHED = "sweep.json", ".lock", ".unfinished-"


@dataclass(frozen=True)
class Manifest:
    """Of a folder: digest of the specification, rows in all and in each shard, and the command."""

    digest: str
    rows: int
    shard_rows: int
    command: str

    @property
    def shards(self) -> int:
        """How many there are when all is done."""
        return -(-self.rows // self.shard_rows)

    def stretch(self, shard: int) -> tuple[int, int]:
        """First row of a shard, and the one after its last."""
        return shard * self.shard_rows, min((shard + 1) * self.shard_rows, self.rows)


@dataclass(frozen=True)
class Store:
    """``url``: a folder's path, or an address like s3://bucket/folder."""

    url: str

    @cached_property
    def _place(self) -> tuple[Any, str]:
        try:
            system, path = fsspec.core.url_to_fs(self.url)
        except (ImportError, ValueError) as error:
            raise InputError("--out", repr(self.url[:80]), f"is no folder this machine can write to: {error}") from None
        return system, path.rstrip("/")

    @property
    def local(self) -> bool:
        """Whether it is a folder of this machine's file system."""
        return isinstance(self.system, LocalFileSystem)

    @property
    def system(self) -> Any:
        """The file system."""
        return self._place[0]

    @property
    def shards(self) -> str:
        """Pattern that all shards' paths match, as DuckDB reads it."""
        pattern = self.path("shard-*.parquet")
        return pattern if self.local else str(self.system.unstrip_protocol(pattern))

    def path(self, name: str) -> str:
        """Of a file in the folder."""
        return f"{self._place[1]}/{name}"

    def manifest(self) -> Manifest | None:
        """What the folder holds; None if it holds no sweep."""
        system = self.system
        if not system.exists(self.path(MANIFEST)):
            return None
        try:
            return Manifest(**json.loads(system.cat_file(self.path(MANIFEST))))
        except (ValueError, TypeError):
            raise InputError(self.path(MANIFEST), None, "is not what a sweep writes") from None

    def begin(self, manifest: Manifest) -> None:
        """Make the folder and say what it is for."""
        system, path = self._place
        try:
            system.makedirs(path, exist_ok=True)
        except OSError as error:
            raise OutputError(f"{path}: {error.strerror or error}") from None
        self._write(MANIFEST, json.dumps(vars(manifest)).encode())

    def done(self) -> set[int]:
        """Numbers of the shards that are there."""
        system, path = self._place
        system.invalidate_cache(path)
        names = (str(each).rsplit("/", 1)[-1] for each in system.ls(path, detail=False))
        return {int(each[6:-8]) for each in names if each.startswith("shard-") and each.endswith(".parquet")}

    def sweep_up(self) -> None:
        """Remove what an interrupted run has left half-written."""
        system, path = self._place
        for each in system.ls(path, detail=False):
            if str(each).rsplit("/", 1)[-1].startswith(UNFINISHED):
                system.rm_file(each)

    def write(self, shard: int, table: pa.Table) -> None:
        """Write a shard; afterwards it is whole, or not there."""
        sink = io.BytesIO()
        parquet.write_table(table, sink, compression="zstd")
        self._write(f"shard-{shard:08d}.parquet", sink.getvalue())

    def _write(self, name: str, data: bytes) -> None:
        system, unfinished = self.system, self.path(f"{UNFINISHED}{os.getpid()}-{name}")
        try:
            with system.open(unfinished, "wb") as file:
                file.write(data)
                if self.local:
                    file.flush()
                    os.fsync(file.fileno())
            if self.local:
                Path(unfinished).replace(self.path(name))
            else:
                system.mv(unfinished, self.path(name))
        except OSError as error:
            with contextlib.suppress(OSError):
                system.rm_file(unfinished)
            raise OutputError(f"{self.path(name)}: cannot be written: {error.strerror or error}") from None

    @contextlib.contextmanager
    def alone(self) -> Iterator[None]:
        """Keep other runs of this machine out of a local folder; raises InputError if one is at work in it."""
        if not self.local:
            yield
            return
        import fcntl

        with Path(self.path(LOCK)).open("wb") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                raise InputError("--out", repr(self.url[:80]), "another run is writing to this folder") from None
            yield
