"""Marks that give a reported value its unit and its meaning, once: tables, files and schema read
them off the class that declares it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, get_type_hints

CONVENTION = (
    "SI units. x and y lie in the plane of contact, z points into the lower body [body], which "
    "fills z >= 0; the origin is the point of first touch. Tractions act on the lower body: "
    "pressure is positive in compression, so that sigma_zz = -pressure, sigma_xz = -shear_x and "
    "sigma_yz = -shear_y at z = 0. Slip is of the lower body against the indenter since the start "
    "of the history; approach, forces and shifts are of the indenter against the body."
)

OF_THE_INDENTER = (
    "SI units. x and y lie in the plane of contact, z points into the indenter, which fills "
    "z >= 0; the origin is the point of first touch. Tractions act on the indenter: pressure is "
    "positive in compression, so that sigma_zz = -pressure, sigma_xz = -shear_x and "
    "sigma_yz = -shear_y at z = 0."
)


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
