"""Whose turn it is: clients in a ring, and of each client at most one waiting item for every channel, the newest."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from typing import Generic, TypeVar

Item = TypeVar("Item")


class Turns(Generic[Item]):
    """Waiting items; what is put on a channel takes the place of what waits there."""

    def __init__(self) -> None:
        self._waiting: OrderedDict[Hashable, OrderedDict[Hashable, Item]] = OrderedDict()

    def __len__(self) -> int:
        return sum(len(each) for each in self._waiting.values())

    def __iter__(self) -> Iterator[Item]:
        return (item for each in self._waiting.values() for item in each.values())

    def put(self, client: Hashable, channel: Hashable, item: Item) -> None:
        """Let an item wait; a newer one keeps the older one's turn."""
        self._waiting.setdefault(client, OrderedDict())[channel] = item

    def take(self, fits: Callable[[Item], bool]) -> Item | None:
        """The item whose turn it is among those that fit; its client goes to the end of the ring."""
        for client, channels in self._waiting.items():
            for channel, item in channels.items():
                if fits(item):
                    self.remove(client, channel)
                    if client in self._waiting:
                        self._waiting.move_to_end(client)
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
        """Forget all that a client waits for."""
        self._waiting.pop(client, None)
