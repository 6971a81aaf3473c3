"""Friction between the two bodies."""

from types import EllipsisType
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Discriminator, Tag, model_validator

from contact_scene.array_file import FileKey
from contact_scene.description import Description
from contact_scene.quantity import FrictionCoefficient
from contact_scene.refusal import refusal

Field = NDArray[np.float64]
Where = tuple[slice, slice] | EllipsisType


class FrictionMap(Description):
    """Coefficients of friction that vary over the surface."""

    map: FileKey
    """A `.npy` file with one coefficient for every cell of the surface, index [i, j] = (x, y)."""

    @model_validator(mode="after")
    def _is_never_negative(self) -> "FrictionMap":
        if np.any(self.map.values < 0.0):
            raise refusal(
                f"the map {self.map} holds {self.map.values.min():.6g}", "coefficients not below 0"
            )
        return self


def _kind(value: Any) -> str:
    return "<mapped>" if isinstance(value, dict | FrictionMap) else "<uniform>"


Coefficient = Annotated[
    Annotated[FrictionCoefficient, Tag("<uniform>")] | Annotated[FrictionMap, Tag("<mapped>")],
    Discriminator(_kind),
]


class CoulombFriction(Description):
    """Coulomb's law: the shear never exceeds coefficient times pressure; slip opposes it."""

    coefficient: Coefficient
    """Coefficient of friction mu >= 0, or a map of it."""

    @property
    def uniform(self) -> float | None:
        """The coefficient where it is the same everywhere; None where it varies."""
        return None if isinstance(self.coefficient, FrictionMap) else self.coefficient

    @property
    def cells(self) -> tuple[int, int] | None:
        """Cells along x and y that have a coefficient of their own; None where it is uniform."""
        return self.coefficient.map.shape if isinstance(self.coefficient, FrictionMap) else None

    @property
    def largest(self) -> float:
        """The largest ratio of shear to pressure anywhere."""
        return float(np.max(self.slope()))

    def slope(self, where: Where = ...) -> float | Field:
        """How fast the limit grows with the pressure [1].

        where  the cells that are asked for; all of them if absent
        """
        if isinstance(self.coefficient, FrictionMap):
            return self.coefficient.map.values[where]
        return self.coefficient

    def limit(self, pressure: Field, where: Where = ...) -> Field:
        """The largest shear under a pressure, of the same shape [force/length^2].

        where  the cells that the pressure is of; all of them if absent
        """
        return np.asarray(self.slope(where) * pressure)

    def carried(self, normal_force: float) -> float | None:
        """The largest tangential force under a normal force [force]; None where it depends on how
        the pressure is spread."""
        return None if self.uniform is None else self.uniform * normal_force


FRICTIONLESS = CoulombFriction(coefficient=0.0)


def sliding_friction(shear: Field, before: Field, after: Field) -> Field:
    """Friction along the way that surfaces slip in an increment, as the shear (c, …)
    [force/length^2]: along the shear at the end, as large as the mean of the limits at both ends.

    Exact where the pressure stays, and where tractions and slip grow in proportion.

    shear          at the end, its components first (c, …)
    before, after  friction limits at start and end (…)
    """
    size = np.abs(np.hypot.reduce(shear, axis=0))
    direction = np.divide(shear, size, out=np.zeros_like(shear), where=size > 0)
    return np.asarray(0.5 * (before + after) * direction)
