"""The studio against those who mean no good: bad messages, clients that leave in the middle or never read; memory meanwhile.

    python3 dev.py validate studio_fuzz [--bad 10000]

Starts a server of its own on a free port and prints lines for docs/results/studio.md.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import random
import time
from collections import Counter
from typing import Any

from studio import (
    CASE,
    DRAG_RATE,
    POLYGON,
    TABLE,
    machine,
    memory,
    message,
    paused,
    socket_address,
    studio,
    warmed,
    workers,
)
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

PARAMETERS = ("models", "closure", "start_mm", "theta_deg", "world", "columns", "rows", "x_mm", "uncertainty", "study")
BRIEFS = ("brief", "search", "cases", "seed", "front", "name")


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


def odd_brief(draw: random.Random) -> dict[str, Any]:
    """A brief that may be allowed, with dimensions of any size."""

    def size() -> float:
        return draw.choice([draw.uniform(1.0, 200.0), 10.0 ** draw.uniform(-7.0, 7.0)])

    def span() -> Any:
        low, high = sorted((size(), size()))
        return draw.choice([low, f"{low}..{high}", [low, high]])

    disks = {"radii_mm": span(), "support": draw.choice(["table", "table", "free"])}
    targets = draw.choice([disks, disks, {"vertices_mm": POLYGON["object"]["vertices_mm"]}])
    limits = {
        "palm_width_mm": span(),
        "finger_length_mm": span(),
        "finger_thickness_mm": size(),
        "hand_length_mm": size(),
    }
    return {
        "targets": {
            **targets,
            "friction": draw.choice([0.0, 0.5, "0.1..0.9", 100.0]),
            "error_mm": draw.choice([0.0, size()]),
        },
        "limits": {name: each for name, each in limits.items() if draw.random() < 0.3}
        | {"links": draw.choice([[1], [2, 6]])},
    }


NUMBERS: list[Any] = [
    1e308, -1e308, 10**400, 1e-320, 0, -1, True, None, "x", [], {}, "1..2", "0..1e308", 2**63, "\ud800", [[1, 2]] * 50,
]  # fmt: skip
NOT_JSON = ["[" * 100_000, '{"a":' * 50_000, "NaN", '{"id": Infinity}', "", "\x00", "null", "[]", '"look"', "-"]


def bad_message(draw: random.Random) -> str | bytes:
    """Something that nobody should send."""
    kind = draw.choice(
        ["look", "look", "look", "simulate", "paint", "plan", "design", "brief", "brief_front", "briefs"]
    )
    about = kind.startswith("brief")
    whole = message(draw.randrange(10), odd_brief(draw) if about else odd_case(draw), kind)
    case, parameters = whole["case"], whole["parameters"]
    if about:
        parameters.update(
            brief=whole.pop("case"), **({} if kind == "briefs" else {"cases": 100, "front": draw.randrange(3)})
        )
    section = case[draw.choice(list(case))]
    ways: list[Any] = [
        lambda: section.update({draw.choice([*section, "unknown"]): draw.choice(NUMBERS)}),
        lambda: whole.update({draw.choice([*whole, "unknown"]): draw.choice(NUMBERS)}),
        lambda: parameters.update({draw.choice(BRIEFS if about else PARAMETERS): draw.choice(NUMBERS)}),
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


def main() -> None:
    """All of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bad", type=int, default=10_000)
    given = parser.parse_args()
    print(machine())
    with studio() as (url, pid):
        asyncio.run(warmed(url))
        asyncio.run(deaf(url, pid, 8, 30.0))
        asyncio.run(fuzz(url, pid, given.bad))


if __name__ == "__main__":
    main()
