"""Cells as points: fields on a box of cells in the form that `contact_solver` requires."""

from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field

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
