"""The studio under load: how soon answers come, whether many who drag at once share fairly, and memory.

    python3 dev.py validate studio [--seconds 60] [--clients 32]

Starts a server of its own on a free port and prints a table for docs/results/studio.md.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import math
import os
import platform
import re
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

from websockets.asyncio.client import ClientConnection, connect

CASE: dict[str, Any] = {
    "hand": {"palm_width_mm": 120.0, "finger_links_mm": [244.0]},
    "object": {"shape": "disk", "radius_mm": 38.0},
    "contact": {"friction": 0.7},
}
HEXAGON = [[35.0 * math.cos(math.pi * k / 3.0), 35.0 * math.sin(math.pi * k / 3.0)] for k in range(6)]
POLYGON: dict[str, Any] = {**CASE, "object": {"shape": "polygon", "vertices_mm": HEXAGON}}
TABLE = "| | answers a second | median (ms) | 95th percentile (ms) | most (ms) |\n|---|---|---|---|---|"
DRAG_RATE = 60.0
"""Messages a second of one who drags."""


@contextmanager
def studio() -> Iterator[tuple[str, int]]:
    """Address and process number of a server; at last, how many errors it logged."""
    words = [sys.executable, "-m", "palmar.faces.cli.main", "studio", "--no-browser", "--port", "0"]
    with TemporaryFile("w+") as log, subprocess.Popen(words, stdout=subprocess.PIPE, stderr=log, text=True) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip(), process.pid
        finally:
            process.terminate()
            process.wait()
            log.seek(0)
            told = log.read()
            print(f"\nErrors with a trace in the server's log: {told.count('Traceback')}.")
            print(told[-3000:], file=sys.stderr)


def machine() -> str:
    """Its size, how busy it was, and when."""
    when, load = time.strftime("%Y-%m-%d %H:%M"), os.getloadavg()[0]
    return f"{platform.machine()}, {os.cpu_count()} processors, load before {load:.1f}; {when}\n"


def workers(pid: int) -> list[int]:
    """Process numbers of the workers, as Linux tells."""
    return [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def memory(pid: int) -> float:
    """Resident megabytes of the server and its workers."""
    pages = [int(Path(f"/proc/{each}/statm").read_text().split()[1]) for each in (pid, *workers(pid))]
    return sum(pages) * os.sysconf("SC_PAGE_SIZE") / 1e6


def processor_seconds(*pids: int) -> float:
    """Used by processes so far."""
    words = [Path(f"/proc/{each}/stat").read_text().rpartition(") ")[2].split() for each in pids]
    return sum(int(each[11]) + int(each[12]) for each in words) / os.sysconf("SC_CLK_TCK")


def used(pid: int) -> tuple[float, float, float]:
    """Processor seconds of the server, its workers, and this program."""
    return processor_seconds(pid), processor_seconds(*workers(pid)), time.process_time()


def dragged(case: dict[str, Any], k: int) -> dict[str, Any]:
    """The case with its fingers a little longer or shorter."""
    length = 244.0 + 40.0 * math.sin(0.05 * k)
    return {**case, "hand": {**case["hand"], "finger_links_mm": [length]}}


class Drag:
    """One who drags: sends at a steady rate, notes when the answers to which message came."""

    def __init__(self, url: str, case: dict[str, Any], seconds: float) -> None:
        self.url, self.case, self.seconds = url, case, seconds
        self.sent: dict[int, float] = {}
        self.quick: list[float] = []
        self.settled: list[float] = []
        self.stale = self.size = 0

    async def run(self) -> None:
        """Drag, then wait for the last answer."""
        async with connect(socket_address(self.url), max_size=2**26) as socket:
            await socket.recv()
            reader = asyncio.create_task(self._read(socket))
            began = time.perf_counter()
            for k in range(int(self.seconds * DRAG_RATE)):
                await asyncio.sleep(max(0.0, began + k / DRAG_RATE - time.perf_counter()))
                self.sent[k] = time.perf_counter()
                await socket.send(json.dumps(message(k, dragged(self.case, k))))
            await asyncio.wait_for(reader, 60.0)

    async def _read(self, socket: ClientConnection) -> None:
        while True:
            text = await socket.recv()
            now, answer = time.perf_counter(), json.loads(text)
            self.size += len(text)
            newest, seq = max(self.sent), answer["seq"]
            self.stale += newest - seq > 2 * DRAG_RATE
            if answer.get("part") == "region":
                (self.quick if answer["stage"] == "quick" else self.settled).append(now - self.sent[seq])
            if answer["last"] and seq == int(self.seconds * DRAG_RATE) - 1:
                return


def message(seq: int, case: Any, kind: str = "look") -> dict[str, Any]:
    """One question."""
    return {"id": "load", "seq": seq, "kind": kind, "case": case, "parameters": {}}


def socket_address(url: str) -> str:
    """Of the page's address."""
    return url.replace("http", "ws", 1) + "ws"


def told(name: str, values: list[float], seconds: float) -> str:
    """A row: how many a second, and how late."""
    if not values:
        return f"| {name} | 0 | | | |"
    late = sorted(1e3 * each for each in values)
    median, most = late[len(late) // 2], late[min(int(0.95 * len(late)), len(late) - 1)]
    return f"| {name} | {len(late) / seconds:.1f} | {median:.1f} | {most:.1f} | {late[-1]:.1f} |"


async def one(url: str, pid: int, name: str, case: dict[str, Any], seconds: float) -> str:
    """One client who drags; in a line what it costs."""
    drag, began = Drag(url, case, seconds), used(pid)
    await drag.run()
    server, work, _ = (each - before for each, before in zip(used(pid), began, strict=True))
    print(told(f"one client, {name}: first region", drag.quick, seconds))
    print(told(f"one client, {name}: the command line's region", drag.settled, seconds))
    each = 1e3 / max(len(drag.quick), 1)
    spent = f"{each * server:.1f} ms of the server, {each * work:.1f} ms of its workers"
    return f"Processor time for a first region of {name} and what follows it: {spent}."


async def paused(url: str, name: str, case: dict[str, Any], count: int = 40) -> None:
    """How soon everything is there after a change that is the last."""
    first, last = [], []
    async with connect(socket_address(url), max_size=2**26) as socket:
        await socket.recv()
        for k in range(count):
            began = time.perf_counter()
            await socket.send(json.dumps(message(k, dragged(case, k))))
            while not (answer := json.loads(await socket.recv()))["last"]:
                if answer["part"] == "region":
                    (first if answer["stage"] == "quick" else last).append(time.perf_counter() - began)
    print(told(f"asked one by one, {name}: first region", first, count))
    print(told(f"asked one by one, {name}: the command line's region", last, count))


async def many(url: str, pid: int, clients: int, seconds: float) -> None:
    """Many who drag at once; memory meanwhile."""
    drags = [Drag(url, CASE, seconds) for _ in range(clients)]
    sizes: list[float] = []

    async def watch() -> None:
        while True:
            sizes.append(memory(pid))
            await asyncio.sleep(1.0)

    watcher, began = asyncio.create_task(watch()), used(pid)
    await asyncio.gather(*(each.run() for each in drags))
    watcher.cancel()
    server, work, own = (each - before for each, before in zip(used(pid), began, strict=True))
    rates = sorted(len(each.quick) / seconds for each in drags)
    print(told(f"{clients} clients: first region", [each for drag in drags for each in drag.quick], seconds))
    median = rates[len(rates) // 2]
    print(f"\nFirst regions a second and client: least {rates[0]:.2f}, median {median:.2f}, most {rates[-1]:.2f}.")
    print(f"Answers to a message older than 2 s: {sum(each.stale for each in drags)}.")
    shares = " s, ".join(f"{each / seconds:.2f}" for each in (server, work, own))
    print(f"Processor time a second of the server, its workers, and those who drag: {shares} s.")
    fifth = max(len(sizes) // 5, 1)
    print(f"Memory of server and workers: {sum(sizes[:fifth]) / fifth:.0f} MB in the first fifth of the time, "
          f"{sum(sizes[-fifth:]) / fifth:.0f} MB in the last, {max(sizes):.0f} MB at most.")  # fmt: skip


def first_paint(url: str) -> None:
    """How soon the page's files are there."""
    began = time.perf_counter()
    with urllib.request.urlopen(url) as answer:
        page = answer.read().decode()
    for each in re.findall(r'(?:src|href)="\./?([^"]+)"|(?:src|href)="/([^"]+)"', page):
        with urllib.request.urlopen(url + (each[0] or each[1])) as answer:
            answer.read()
    print(f"\nThe page and its files: {1e3 * (time.perf_counter() - began):.0f} ms.")


async def warmed(url: str) -> None:
    """Wait until the workers are ready and kernels are loaded."""
    for case in (CASE, POLYGON):
        await asyncio.gather(*(Drag(url, case, 0.5).run() for _ in range(4)))


def main() -> None:
    """All of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0, help="of the many")
    parser.add_argument("--clients", type=int, default=32)
    given = parser.parse_args()
    print(machine())
    with studio() as (url, pid):
        first_paint(url)
        asyncio.run(warmed(url))
        print("\n" + TABLE)
        costs = []
        for name, case in (("a disk", CASE), ("a polygon", POLYGON)):
            asyncio.run(paused(url, name, case))
            costs.append(asyncio.run(one(url, pid, name, case, 10.0)))
        print("\n" + "\n".join(costs) + "\n\n" + TABLE)
        asyncio.run(many(url, pid, given.clients, given.seconds))


if __name__ == "__main__":
    main()
