"""The studio under load: how soon answers come, whether many who drag at once share fairly, memory, and bad messages.

    python3 dev.py validate studio [--seconds 60] [--clients 32] [--bad 10000]

Starts a server of its own on a free port and prints a table for docs/results/studio.md.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import math
import os
import platform
import random
import re
import subprocess
import sys
import time
import urllib.request
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

CASE: dict[str, Any] = {
    "hand": {"palm_width_mm": 120.0, "finger_links_mm": [244.0]},
    "object": {"shape": "disk", "radius_mm": 38.0},
    "contact": {"friction": 0.7},
}
HEXAGON = [[35.0 * math.cos(math.pi * k / 3.0), 35.0 * math.sin(math.pi * k / 3.0)] for k in range(6)]
POLYGON: dict[str, Any] = {**CASE, "object": {"shape": "polygon", "vertices_mm": HEXAGON}}
PARAMETERS = ("models", "closure", "start_mm", "theta_deg", "world", "columns", "rows", "x_mm", "uncertainty", "study")
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


def odd_case(draw: random.Random) -> dict[str, Any]:
    """A case that may be allowed, with dimensions of any size."""

    def size() -> float:
        return draw.choice([draw.uniform(1.0, 300.0), 10.0 ** draw.uniform(-7.0, 7.0)])

    item = draw.choice([{"radius_mm": size()}, {"radius_mm": "1..50"}, dict(POLYGON["object"]), {"radius_mm": 38.0}])
    return {
        "hand": {
            "palm_width_mm": size(),
            "finger_links_mm": [size() for _ in range(draw.choice([1, 1, 2, 3]))],
            "finger_thickness_mm": draw.choice([0.0, 0.0, size()]),
            "fingers": draw.choice(["crossing", "colliding"]),
            "open_deg": draw.choice([0.0, 30.0, 100.0]),
        },
        "object": item,
        "contact": {"friction": draw.choice([0.0, 0.3, 1e3, "0.1..0.9"])},
        "support": {"kind": draw.choice(["table", "table", "free"])},
        "start": {"at_mm": [draw.uniform(-200.0, 200.0), size()]},
        "behaviour": {"name": draw.choice(["close", "close", "close", "curl_and_close", "scoop"])},
    }


NUMBERS: list[Any] = [
    1e308, -1e308, 10**400, 1e-320, 0, -1, True, None, "x", [], {}, "1..2", "0..1e308", 2**63, "\ud800", [[1, 2]] * 50,
]  # fmt: skip
NOT_JSON = ["[" * 100_000, '{"a":' * 50_000, "NaN", '{"id": Infinity}', "", "\x00", "null", "[]", '"look"', "-"]


def bad_message(draw: random.Random) -> str | bytes:
    """Something that nobody should send."""
    kind = draw.choice(["look", "look", "look", "simulate", "paint", "plan", "design"])
    whole = message(draw.randrange(10), odd_case(draw), kind)
    case, parameters = whole["case"], whole["parameters"]
    section = case[draw.choice(list(case))]
    ways: list[Any] = [
        lambda: section.update({draw.choice([*section, "unknown"]): draw.choice(NUMBERS)}),
        lambda: whole.update({draw.choice([*whole, "unknown"]): draw.choice(NUMBERS)}),
        lambda: parameters.update({draw.choice(PARAMETERS): draw.choice(NUMBERS)}),
        lambda: case.update({draw.choice(["hand", "object", "start", "x" * 300]): draw.choice(NUMBERS)}),
        lambda: None,
    ]
    for _ in range(draw.randint(1, 2)):
        draw.choice(ways)()
    text, way = json.dumps(whole), draw.random()
    if way < 0.75:
        return text
    if way < 0.85:
        return draw.choice(NOT_JSON)
    if way < 0.9:
        return draw.randbytes(draw.randrange(200))
    place = draw.randrange(len(text))
    return text[:place] + chr(draw.randrange(1, 0xD7FF)) * draw.randrange(4) + text[place + draw.randrange(5) :]


async def fuzz(url: str, pid: int, count: int) -> None:
    """Bad messages by eight clients, some of which leave at once; good ones must still be answered."""
    told = Counter[str]()
    before, began, at_work = memory(pid), time.perf_counter(), workers(pid)

    async def talk(draw: random.Random, messages: int) -> None:
        async with connect(socket_address(url), max_size=2**26) as socket:
            await socket.recv()
            for _ in range(messages):
                told["sent"] += 1
                await socket.send(bad_message(draw))
                while draw.random() < 0.8:
                    try:
                        answer = json.loads(await asyncio.wait_for(socket.recv(), 2.0))
                    except TimeoutError:
                        break
                    told["answers"] += 1
                    told["errors"] += "error" in answer
                    told["defects"] += "defect" in answer.get("error", "") or "unexpected" in answer.get("error", "")
                    told["over time"] += "took longer" in answer.get("error", "")
                    if answer["last"]:
                        break

    async def send(seed: int) -> None:
        draw = random.Random(seed)
        while told["sent"] < count:
            try:
                await talk(draw, min(count - told["sent"], draw.randrange(1, 100)))
            except ConnectionClosed:
                told["closed"] += 1

    await asyncio.gather(*(send(seed) for seed in range(8)))
    spent = time.perf_counter() - began
    print(
        f"\n{told.pop('sent')} bad messages in {spent:.0f} s: {', '.join(f'{n} {what}' for what, n in told.items())}."
    )
    print(f"\n{TABLE}")
    await paused(url, "after the bad messages", CASE, 10)
    print()
    anew = len(set(workers(pid)) - set(at_work))
    print(f"Workers started anew meanwhile: {anew}. Memory {before:.0f} MB before, {memory(pid):.0f} MB after.")


async def deaf(url: str, pid: int, clients: int, seconds: float) -> None:
    """Some who drag and never read: they are left, and memory does not grow."""
    before, left = memory(pid), 0

    async def drag() -> None:
        nonlocal left
        async with connect(socket_address(url), max_size=2**26, max_queue=1) as socket:
            try:
                for k in range(int(seconds * DRAG_RATE)):
                    await socket.send(json.dumps(message(k, None, "closure_map")))
                    await asyncio.sleep(1.0 / DRAG_RATE)
            except ConnectionClosed:
                left += 1

    await asyncio.gather(*(drag() for _ in range(clients)))
    sizes = f"{before:.0f} MB before, {memory(pid):.0f} MB after"
    print(f"\n{clients} who never read, for {seconds:.0f} s: {left} left by the server; {sizes}.")


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
    parser.add_argument("--bad", type=int, default=10_000)
    given = parser.parse_args()
    load = os.getloadavg()[0]
    print(
        f"{platform.machine()}, {os.cpu_count()} processors, load before {load:.1f}; {time.strftime('%Y-%m-%d %H:%M')}\n"
    )
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
        asyncio.run(deaf(url, pid, 8, 30.0))
        asyncio.run(fuzz(url, pid, given.bad))


if __name__ == "__main__":
    main()
