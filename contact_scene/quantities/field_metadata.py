"""Marks that give a reported value its unit and its meaning, once: tables, files and schema read
them off the class that declares it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, get_type_hints


class Kind(Enum):
    """What a value is, which says how those of a step's increments are taken together."""

    SCALAR = "the value at the end of the step"
    VECTOR = "(x, y), the value at the end of the step"
    LARGEST = "the largest value in the step"
    COUNTER = "the sum over the step"
    FIELD = "values on the surface"


@dataclass(frozen=True)
class Reported:
    """Annotates a value that is reported.

    unit      in SI; empty if dimensionless
    key       whether it is among those that a person looks at first
    physical  whether it belongs to the contact, and has an error; what the numerics did has none
    """

    unit: str
    meaning: str
    kind: Kind = Kind.SCALAR
    key: bool = False
    physical: bool = True

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """The mark as part of a JSON Schema."""
        return {**handler(schema), "description": self.meaning, "unit": self.unit or "1"}


def reported(record: type) -> Mapping[str, Reported]:
    """The marks of a class by name: of annotated attributes, then of annotated properties."""
    hints = get_type_hints(record, include_extras=True)
    for owner in reversed(record.__mro__):
        for name, member in vars(owner).items():
            if isinstance(member, property):
                of_getter = get_type_hints(member.fget, include_extras=True)
                hints.setdefault(name, of_getter.get("return"))
    return {
        name: mark
        for name, hint in hints.items()
        for mark in getattr(hint, "__metadata__", ())
        if isinstance(mark, Reported)
    }
