"""Unit and meaning of reported values, declared by annotations of the attributes of a class.

Tables, files and JSON Schemas read units and meanings from that class.
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
    """Kind of a reported value, such as scalar, vector or counter.

    The kind determines the value of a load step from the values of its increments: the last value,
    the largest value or the sum.
    """

    SCALAR = "the value at the end of the step"
    VECTOR = "(x, y), the value at the end of the step"
    LARGEST = "the largest value in the step"
    COUNTER = "the sum over the step"
    FIELD = "values on the surface"


@dataclass(frozen=True)
class Reported:
    """Annotation of a reported value, such as the normal force, with its unit and meaning.

    Tables, files and JSON Schemas read the unit and the meaning from this annotation.

    unit      SI unit; empty if dimensionless
    meaning   meaning of the value in a sentence
    kind      rule for the value of a load step from the values of its increments
    key       True for the main results
    physical  True for properties of the contact, which have an error; False for numerical measures
    """

    unit: str
    meaning: str
    kind: Kind = Kind.SCALAR
    key: bool = False
    physical: bool = True

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """Add the unit and the meaning of the reported value to its JSON Schema."""
        return {**handler(schema), "description": self.meaning, "unit": self.unit or "1"}


def reported(record: type) -> Mapping[str, Reported]:
    """Return unit and meaning of the reported values of a class, by attribute name.

    A reported value is an attribute or a property with an annotation `Reported`. Attributes come
    first, then properties; those without such an annotation are left out.

    record  class with annotated attributes, such as the scalars of an increment
    """
    hints = get_type_hints(record, include_extras=True)
    for owner in reversed(record.__mro__):
        for name, member in vars(owner).items():
            if isinstance(member, property):
                of_getter = get_type_hints(member.fget, include_extras=True)
                hints.setdefault(name, of_getter.get("return"))
    return {
        name: annotation
        for name, hint in hints.items()
        for annotation in getattr(hint, "__metadata__", ())
        if isinstance(annotation, Reported)
    }
