"""Cells as points: fields on a box of cells in the form that `contact_solver` requires."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from contact_solver.binned_preconditioner import BinnedPreconditioner
from contact_solver.conjugate_gradients import Map
from contact_solver.zones import Zones
from semi_analytical.operator.operator import ApproximateInverse, DisplacementOperator

Value = TypeVar("Value", np.float64, np.bool_)


def points_of(fields: NDArray[Value]) -> NDArray[Value]:
    """Convert fields on cells (…, nx, ny) to values of points (…, n), row by row."""
    return fields.reshape(*fields.shape[:-2], -1)


def fields_of(values: Field, shape: tuple[int, ...]) -> Field:
    """Convert values of points (…, n), or uniform ones (…, 1), to fields on cells (…, nx, ny).

    Uniform values have the shape (…, 1, 1).

    shape  number of cells nx, ny
    """
    return values.reshape(*values.shape[:-1], *(shape if values.shape[-1] != 1 else (1, 1)))


def map_of_points(
    apply: Callable[[Field], Field], shape: tuple[int, ...]
) -> Callable[[Field], Field]:
    """Convert a map of fields on cells to the same map of values of points.

    apply  map from fields (…, nx, ny) to fields (…, nx, ny)
    shape  number of cells nx, ny
    """
    return lambda values: np.asarray(points_of(apply(values.reshape(*values.shape[:-1], *shape))))


def shear_inverse_in(
    operator: DisplacementOperator, shape: tuple[int, ...], self_compliance: float
) -> Callable[[Zones], Map]:
    """Return the approximate inverse of the shear problem as a function of stick and slip zones.

    operator         displacement operator of the cells; its inverse is built on first use
    shape            number of cells nx, ny
    self_compliance  tangential displacement of a cell by its own unit shear [length^3/force]
    """
    return lambda zones: BinnedPreconditioner(
        zones, map_of_points(operator.shear_inverse, shape), self_compliance
    )


@dataclass(frozen=True)
class InverseOnCells:
    """Approximate inverse of the coupled problem on cells as points.

    inverse          approximate inverse of the displacement operator on fields
    self_compliance  tangential displacement of a cell by its own unit shear [length^3/force]
    shape            number of cells nx, ny
    """

    inverse: ApproximateInverse
    self_compliance: float
    shape: tuple[int, ...]
    exact = False

    def in_zones(self, zones: Zones) -> BinnedPreconditioner:
        """Return the approximate inverse in zones of contact, stick and slip.

        zones  zones of an iterate
        """
        inverse = map_of_points(self.inverse, self.shape)
        return BinnedPreconditioner(zones, inverse, self.self_compliance)

    def with_compliance(self, compliance: float) -> "InverseOnCells":
        """Return the approximate inverse for an additional compliance of each cell.

        compliance  additional displacement of a cell by its own unit traction [length^3/force]
        """
        more = self.self_compliance + compliance
        return replace(self, inverse=self.inverse.with_compliance(compliance), self_compliance=more)
