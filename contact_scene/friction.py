"""Coulomb's law of friction with a uniform coefficient or a map of coefficients."""

from dataclasses import replace
from functools import cached_property
from math import ceil
from types import EllipsisType
from typing import Annotated, Any

import numpy as np
from pydantic import Discriminator, Tag, model_validator

from contact_scene.array_types import Field
from contact_scene.height_map import PairOfSpacings, interpolate_between
from contact_scene.reading.array_file import (
    FileKey,
    refuse_missing,
)
from contact_scene.reading.description import Description
from contact_scene.reading.quantity import (
    FrictionCoefficient,
    Length,
)
from contact_scene.reading.scene_error import refusal

Pair = tuple[float, float]
Where = tuple[slice, slice] | EllipsisType

# Relative difference of coefficients that is due to round-off.
ROUND_OFF = 1e-14
# Above every pressure of a contact: a limit with the same slope here and at 0 is proportional to p.
HIGHEST_PRESSURE = 1e30  # [force/length^2]
# Number of angles of the mean of a map over a circle. The mean has no error by harmonics below it.
ANGLES = 64


class FrictionMap(Description):
    """Coefficient of friction that varies over the surface."""

    map: FileKey
    """Name of a `.npy` file with coefficients, index [i, j] = (x_i, y_j), or of a `.csv` or `.txt`
    file in the orientation of a top view; interpolated linearly."""

    spacing: PairOfSpacings
    """Distance between adjacent coefficients along x and y [length]; one number applies to both. A
    map of 128 coefficients over 1.28 mm has a spacing of 0.01 mm."""

    origin: tuple[Length, Length] = (0.0, 0.0)
    """Position (x, y) of the centre of the map, relative to the origin of the contact [length]."""

    @model_validator(mode="after")
    def _is_never_negative(self) -> "FrictionMap":
        refuse_missing(self.map)
        if np.any(self.map.values < 0.0):
            raise refusal(
                f"the map {self.map} holds {self.map.values.min():.6g}", "coefficients not below 0"
            )
        if min(self.extent) <= 0.0:
            raise refusal(
                f"the map {self.map} does not reach the origin of the contact",
                "an origin nearer to it",
            )
        return self

    @property
    def extent(self) -> Pair:
        """Side lengths of the largest rectangle about the origin that the map covers [length].

        The origin is the point of first contact. The coefficient of friction is defined in this
        rectangle.
        """
        L_x, L_y = (
            count * spacing - 2.0 * abs(middle)
            for count, spacing, middle in zip(
                self.map.shape, self.spacing, self.origin, strict=True
            )
        )
        return L_x, L_y

    @cached_property
    def constant(self) -> float | None:
        """Coefficient of friction if all values of the map are equal; None if they differ."""
        values = self.map.values
        return float(values.flat[0]) if np.all(values == values.flat[0]) else None

    @property
    def is_even(self) -> bool:
        """True if the coefficient of friction is symmetric about the planes x = 0 and y = 0.

        The four coefficients at (±x, ±y) are then equal, to round-off.
        """
        values = self.map.values
        images = values[::-1], values[:, ::-1]
        nearly = ROUND_OFF * float(np.max(values))
        return self.origin == (0.0, 0.0) and all(
            np.allclose(values, image, rtol=0.0, atol=nearly) for image in images
        )

    @property
    def reach(self) -> float:
        """Radius of the largest circle about the origin within the outermost points [length]."""
        sides = zip(self.extent, self.spacing, strict=True)
        return 0.5 * min(side - spacing for side, spacing in sides)

    @cached_property
    def _means(self) -> tuple[Field, Field]:
        """Radii of circles about the origin, to `reach` and at most a spacing of the map apart,
        and the mean of the interpolated map on each."""
        radii = np.linspace(0.0, self.reach, ceil(self.reach / min(self.spacing)) + 1)
        angles = 2 * np.pi * (np.arange(ANGLES) + 0.5) / ANGLES
        x, y = np.multiply.outer((np.cos(angles), np.sin(angles)), radii)
        values = interpolate_between(
            self.map.values, self.spacing, x - self.origin[0], y - self.origin[1]
        )
        return radii, np.mean(values, axis=0)

    @cached_property
    def asymmetry(self) -> float:
        """Largest difference of a coefficient from the mean at its radius, over the largest [1].

        The values of the map within `reach` are compared. The value is 0 for a coefficient that
        depends on the distance from the origin alone, up to the interpolation of the map.
        """
        x, y = (
            (np.arange(count) - (count - 1) / 2) * side + middle
            for count, side, middle in zip(self.map.shape, self.spacing, self.origin, strict=True)
        )
        r, values = np.hypot(x[:, None], y), self.map.values
        off = np.abs(values - np.interp(r, *self._means))
        largest = float(np.max(values))
        return float(np.max(off, where=r <= self.reach, initial=0.0)) / largest if largest else 0.0

    def at_radii(self, radii: Field) -> "FrictionMap":
        """Return the map with its means over circles, in the order of points at given radii.

        radii  distances of the points from the origin, at most `reach` (any shape) [length]
        """
        values = np.interp(radii, *self._means)
        return self.model_copy(update={"map": replace(self.map, values=values)})

    def on_grid(self, cells: tuple[int, int], spacing: Pair) -> "FrictionMap":
        """Interpolate the map of the coefficient of friction at the cell centres of a grid.

        The grid is centred on the origin of the contact.

        cells    number of cells along x and y
        spacing  side lengths of a cell [length]
        returns  map of the coefficients of the cells, equal bit for bit at the points of the
                 original map

        Raises ValueError for cells beyond the extent of the map.
        """
        x, y = (
            (np.arange(count) - (count - 1) / 2) * side - middle
            for count, side, middle in zip(cells, spacing, self.origin, strict=True)
        )
        values = interpolate_between(self.map.values, self.spacing, x[:, None], y)
        return FrictionMap.model_validate({"map": values, "spacing": spacing})


def _coefficient_kind(value: Any) -> str:
    return "<mapped>" if isinstance(value, dict | FrictionMap) else "<uniform>"


Coefficient = Annotated[
    Annotated[FrictionCoefficient, Tag("<uniform>")] | Annotated[FrictionMap, Tag("<mapped>")],
    Discriminator(_coefficient_kind),
]


class CoulombFriction(Description):
    """Coulomb's law: the shear does not exceed coefficient times pressure and opposes the slip.

    `limit` and `slope` define the law. The limit is 0 at pressure 0 and does not decrease with the
    pressure; the slope is its derivative.
    """

    coefficient: Coefficient
    """Coefficient of friction mu >= 0, or a map of coefficients."""

    @property
    def uniform(self) -> float | None:
        """Coefficient of friction µ if the friction limit is µ times the pressure everywhere.

        The value is None if µ differs from point to point or depends on the pressure.
        """
        lowest, highest = self.slope(0.0), self.slope(HIGHEST_PRESSURE)
        if self.coefficient_map is not None or not np.array_equal(lowest, highest):
            return None
        return float(lowest)

    @property
    def coefficient_map(self) -> FrictionMap | None:
        """Map of the coefficient of friction; None if the coefficient is uniform."""
        mu = self.coefficient
        return mu if isinstance(mu, FrictionMap) and mu.constant is None else None

    @property
    def extent(self) -> Pair | None:
        """Side lengths of the rectangle about the origin where the friction is defined [length].

        The value is None without a map of the coefficient of friction.
        """
        return self.coefficient.extent if isinstance(self.coefficient, FrictionMap) else None

    def on_grid(self, cells: tuple[int, int], spacing: Pair) -> "CoulombFriction":
        """Return the friction law with its map interpolated at the cell centres of a grid.

        The grid is centred on the origin of the contact. A law with a uniform coefficient is
        returned unchanged.

        cells    number of cells along x and y
        spacing  side lengths of a cell [length]

        Raises ValueError for cells beyond the extent of the map.
        """
        if not isinstance(self.coefficient, FrictionMap):
            return self
        return self.model_copy(update={"coefficient": self.coefficient.on_grid(cells, spacing)})

    def at_radii(self, radii: Field) -> "CoulombFriction":
        """Return the friction law with the coefficients of points at distances from the axis.

        The coefficient of a point is the mean of the map over its circle. A law with a uniform
        coefficient is returned unchanged.

        radii  distances of the points from the axis, covered by the map (any shape) [length]
        """
        if self.coefficient_map is None:
            return self
        return self.model_copy(update={"coefficient": self.coefficient_map.at_radii(radii)})

    @property
    def is_even(self) -> bool:
        """True if the coefficient of friction is symmetric about the planes x = 0 and y = 0.

        The four coefficients at (±x, ±y) are then equal, to round-off. A uniform coefficient is
        symmetric.
        """
        return self.coefficient_map is None or self.coefficient_map.is_even

    @property
    def largest(self) -> float:
        """Largest coefficient of friction on the surface [1].

        The value is the slope of the friction limit at zero pressure.
        """
        return float(np.max(self.slope(0.0)))

    @property
    def smallest(self) -> float:
        """Smallest increase of the friction limit by an increase of the pressure [1].

        The value is the smallest coefficient of friction on the surface.
        """
        return float(min(np.min(self.slope(p)) for p in (0.0, HIGHEST_PRESSURE)))

    def slope(self, pressure: Field | float, where: Where = ...) -> Field:
        """Compute the derivative of the friction limit with respect to the pressure [1].

        The friction limit is the largest shear. Its derivative is the coefficient of friction of
        each cell.

        pressure  pressure of the selected cells [force/length^2]
        where     index of these cells in the friction map; absent: all cells of the map
        """
        mu = self._at(where)
        return np.broadcast_to(mu, np.broadcast_shapes(np.shape(mu), np.shape(pressure)))

    def limit(self, pressure: Field, where: Where = ...) -> Field:
        """Compute the friction limit of cells: the largest shear under a pressure [force/length^2].

        The limit is the coefficient of friction times the pressure.

        pressure  pressure of the selected cells [force/length^2]
        where     index of these cells in the friction map; absent: all cells of the map
        """
        return np.asarray(self._at(where) * pressure)

    def _at(self, where: Where) -> float | Field:
        """Return µ of selected cells, or one number if µ is uniform. `where` is a mask or an
        index."""
        mu = self.coefficient
        if not isinstance(mu, FrictionMap):
            return mu
        return mu.map.values[where] if mu.constant is None else mu.constant

    def largest_tangential_force(self, normal_force: float) -> float | None:
        """Compute the largest tangential force that friction carries under a normal force [force].

        The result is None if this force depends on the distribution of the pressure.

        normal_force  normal force [force]
        """
        mu = self.uniform
        return None if mu is None else mu * normal_force


FRICTIONLESS = CoulombFriction(coefficient=0.0)


def sliding_friction(start: Field, end: Field, passed: Field, before: Field, after: Field) -> Field:
    """Compute the mean shear during an increment, which dissipates energy along the slip.

    The shear has the direction of the shear at the end and the mean of both friction limits as its
    magnitude. This mean is exact for constant pressure, and for tractions and slip that grow in
    proportion. Points that lose contact have no shear at the end: there the mean shear has the
    direction of the slip and half the magnitude of the shear at the start, since the points may
    stick until they part.

    Parameters
    ----------
    start, end : ndarray, shape (c, …)
        Shear at the ends of the increment, c components [force/length^2].
    passed : ndarray, shape (c, …)
        Slip of the indenter relative to the body in the increment [length].
    before, after : ndarray, shape (…)
        Friction limits at start and end [force/length^2].

    Returns
    -------
    ndarray, shape (c, …)
        Mean shear [force/length^2].
    """
    separate = (before > 0) & (after == 0)
    along = np.where(separate, passed, end)
    length = np.abs(np.hypot.reduce(along, axis=0))
    direction = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
    size = np.where(separate, np.abs(np.hypot.reduce(start, axis=0)), before + after)
    return np.asarray(0.5 * size * direction)
