"""What an answer is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeVar

from pydantic import ValidationError

from palmar.errors import InputError
from palmar.models.case import Case
from palmar.models.explain import explain
from palmar.models.guarantee import Guarantee
from palmar.models.quantity import Value

Stage = Literal["quick", "settled"]
Parameters = TypeVar("Parameters", bound=Value)


@dataclass(frozen=True)
class Part:
    """A piece that the page shows as soon as it comes; a later one for the same slot takes its place."""

    name: str
    value: dict[str, Any]
    stage: Stage = "settled"
    guarantee: Guarantee | None = None

    @property
    def slot(self) -> str:
        """Its name, and the model where there may be several."""
        return f"{self.name} {self.value.get('model', '')}"


@dataclass(frozen=True)
class File:
    """A file that the browser saves under that name."""

    name: str
    data: bytes


@dataclass(frozen=True)
class Question:
    """A case, None where none was sent, and the parameters as they came."""

    case: Case | None
    given: dict[str, Any]

    @property
    def required_case(self) -> Case:
        """The case; raises InputError where none was sent."""
        if self.case is None:
            raise InputError("case", None, "is missing")
        return self.case

    def parameters(self, model: type[Parameters]) -> Parameters:
        """The parameters as a model; raises InputError in one line."""
        return read_parameters(model, self.given)


def read_parameters(model: type[Parameters], given: dict[str, Any]) -> Parameters:
    """Parameters as a model; raises InputError in one line."""
    unknown = given.keys() - model.model_fields.keys()
    if unknown:
        name = str(min(unknown))[:60]
        raise InputError(f"parameters.{name}", None, f"unknown, allowed are {', '.join(model.model_fields) or 'none'}")
    try:
        return model.model_validate(given)
    except ValidationError as error:
        raise explain(error, model, given, "parameters") from None
