"""A worker process: jobs come in on its standard input, parts go out on its standard output, one job at a time.

Input: four bytes for a message's length, then its JSON. Output: see ``framing``.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, BinaryIO

from palmar.errors import PalmarError
from palmar.faces.cli.printing import one_line
from palmar.faces.records import finite
from palmar.faces.studio.answering import answered, warm_up
from palmar.faces.studio.answers.part import File, Part
from palmar.faces.studio.compiling import on_compiling
from palmar.faces.studio.framing import LENGTH, Tag, packed
from palmar.faces.studio.kinds import Kind

STACK = 64 * 2**20
"""Bytes for the thread that computes, as much as it takes for deep recursion to end in an error."""

LARGEST = 700.0
"""Megabytes beyond which a worker ends, so that another one begins with little: three times what it has at first."""


class Worker:
    """Computes in one thread and reads ahead in another, to notice that a job is not wanted any more."""

    def __init__(self, source: BinaryIO, sink: BinaryIO) -> None:
        self.source, self.sink, self.stopped = source, sink, -1

    def run(self) -> None:
        """Until the input ends; what is being computed then is of no use to anyone."""
        threading.stack_size(STACK)
        on_compiling(lambda begins: self._send(Tag.COMPILING if begins else Tag.COMPILED))
        with ThreadPoolExecutor(1) as thread:
            thread.submit(warm_up).result()
            self._send(Tag.READY)
            while len(head := self.source.read(LENGTH.size)) == LENGTH.size:
                message = json.loads(self.source.read(*LENGTH.unpack(head)))
                if "stop" in message:
                    self.stopped = max(self.stopped, message["stop"])
                else:
                    thread.submit(self._answer, message).add_done_callback(self._ended)
            os._exit(0)

    def _answer(self, job: dict[str, Any]) -> None:
        """Send every part as soon as it is known."""
        head, began = job["head"], time.perf_counter()
        for each in answered(Kind(head["kind"]), job["step"], job["case"], job["parameters"]):
            if job["job"] <= self.stopped:
                return
            spent, began = 1e3 * (time.perf_counter() - began), time.perf_counter()
            if isinstance(each, File):
                self._send(Tag.FILE, each.name.encode() + b"\n" + each.data)
            else:
                self._send(Tag.PART, each.slot.encode() + b"\n" + _frame(head, each, spent))

    def _ended(self, answer: Future[None]) -> None:
        """Say how it ended; a defect is told too, its trace goes to standard error, and the process goes on."""
        error, leaves = answer.exception(), peak_megabytes() > LARGEST
        if leaves:
            self._send(Tag.LEAVING)
        if error is None:
            self._send(Tag.DONE)
        elif isinstance(error, PalmarError):
            self._send(Tag.ERROR, one_line(str(error)).encode())
        else:
            sys.excepthook(type(error), error, error.__traceback__)
            self._send(Tag.ERROR, f"a defect of palmar: {type(error).__name__}, see where the studio runs".encode())
        if leaves:
            os._exit(0)

    def _send(self, tag: Tag, data: bytes = b"") -> None:
        self.sink.write(packed(tag, data))
        self.sink.flush()


def _frame(head: dict[str, Any], part: Part, spent: float) -> bytes:
    """What the browser gets."""
    guarantee = None if part.guarantee is None else part.guarantee.value
    about = {"part": part.name, "stage": part.stage, "guarantee": guarantee, "last": False, "ms": round(spent, 3)}
    whole = {**head, **about, "value": finite(part.value)}
    return json.dumps(whole, allow_nan=False, separators=(",", ":")).encode()


def peak_megabytes() -> float:
    """The most memory that this process has had at once; 0 where the system does not tell."""
    if sys.platform == "win32":
        return 0.0
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1e6 if sys.platform == "darwin" else 1e3)


def main() -> None:
    """Answer jobs until the input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sink = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # whatever prints must not get between the messages
    Worker(sys.stdin.buffer, sink).run()


if __name__ == "__main__":
    main()
