"""Quadratic functions of the position in index coordinates, one function per place."""

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
        """Magnitude of the gradient of each quadratic at the point about which it is expanded."""
        return np.hypot(self.f_x, self.f_y)

    def chosen(self, which: Mask | Indices | slice) -> Quadratic:
        """Select some of the quadratics.

        which  mask, indices or slice of their places
        """
        return Quadratic(*(part[which] for part in vars(self).values()))

    def reshape_arrays(self, shape: tuple[int, ...]) -> Quadratic:
        """Return the quadratics with all arrays in another shape."""
        return Quadratic(*(part.reshape(shape) for part in vars(self).values()))

    def in_scaled_axes(self, dx: float, dy: float) -> Quadratic:
        """Convert derivatives to a unit of length in which a cell has the sides dx and dy.

        The places remain index coordinates.
        """
        return Quadratic(
            *(self.x, self.y, self.f, self.f_x / dx, self.f_y / dy),
            *(self.f_xx / dx**2, self.f_xy / (dx * dy), self.f_yy / dy**2),
        )

    def evaluate(self, dx: Field, dy: Field) -> Field:
        """Evaluate the quadratics at offsets from their places.

        dx, dy  offsets in cells; further axes come first
        """
        bend = (self.f_xx * dx + 2 * self.f_xy * dy) * dx + self.f_yy * dy * dy
        return np.asarray(self.f + self.f_x * dx + self.f_y * dy + bend / 2)

    def about(self, x: Field, y: Field) -> Quadratic:
        """Expand the quadratics about other places; the functions themselves do not change.

        x, y  new places in index coordinates
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
        """Compute the mean of the power φ_+^exponent of each quadratic φ over the unit cell about
        its point.

        The linear part of the quadratic represents φ in the cell. Negative φ counts as zero. The
        exponent 0 yields the fraction of the cell with positive φ.
        """
        return mean_power(self.mean, self.f_x, self.f_y, exponent)

    @property
    def cut(self) -> Mask:
        """True if the linear part of the quadratic vanishes somewhere in the unit cell about its
        place."""
        return np.asarray(np.abs(self.mean) < (np.abs(self.f_x) + np.abs(self.f_y)) / 2)

    @property
    def mean(self) -> Field:
        """Mean of each quadratic over the unit cell about the point of its expansion."""
        return np.asarray(self.f + (self.f_xx + self.f_yy) / 24)
