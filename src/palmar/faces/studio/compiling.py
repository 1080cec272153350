"""Whether kernels are being compiled, which happens once after installation and takes longer than any answer."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from numba.core import event

_numba: Any = event


class _Event(Protocol):
    """What numba tells: one end of one compilation."""

    @property
    def is_start(self) -> bool:
        """Whether it begins."""
        ...


class _Told:
    """Tells when the outermost compilation begins and ends."""

    def __init__(self, tell: Callable[[bool], None]) -> None:
        self.tell, self.depth = tell, 0

    def notify(self, event: _Event) -> None:
        """Count one kernel's begin or end, perhaps within another's."""
        self.depth += 1 if event.is_start else -1
        if self.depth == int(event.is_start):
            self.tell(event.is_start)


_numba.Listener.register(_Told)


def on_compiling(tell: Callable[[bool], None]) -> None:
    """Call ``tell(True)`` when a kernel begins to be compiled and ``tell(False)`` when it is."""
    _numba.register("numba:compile", _Told(tell))
