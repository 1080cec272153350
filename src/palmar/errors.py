"""What palmar raises when it cannot do what it was asked: one plain sentence each, fit to show a person."""

from __future__ import annotations


class PalmarError(Exception):
    """Base of every error palmar raises on purpose."""


class InputError(PalmarError):
    """A value from outside is not allowed: says where it stood, what it was, and what is allowed."""

    def __init__(self, where: str, received: str | None, allowed: str) -> None:
        self.where, self.received, self.allowed = where, received, allowed
        super().__init__(f"{where}: {allowed}" if received is None else f"{where} = {received}: {allowed}")

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str | None, str]]:
        """So that it comes back whole from a worker process."""
        return type(self), (self.where, self.received, self.allowed)


class NotCoveredError(PalmarError):
    """The input is valid, but no model in palmar answers this question for it; says which part is not covered."""


class OutputError(PalmarError):
    """A result could not be written; nothing half-written is left behind."""
