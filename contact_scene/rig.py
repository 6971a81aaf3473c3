"""Series springs of a test rig, between the actuator and the indenter.

The actuator moves by δ* = δ + T/k where the contact shifts by δ under the force T, and likewise
along the normal. A rig is one more elastic body, with the same displacement below every traction:
solvers add the constant 1/k to the compliance of the surfaces and obtain the motions of the
actuator. Results have both motions; energies are those of the bodies.
"""

from dataclasses import replace
from typing import Any, TypeVar, cast

import numpy as np
from pydantic import model_validator

from contact_scene.reading.description import Description
from contact_scene.reading.quantity import PositiveStiffness
from contact_scene.reading.validator_error import refusal

Reported = TypeVar("Reported")
Pair = tuple[float, float]

# Names of the motions of the contact in a result, each with that of the actuator and the force.
MOTIONS = {
    "approach": ("actuator_approach", "normal_force"),
    "tangential_shift": ("actuator_shift", "tangential_force"),
}


class Rig(Description):
    """Springs in series with the contact. A step prescribes forces, or displacements of the
    actuator, which act through the springs."""

    tangential_stiffness: PositiveStiffness | None = None
    """Stiffness k of the spring along the surface, the same in all directions [force/length]:
    tangential_shift of a step is δ* = δ + T/k; absent: rigid. Torque and twist bypass it."""

    normal_stiffness: PositiveStiffness | None = None
    """Stiffness of the spring along the normal [force/length]: approach of a step is that of the
    contact plus W/k; absent: rigid."""

    @model_validator(mode="after")
    def _has_a_spring(self) -> "Rig":
        if self.tangential_stiffness is None and self.normal_stiffness is None:
            raise refusal("the rig has no spring", "tangential_stiffness or normal_stiffness")
        return self


def compliances(rig: Rig | None) -> Pair:
    """Return 1/k along the normal and along the surface, zero of a rigid rig [length/force]."""
    springs = (rig.normal_stiffness, rig.tangential_stiffness) if rig else (None, None)
    down, along = (1 / k if k else 0.0 for k in springs)
    return down, along


def prescribed_motions(rig: Rig | None) -> tuple[str, str]:
    """Return the names of approach and shift as a load step prescribes them."""
    names = zip(compliances(rig), MOTIONS.items(), strict=True)
    approach, shift = (actuator if c else name for c, (name, (actuator, _)) in names)
    return approach, shift


def of_contact(increment: Reported, rig: Rig | None) -> Reported:
    """Return an increment, reported with the motions of the actuator, with those of the contact."""
    values: dict[str, Any] = {}
    for c, (name, (actuator, load)) in zip(compliances(rig), MOTIONS.items(), strict=True):
        moved = getattr(increment, name)
        if c and moved is not None:
            own = np.subtract(moved, np.multiply(c, getattr(increment, load)))
            own = own if isinstance(moved, np.ndarray) else _plain(own)
            values |= {actuator: moved, name: own}
    return cast(Reported, replace(cast(Any, increment), **values)) if values else increment


def _plain(value: Any) -> Any:
    """Numbers of Python: a float, or a tuple of two."""
    return tuple(map(float, value)) if np.ndim(value) else float(value)
