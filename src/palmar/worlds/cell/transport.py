"""The way between the cell's processes: Zenoh, peer to peer over TCP on the loopback, without any scouting.

Every pair that talks is connected for itself: peers do not pass on what is meant for others. What arrives is checked in
the thread of the transport and stamped with the machine's monotonic clock.
"""

from __future__ import annotations

import json
import socket
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from enum import Enum
from queue import Empty, SimpleQueue
from time import monotonic
from typing import Any, Generic, TypeVar

from palmar.errors import NotCoveredError
from palmar.worlds.cell.wire import LARGEST, Message

try:
    import zenoh
except ModuleNotFoundError:
    raise NotCoveredError(
        "the cell in real time needs the package eclipse-zenoh: pip install 'palmar[realtime]'"
    ) from None

LOOPBACK = "127.0.0.1"
RETRY_MS = 50
"""Between two attempts to reach a process that does not listen yet."""
M = TypeVar("M", bound=Message)


class Key(Enum):
    """What is told under which name."""

    LIGHT = "cell/light"
    FRAME = "cell/frame"
    REQUEST = "cell/request"
    REPLY = "cell/reply"
    READY = "cell/ready"


@dataclass(frozen=True)
class Ports:
    """Where plant and controller listen; vision only calls."""

    plant: int
    controller: int


def free_ports() -> Ports:
    """Two ports of the loopback that nobody listened on just now."""
    with ExitStack() as open_until_both_are_known:
        found = []
        for _ in range(2):
            listener = open_until_both_are_known.enter_context(socket.socket())
            listener.bind((LOOPBACK, 0))
            found.append(int(listener.getsockname()[1]))
    return Ports(*found)


def open_session(listen: int | None, connect: Sequence[int] = ()) -> zenoh.Session:
    """A peer that listens on a port of the loopback and calls others until they answer."""
    settings: dict[str, Any] = {
        "mode": "peer",
        "listen/endpoints": [] if listen is None else [f"tcp/{LOOPBACK}:{listen}"],
        "connect/endpoints": [f"tcp/{LOOPBACK}:{port}" for port in connect],
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "connect/retry": {"period_init_ms": RETRY_MS, "period_max_ms": RETRY_MS, "period_increase_factor": 1},
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    config = zenoh.Config()
    for name, value in settings.items():
        config.insert_json5(name, json.dumps(value))
    return zenoh.open(config)


class Sender(Generic[M]):
    """Sends at once and waits for nobody: what cannot go out now is dropped."""

    def __init__(self, session: zenoh.Session, key: Key) -> None:
        self._publisher = session.declare_publisher(
            key.value,
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.REAL_TIME,
            express=True,
        )

    def send(self, message: M) -> None:
        """To everyone who listens."""
        self._publisher.put(message.model_dump_json())


@dataclass
class Mailbox(Generic[M]):
    """Messages of one kind with the time (s, monotonic) at which they arrived; ``malformed`` ones are counted only."""

    model: type[M]
    malformed: int = 0
    _arrived: SimpleQueue[tuple[float, M]] = field(default_factory=SimpleQueue)

    def listen(self, session: zenoh.Session, key: Key) -> Mailbox[M]:
        """From now on."""
        self._subscriber = session.declare_subscriber(key.value, lambda sample: self.put(bytes(sample.payload)))
        return self

    def put(self, payload: bytes) -> None:
        """What came in."""
        arrived = monotonic()
        try:
            if len(payload) > LARGEST:
                raise ValueError("too long")
            self._arrived.put((arrived, self.model.model_validate_json(payload)))
        except ValueError:  # pydantic's ValidationError is one
            self.malformed += 1

    def take(self) -> list[tuple[float, M]]:
        """All that has arrived since, the oldest first."""
        found = []
        while True:
            try:
                found.append(self._arrived.get_nowait())
            except Empty:
                return found

    def wait(self, seconds: float) -> M | None:
        """The newest message, waiting up to so long for one."""
        try:
            newest = self._arrived.get(timeout=seconds)[1]
        except Empty:
            return None
        later = self.take()
        return later[-1][1] if later else newest
