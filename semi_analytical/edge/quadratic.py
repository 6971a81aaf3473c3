"""Quadratic functions of the position in the plane, each expanded about a different point.

The edge correction represents φ = p^(1/α) near the contact edge by these functions, with the
pressure p. Coordinates are cell indices.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import mean_power


@dataclass(frozen=True)
class Quadratic:
    """Quadratic functions of the position, one about each of several cells or points (x, y).

    Each function is f + f_x dx + f_y dy + (f_xx dx² + 2 f_xy dx dy + f_yy dy²)/2, with the
    distances dx, dy from (x, y) in cells. All arrays have one shape. The edge correction represents
    φ = p^(1/α), a function of the pressure p that vanishes smoothly at the contact edge, by such
    quadratics.
    """

    x: Field
    y: Field
    f: Field
    f_x: Field
    f_y: Field
    f_xx: Field
    f_xy: Field
    f_yy: Field

    @property
    def slope(self) -> Field:
        """Magnitude of the gradient of each quadratic function at its expansion point."""
        return np.hypot(self.f_x, self.f_y)

    def chosen(self, which: Mask | Indices | slice) -> Quadratic:
        """Return a subset of the quadratic functions.

        which  mask, indices or slice of the selected functions
        """
        return Quadratic(*(part[which] for part in vars(self).values()))

    def reshape_arrays(self, shape: tuple[int, ...]) -> Quadratic:
        """Return the quadratic functions with all coefficient arrays in another shape.

        shape  new shape, with as many entries as the present one
        """
        return Quadratic(*(part.reshape(shape) for part in vars(self).values()))

    def in_scaled_axes(self, dx: float, dy: float) -> Quadratic:
        """Convert the derivatives of quadratic functions from cells to another unit of length.

        The expansion points remain cell indices.

        dx, dy  sides of a cell along x and y in the new unit
        """
        return Quadratic(
            *(self.x, self.y, self.f, self.f_x / dx, self.f_y / dy),
            *(self.f_xx / dx**2, self.f_xy / (dx * dy), self.f_yy / dy**2),
        )

    def evaluate(self, dx: Field, dy: Field) -> Field:
        """Evaluate each quadratic function at an offset from its expansion point.

        dx, dy  offsets along x and y in cells; they broadcast with the arrays of the functions
        """
        bend = (self.f_xx * dx + 2 * self.f_xy * dy) * dx + self.f_yy * dy * dy
        return np.asarray(self.f + self.f_x * dx + self.f_y * dy + bend / 2)

    def about(self, x: Field, y: Field) -> Quadratic:
        """Compute the expansion of each quadratic function about another point.

        The functions themselves do not change, only the coefficients.

        x, y  new expansion points as cell indices
        """
        dx, dy = x - self.x, y - self.y
        return Quadratic(
            *np.broadcast_arrays(
                x,
                y,
                self.evaluate(dx, dy),
                self.f_x + self.f_xx * dx + self.f_xy * dy,
                self.f_y + self.f_xy * dx + self.f_yy * dy,
                self.f_xx,
                self.f_xy,
                self.f_yy,
            )
        )

    def cell_mean(self, exponent: float | Field) -> Field:
        """Compute the mean of φ_+^exponent over the unit cell about each expansion point.

        Negative φ counts as zero. φ is taken as linear over the cell, with its mean and its slopes
        at the centre. The exponent 0 yields the fraction of the cell with positive φ.

        exponent  exponent of φ, a number or one per quadratic
        """
        return mean_power(self.mean, self.f_x, self.f_y, exponent)

    @property
    def cut(self) -> Mask:
        """True if the line φ = 0 of a quadratic cuts the unit cell about its expansion point.

        The function is taken as linear over the cell. With φ = p^(1/α) of the pressure p the zero
        line is the contact edge.
        """
        return np.asarray(np.abs(self.mean) < (np.abs(self.f_x) + np.abs(self.f_y)) / 2)

    @property
    def mean(self) -> Field:
        """Mean of each quadratic function over the unit cell about its expansion point."""
        return np.asarray(self.f + (self.f_xx + self.f_yy) / 24)
