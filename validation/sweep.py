"""Sweeps put to the test: speed, memory, kill -9 at random instants, and a Dask cluster that loses a worker.

    python3 dev.py validate sweep [PART ...]

Parts: million (the shipped sweep of 10^6 rows), ten (10^7 rows, memory), kill (ten random kills, then compared with an
uninterrupted run), dask (two worker processes on loopback, one killed). All by default, about five minutes.
"""

from __future__ import annotations

import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import duckdb

PALMAR = (sys.executable, "-m", "palmar.faces.cli.main", "sweep")
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
SPEC = """
[sweep]
case = "testbed_table"
samples = {samples}
seed = 1
[vary]
"object.radius_mm" = {{ from = 20.0, to = 59.0, steps = 40 }}
"start.at_mm.0" = {{ uniform = [-300.0, 300.0] }}
"start.at_mm.1" = {{ uniform = [0.0, 300.0] }}
"""


def spec(folder: Path, rows: int) -> Path:
    """A file that asks for so many rows."""
    path = folder / f"rows_{rows}.toml"
    path.write_text(SPEC.format(samples=rows // 40))
    return path


def sweep(path: Path | str, out: Path, *more: str) -> dict[str, float]:
    """Run to the end."""
    done = subprocess.run([*PALMAR, str(path), "--out", str(out), "--json", *more], check=True, stdout=subprocess.PIPE)
    found: dict[str, float] = json.loads(done.stdout)
    return found


def fingerprint(out: Path) -> tuple[int, str]:
    """How many rows, and a digest of all of them in order of the row."""
    query = f"""SELECT count(*), md5(string_agg(md5(CAST(t AS VARCHAR)), '' ORDER BY t.row))
                FROM read_parquet('{out}/shard-*.parquet') t"""
    number, digest = duckdb.sql(query).fetchall()[0]
    return int(number), str(digest)


def resident(pid: int) -> int:
    """Kilobytes of a process and those it has started."""
    total = 0
    for each in [pid, *children(pid)]:
        try:
            found = re.search(r"VmRSS:\s+(\d+)", Path(f"/proc/{each}/status").read_text())
        except OSError:
            continue
        total += int(found[1]) if found else 0
    return total


def children(pid: int) -> list[int]:
    """Processes that it has started."""
    try:
        listed = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return []
    return [each for child in map(int, listed) for each in (child, *children(child))]


def million(folder: Path) -> bool:
    """The shipped sweep, from the command line to the last shard."""
    began = time.perf_counter()
    found = sweep("sweep_table", folder / "million")
    whole = time.perf_counter() - began
    print(
        f"million: {found['rows']} rows, {found['shards']} shards, {found['seconds']:.1f} s, {whole:.1f} s with the start"
    )
    return found["rows"] == 10**6 and whole < 60.0


def ten(folder: Path) -> bool:
    """Memory of all processes while ten million rows are written."""
    out = folder / "ten"
    run = subprocess.Popen([*PALMAR, str(spec(folder, 10**7)), "--out", str(out), "--json"], stdout=subprocess.DEVNULL)
    began, seen = time.perf_counter(), []
    while run.poll() is None:
        seen.append((time.perf_counter() - began, resident(run.pid)))
        time.sleep(0.5)
    took, quarter = time.perf_counter() - began, len(seen) // 4
    early, late = (max(kb for _, kb in part) / 1024 for part in (seen[quarter : 2 * quarter], seen[3 * quarter :]))
    print(f"ten: 10^7 rows in {took:.1f} s; memory {early:.0f} MB in the second quarter, {late:.0f} MB in the last")
    shutil.rmtree(out)
    return run.returncode == 0 and late < 1.15 * early


def shards(out: Path) -> int:
    """How many are there."""
    return len(list(out.glob("shard-*.parquet")))


def kill(folder: Path) -> bool:
    """Ten kills, each at a random instant after a new shard is there, then one run to the end."""
    asked, whole, parts = spec(folder, 4 * 10**6), folder / "whole", folder / "parts"
    took = sweep(asked, whole)["seconds"]
    instants = random.Random(1)
    for k in range(10):
        run = subprocess.Popen(
            [*PALMAR, str(asked), "--out", str(parts)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        before = shards(parts)
        while shards(parts) == before and run.poll() is None:
            time.sleep(0.01)
        time.sleep(instants.uniform(0.0, took / 8.0))
        run.send_signal(signal.SIGKILL)
        run.wait()
        print(f"  kill {k + 1}: {shards(parts)} shards there", flush=True)
    found = sweep(asked, parts)
    same = fingerprint(whole) == fingerprint(parts)
    print(
        f"kill: {fingerprint(parts)[0]} rows after ten kills, {found['found']:.0f} shards kept; the same table: {same}"
    )
    return same


@contextmanager
def cluster(folder: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler on loopback with two worker processes."""
    place, command = folder / "scheduler.json", Path(sys.executable).parent / "dask"
    scheduler = subprocess.Popen(
        [command, "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", place],
        **QUIET,
    )
    while not place.exists() or not place.read_text().strip():
        assert scheduler.poll() is None, "the scheduler does not start"
        time.sleep(0.1)
    address = json.loads(place.read_text())["address"]
    worker = [command, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    workers = [subprocess.Popen(worker, cwd=folder, **QUIET) for _ in range(2)]
    try:
        yield address, workers
    finally:
        for each in (*workers, scheduler):
            each.kill()
            each.wait()


def dask(folder: Path) -> bool:
    """Two workers, one killed when a few shards are there."""
    asked, out, here = spec(folder, 2 * 10**6), folder / "dask", folder / "here"
    sweep(asked, here)
    with cluster(folder) as (address, workers):
        run = subprocess.Popen(
            [*PALMAR, str(asked), "--out", str(out), "--engine", "dask", "--address", address, "--json"],
            stdout=subprocess.PIPE,
        )  # fmt: skip
        while shards(out) < 3 and run.poll() is None:
            time.sleep(0.05)
        workers[0].kill()
        there = shards(out)
        told, _ = run.communicate(timeout=600)
    same = run.returncode == 0 and fingerprint(out) == fingerprint(here)
    print(f"dask: a worker killed after {there} shards; {json.loads(told or b'{}')}; the same rows as locally: {same}")
    return same


PARTS = {"million": million, "ten": ten, "kill": kill, "dask": dask}


def main(words: list[str]) -> int:
    """Status 1 if any part fails."""
    chosen = words or list(PARTS)
    if unknown := [each for each in chosen if each not in PARTS]:
        print(f"sweep: no part {unknown[0]}; one of {', '.join(PARTS)}", file=sys.stderr)
        return 2
    print(f"{os.cpu_count()} processors")
    with tempfile.TemporaryDirectory() as folder:
        good = [PARTS[each](Path(folder)) for each in chosen]
    return int(not all(good))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
