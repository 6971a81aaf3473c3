"""Series springs of a test rig, between the actuator and the indenter.

The displacement of the actuator is δ* = δ + T/k, with the tangential shift δ of the contact under
the tangential force T and the stiffness k. In the normal direction, approach and normal
force replace δ and T. A rig is an additional elastic body with a uniform displacement: solvers add
the constant 1/k to the compliance of the surfaces and obtain the displacements of the actuator.
Results contain the displacements of actuator and contact; energies exclude the springs.
"""

from dataclasses import replace
from typing import Any, TypeVar, cast

import numpy as np
from pydantic import model_validator

from contact_scene.reading.description import Description
from contact_scene.reading.quantity import PositiveStiffness
from contact_scene.reading.scene_error import refusal

Reported = TypeVar("Reported")
Pair = tuple[float, float]

# Names of the displacements of the contact in a result, each with the names of the displacement of
# the actuator and of the force.
MOTIONS = {
    "approach": ("actuator_approach", "normal_force"),
    "tangential_shift": ("actuator_shift", "tangential_force"),
}


class Rig(Description):
    """Springs in series with the contact. A load step prescribes forces, or displacements of the
    actuator, which act through the springs."""

    tangential_stiffness: PositiveStiffness | None = None
    """Stiffness k of the spring along the surface, equal in all directions [force/length]; absent:
    rigid. The tangential_shift of a step is δ* = δ + T/k. Torque and twist bypass the spring."""

    normal_stiffness: PositiveStiffness | None = None
    """Stiffness k of the spring along the normal [force/length]; absent: rigid. The approach of a
    step is that of the contact plus W/k."""

    @model_validator(mode="after")
    def _has_a_spring(self) -> "Rig":
        if self.tangential_stiffness is None and self.normal_stiffness is None:
            raise refusal("the rig has no spring", "tangential_stiffness or normal_stiffness")
        return self


def compliances(rig: Rig | None) -> Pair:
    """Return the compliances 1/k of the springs of a test rig, of stiffness k [length/force].

    The springs are between the actuator and the indenter.

    rig      springs of the test rig, or None
    returns  compliance along the normal and along the surface; 0 for a rigid direction or without a
             rig
    """
    springs = (rig.normal_stiffness, rig.tangential_stiffness) if rig else (None, None)
    down, along = (1 / k if k else 0.0 for k in springs)
    return down, along


def prescribed_motions(rig: Rig | None) -> tuple[str, str]:
    """Return the names of the displacements in a result that load steps prescribe.

    With a spring between actuator and indenter, a load step prescribes the displacement of the
    actuator ("actuator_approach"), else the displacement of the contact ("approach").

    rig      springs of the test rig, or None
    returns  name of the approach, name of the tangential shift
    """
    names = zip(compliances(rig), MOTIONS.items(), strict=True)
    approach, shift = (actuator if c else name for c, (name, (actuator, _)) in names)
    return approach, shift


def add_contact_displacements(increment: Reported, rig: Rig | None) -> Reported:
    """Add the displacements of the contact to an increment solved with springs of a test rig.

    Such a solve yields the displacements of the actuator. The displacement of the contact is
    smaller by the force times the compliance of the spring. Without springs the increment is
    unchanged.

    increment  results with the displacements of the actuator
    rig        springs of the test rig, or None
    """
    values: dict[str, Any] = {}
    for c, (name, (actuator, load)) in zip(compliances(rig), MOTIONS.items(), strict=True):
        moved = getattr(increment, name)
        if c and moved is not None:
            own = np.subtract(moved, np.multiply(c, getattr(increment, load)))
            own = own if isinstance(moved, np.ndarray) else plain(own)
            values |= {actuator: moved, name: own}
    return cast(Reported, replace(cast(Any, increment), **values)) if values else increment


def plain(value: Any) -> Any:
    """Convert a number or a vector of numpy to a Python float or to a tuple of floats.

    Used for displacements and energies of a result.

    value  number, or array (n,)
    """
    return tuple(map(float, value)) if np.ndim(value) else float(value)
