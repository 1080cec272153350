"""One question on its way through the workers, and whoever asked it."""

from __future__ import annotations

import json
from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any, Protocol

from palmar.faces.studio.framing import LENGTH
from palmar.faces.studio.kinds import STEPS, Kind, Step


class Client(Hashable, Protocol):
    """Whoever asks: a browser's socket, or one download."""

    @property
    def reads(self) -> bool:
        """Whether it takes what it is sent; nothing is computed for one that does not."""
        ...

    def part(self, job: Job, slot: str, frame: str) -> None:
        """One part of the answer, for a slot of the page."""
        ...

    def file(self, job: Job, name: str, data: bytes) -> None:
        """The answer, where it is a file."""
        ...

    def ended(self, job: Job, error: str | None) -> None:
        """Nothing more will come."""
        ...


@dataclass(eq=False)
class Job:
    """A question of a client on one of its channels; of ``steps`` the one at ``step`` is waiting or running."""

    client: Client
    kind: Kind
    head: dict[str, Any]
    case: Any
    parameters: dict[str, Any]
    channel: str = ""
    number: int = 0
    """Of the client's questions, in the order in which they came."""
    arrived: float = 0.0
    step: int = 0
    spent: float = 0.0
    superseded: bool = False
    """Something newer was asked: the step that runs is the last, what it finds is still the newest there is."""
    stopped: bool = False
    """Nobody wants what comes of it."""

    @property
    def key(self) -> tuple[Kind, str]:
        """Its channel among all of its client."""
        return self.kind, self.channel

    @property
    def now(self) -> Step:
        """The step that comes next."""
        return STEPS[self.kind][self.step]

    @property
    def is_wanted(self) -> bool:
        """Whether the question still stands."""
        return not (self.superseded or self.stopped)

    @property
    def is_last(self) -> bool:
        """Whether no other step follows."""
        return self.step + 1 == len(STEPS[self.kind])

    def tell_waiting(self, words: str) -> None:
        """Let the client know why nothing comes yet."""
        about = {
            "part": "wait",
            "stage": "quick",
            "guarantee": None,
            "last": False,
            "ms": 0.0,
            "value": {"words": words},
        }
        self.client.part(self, "wait", json.dumps({**self.head, **about}))

    def message(self, number: int) -> bytes:
        """What a worker is told."""
        told = {"job": number, "step": self.step, "head": self.head, "case": self.case, "parameters": self.parameters}
        return framed(told)


def stop_message(number: int) -> bytes:
    """What a worker is told when a job is not wanted any more."""
    return framed({"stop": number})


def framed(message: dict[str, Any]) -> bytes:
    """A message to a worker."""
    data = json.dumps(message).encode()
    return LENGTH.pack(len(data)) + data
