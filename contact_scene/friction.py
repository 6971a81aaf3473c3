"""Friction between the two bodies."""

from functools import cached_property
from types import EllipsisType
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Discriminator, Tag, model_validator

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
from contact_scene.reading.validator_error import refusal

Field = NDArray[np.float64]
Pair = tuple[float, float]
Where = tuple[slice, slice] | EllipsisType

# What rounding leaves between coefficients that are meant to be the same, relative to the largest.
ROUND_OFF = 1e-14
# Above any pressure of a contact: where a limit still has its first slope, it is in proportion.
HIGHEST_PRESSURE = 1e30  # [force/length^2]


class FrictionMap(Description):
    """Coefficients of friction that vary over the surface."""

    map: FileKey
    """A `.npy` file with coefficients, index [i, j] = (x_i, y_j), or a `.csv` or `.txt` file as
    seen from above; linear in between."""

    spacing: PairOfSpacings
    """Distance of neighbouring coefficients along x and y [length]; one number for both. A map of
    128 coefficients over 1.28 mm has 0.01 mm."""

    origin: tuple[Length, Length] = (0.0, 0.0)
    """Where the middle of the map lies, along x and y from the origin of the contact [length]."""

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
        """Lengths along x and y about the origin within which the coefficient is known [length]."""
        L_x, L_y = (
            count * spacing - 2.0 * abs(middle)
            for count, spacing, middle in zip(
                self.map.shape, self.spacing, self.origin, strict=True
            )
        )
        return L_x, L_y

    @cached_property
    def constant(self) -> float | None:
        """The coefficient where it is the same everywhere; None where it varies."""
        values = self.map.values
        return float(values[0, 0]) if np.all(values == values[0, 0]) else None

    @property
    def is_even(self) -> bool:
        """Whether the coefficient is the same at (±x, ±y), to rounding."""
        values = self.map.values
        images = values[::-1], values[:, ::-1]
        nearly = ROUND_OFF * float(np.max(values))
        return self.origin == (0.0, 0.0) and all(
            np.allclose(values, image, rtol=0.0, atol=nearly) for image in images
        )

    def on(self, cells: tuple[int, int], spacing: Pair) -> "FrictionMap":
        """The coefficients at the centres of other cells about the origin of the contact.

        spacing  of the cells [length]
        Bit for bit the same where the cells are those of the map; ValueError beyond its extent.
        """
        x, y = (
            (np.arange(count) - (count - 1) / 2) * side - middle
            for count, side, middle in zip(cells, spacing, self.origin, strict=True)
        )
        values = interpolate_between(self.map.values, self.spacing, x[:, None], y)
        return FrictionMap.model_validate({"map": values, "spacing": spacing})


def _kind(value: Any) -> str:
    return "<mapped>" if isinstance(value, dict | FrictionMap) else "<uniform>"


Coefficient = Annotated[
    Annotated[FrictionCoefficient, Tag("<uniform>")] | Annotated[FrictionMap, Tag("<mapped>")],
    Discriminator(_kind),
]


class CoulombFriction(Description):
    """Coulomb's law: the shear never exceeds coefficient times pressure; slip opposes it.

    `limit` and `slope` define the law: the limit, which vanishes without pressure and never falls
    with the pressure, and its derivative. Everything else follows from these two.
    """

    coefficient: Coefficient
    """Coefficient of friction mu >= 0, or a map of it."""

    @property
    def uniform(self) -> float | None:
        """The coefficient µ if the limit is µp with the same µ everywhere; None otherwise."""
        lowest, highest = self.slope(0.0), self.slope(HIGHEST_PRESSURE)
        if self.varying is not None or not np.array_equal(lowest, highest):
            return None
        return float(lowest)

    @property
    def varying(self) -> FrictionMap | None:
        """The map of the coefficient; None where it is the same everywhere."""
        mu = self.coefficient
        return mu if isinstance(mu, FrictionMap) and mu.constant is None else None

    @property
    def extent(self) -> Pair | None:
        """Lengths along x and y about the origin within which the coefficient is known [length];
        None without a map."""
        return self.coefficient.extent if isinstance(self.coefficient, FrictionMap) else None

    def on(self, cells: tuple[int, int], spacing: Pair) -> "CoulombFriction":
        """The same law with one coefficient for every cell of a grid, where it is given as a map.

        spacing  of the cells [length]
        ValueError beyond the extent of the map.
        """
        if not isinstance(self.coefficient, FrictionMap):
            return self
        return CoulombFriction(coefficient=self.coefficient.on(cells, spacing))

    @property
    def is_even(self) -> bool:
        """Whether the coefficient is the same at (±x, ±y), to rounding."""
        return self.varying is None or self.varying.is_even

    @property
    def largest(self) -> float:
        """The largest ratio of shear to pressure anywhere, which is that of low pressures."""
        return float(np.max(self.slope(0.0)))

    def slope(self, pressure: Field | float, where: Where = ...) -> Field:
        """Derivative of the limit with respect to the pressure, at a pressure [1].

        where  the cells that the pressure is of; all of them if absent
        """
        mu = self._at(where)
        return np.broadcast_to(mu, np.broadcast_shapes(np.shape(mu), np.shape(pressure)))

    def limit(self, pressure: Field, where: Where = ...) -> Field:
        """The largest shear under a pressure, of the same shape [force/length^2].

        where  the cells that the pressure is of; all of them if absent
        """
        return np.asarray(self._at(where) * pressure)

    def _at(self, where: Where) -> float | Field:
        """The coefficient in cells."""
        mu = self.coefficient
        if not isinstance(mu, FrictionMap):
            return mu
        return mu.map.values[where] if mu.constant is None else mu.constant

    def carried(self, normal_force: float) -> float | None:
        """The largest tangential force under a normal force [force]; None where it depends on the
        distribution of the pressure."""
        mu = self.uniform
        return None if mu is None else mu * normal_force


FRICTIONLESS = CoulombFriction(coefficient=0.0)


def sliding_friction(start: Field, end: Field, passed: Field, before: Field, after: Field) -> Field:
    """Friction along the way that surfaces slip in an increment, as the shear (c, …)
    [force/length^2]: along the shear at the end, as large as the mean of the limits at both ends.

    Exact where the pressure stays, and where tractions and slip grow in proportion. What parts in
    the increment has no shear at its end: there friction is along the way, and half the shear at
    the start, for it may have stuck until then.

    start, end     shear, its components first (c, …)
    passed         how far the indenter's particles moved past the body's (c, …) [length]
    before, after  friction limits at start and end (…)
    """
    parts = (before > 0) & (after == 0)
    along = np.where(parts, passed, end)
    length = np.abs(np.hypot.reduce(along, axis=0))
    direction = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
    size = np.where(parts, np.abs(np.hypot.reduce(start, axis=0)), before + after)
    return np.asarray(0.5 * size * direction)
