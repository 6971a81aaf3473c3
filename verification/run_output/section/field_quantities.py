"""The fields of an increment on a section: names, units and where they come from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from fem_reference import Increment


@dataclass(frozen=True)
class FieldQuantity:
    """One field; `of` gives (rings,) or (rings, angles), or None where the increment has none."""

    name: str
    unit: str
    meaning: str

    def of(self, increment: Increment) -> Any:
        """Its values."""
        return getattr(increment, self.name)


FIELD_QUANTITIES = (
    FieldQuantity("pressure", "Pa", "normal traction, positive in contact"),
    FieldQuantity("gap", "m", "distance of the deformed surfaces"),
    FieldQuantity("shear_radial", "Pa", "traction on the lower body, outward"),
    FieldQuantity("shear_circumferential", "Pa", "traction on the lower body, around z"),
    FieldQuantity("shear_along_load", "Pa", "traction on the lower body along the load"),
    FieldQuantity("slip_radial", "m", "of the lower body relative to the indenter, outward"),
    FieldQuantity("slip_circumferential", "m", "the same around z"),
    FieldQuantity("slip_along_load", "m", "the same along the load"),
    FieldQuantity("in_stick", "", "whether the ring is in contact and sticks"),
)


@dataclass(frozen=True)
class ScalarQuantity:
    """One number of an increment, or a pair."""

    name: str
    unit: str
    meaning: str
    of: Callable[[Increment], Any]


SCALAR_QUANTITIES = (
    ScalarQuantity("step", "", "loading step, from 1", lambda i: i.step),
    ScalarQuantity("increment", "", "increment within the step, from 1", lambda i: i.index),
    ScalarQuantity("normal_force", "N", "of the indenter on the body", lambda i: i.normal_force),
    ScalarQuantity("approach", "m", "of the bodies since first touch", lambda i: i.approach),
    ScalarQuantity("tangential_force", "N", "(x, y), of the indenter",
                   lambda i: i.tangential_force),
    ScalarQuantity("tangential_shift", "m", "(x, y), of the indenter",
                   lambda i: i.tangential_shift),
    ScalarQuantity("torque", "N m", "about z, of the indenter", lambda i: i.torque),
    ScalarQuantity("twist", "rad", "about z, of the indenter", lambda i: i.twist),
    ScalarQuantity("contact_radius", "m", "where the pressure ends", lambda i: i.contact_radius),
    ScalarQuantity("stick_radius", "m", "where stick ends", lambda i: i.stick_radius),
    ScalarQuantity("peak_pressure", "Pa", "largest pressure of a ring", lambda i: i.peak_pressure),
    ScalarQuantity("dissipated_energy", "J", "by friction, since the start",
                   lambda i: i.dissipated_energy),
    ScalarQuantity("worst_residual", "", "largest dimensionless residual",
                   lambda i: i.residuals.worst),
    ScalarQuantity("iterations", "", "linear systems of the contact solver",
                   lambda i: i.iterations),
)  # fmt: skip
