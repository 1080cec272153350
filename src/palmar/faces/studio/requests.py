"""What comes from outside, read strictly: one frame of a socket, one wish for a file."""

from __future__ import annotations

import json
from typing import Annotated, Any, TypeVar

from pydantic import Field, ValidationError

from palmar.errors import InputError
from palmar.faces.studio.kinds import Kind
from palmar.models.explain import explain
from palmar.models.quantity import Value

Model = TypeVar("Model", bound=Value)
LARGEST_MESSAGE = 256 * 1024
"""Bytes; a case file with 2000 vertices has a third of that."""


class Request(Value):
    """One question: ``id`` and ``seq`` come back with every part of the answer."""

    id: Annotated[str, Field(max_length=64)]
    seq: Annotated[int, Field(ge=0, le=2**53, strict=True)]
    kind: Kind
    channel: Annotated[str, Field(max_length=16)] = ""
    case: dict[str, Any] | str | None = None
    parameters: dict[str, Any] = Field(default_factory=dict)

    @property
    def head(self) -> dict[str, Any]:
        """What comes back."""
        return {"id": self.id, "seq": self.seq, "kind": self.kind.value, "channel": self.channel}


class FileRequest(Value):
    """A wish for a file; see ``answers.export`` for what there is."""

    what: Annotated[str, Field(max_length=32)]
    format: Annotated[str, Field(max_length=16)]
    case: dict[str, Any] | str | None = None
    parameters: dict[str, Any] = Field(default_factory=dict)


def read_request(text: str) -> Request:
    """A frame; raises InputError in one line."""
    request = _read(Request, text)
    if request.kind is Kind.EXPORT:
        raise InputError("kind", None, "files come by POST to /export")
    return request


def read_file_request(text: str) -> FileRequest:
    """A body; raises InputError in one line."""
    return _read(FileRequest, text)


def _read(model: type[Model], text: str) -> Model:
    raw = _object(text)
    unknown = raw.keys() - model.model_fields.keys()
    if unknown:
        raise InputError(min(unknown)[:60], None, f"unknown, allowed are {', '.join(model.model_fields)}")
    try:
        return model.model_validate(raw)
    except ValidationError as error:
        raise explain(error, model, raw, "message") from None


def _object(text: str) -> dict[str, Any]:
    try:
        raw = json.loads(text, parse_constant=_refused)
    except (ValueError, RecursionError) as error:
        words = "nested too deep" if isinstance(error, RecursionError) else str(error)
        raise InputError("message", None, f"is not JSON: {words}") from None
    if not isinstance(raw, dict):
        raise InputError("message", None, "must be a JSON object")
    return raw


def _refused(name: str) -> float:
    raise ValueError(f"{name} is no number in JSON")
