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

    def part(self, job: Job, frame: str) -> None:
        """One part of the answer."""
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
    arrived: float = 0.0
    step: int = 0
    spent: float = 0.0
    stopped: bool = False

    @property
    def key(self) -> tuple[Kind, str]:
        """Its channel among all of its client."""
        return self.kind, self.channel

    @property
    def now(self) -> Step:
        """The step that comes next."""
        return STEPS[self.kind][self.step]

    @property
    def is_last(self) -> bool:
        """Whether no other step follows."""
        return self.step + 1 == len(STEPS[self.kind])

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
