"""Whose turn it is: the client that was served least recently; of each client at most one item a channel, the newest."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from typing import Generic, TypeVar

Item = TypeVar("Item")


class Turns(Generic[Item]):
    """Waiting items; what is put on a channel takes the place of what waits there, without losing the turn."""

    def __init__(self) -> None:
        self._waiting: dict[Hashable, OrderedDict[Hashable, Item]] = {}
        self._served: dict[Hashable, int] = {}
        self._count = 0

    def __len__(self) -> int:
        return sum(len(each) for each in self._waiting.values())

    def __iter__(self) -> Iterator[Item]:
        return (item for each in self._waiting.values() for item in each.values())

    def put(self, client: Hashable, channel: Hashable, item: Item) -> None:
        """Let an item wait."""
        self._waiting.setdefault(client, OrderedDict())[channel] = item

    def take(self, fits: Callable[[Item], bool]) -> Item | None:
        """The item whose turn it is among those that fit; None if there is none."""
        for client in sorted(self._waiting, key=lambda each: self._served.get(each, 0)):
            for channel, item in self._waiting[client].items():
                if fits(item):
                    self.remove(client, channel)
                    self._count += 1
                    self._served[client] = self._count
                    return item
        return None

    def remove(self, client: Hashable, channel: Hashable) -> None:
        """Forget what waits on a channel, if anything does."""
        channels = self._waiting.get(client)
        if channels is not None:
            channels.pop(channel, None)
            if not channels:
                del self._waiting[client]

    def drop(self, client: Hashable) -> None:
        """Forget a client."""
        self._waiting.pop(client, None)
        self._served.pop(client, None)
