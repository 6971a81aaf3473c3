"""Influence coefficients of a homogeneous half-space in closed form.

The point solutions of Boussinesq and Cerruti (Johnson 1985, sections 3.2 and 3.6) are integrated
over the loaded cell. Each integral is the second difference of a primitive F(X, Y) over the four
corners (Love 1929 for pressure).
"""

from dataclasses import dataclass
from functools import cached_property
from math import pi, sqrt

import numpy as np

from contact_scene.array_types import Field


class RectangleIntegrals:
    """Integrals over a rectangular loaded cell from which the half-space displacements follow.

    The observers are at the cell offsets (i dx, j dy), i < nx, j < ny. (x, y) is the vector from
    the loaded point to the observer, r its length. Each integral has the shape (nx, ny) and the
    dimension [length], and is computed at its first use.

    dx, dy  cell sides [length]
    shape   number of offsets along x and y, including zero
    """

    def __init__(self, dx: float, dy: float, shape: tuple[int, int]) -> None:
        # Lengths in units of the cell minimise the cancellation in differences of logarithms.
        self._unit = sqrt(dx * dy)
        self._X = ((np.arange(shape[0] + 1) - 0.5) * dx / self._unit)[:, None]
        self._Y = ((np.arange(shape[1] + 1) - 0.5) * dy / self._unit)[None, :]

    def _corners(self, primitive: Field) -> Field:
        """Evaluate an integral over the loaded cell from its primitive at the cell corners (nx, ny)
        [length].

        The result is the second difference of the primitive over the corners.

        primitive  values at corner offsets, in units of √(dx dy) (nx + 1, ny + 1)
        """
        return self._unit * np.diff(np.diff(primitive, axis=0), axis=1)

    @cached_property
    def _rho(self) -> Field:
        """Distance from each corner of a cell to the observer, in units of √(dx dy) (nx + 1, ny +
        1)."""
        return np.hypot(self._X, self._Y)

    @cached_property
    def xx_r3(self) -> Field:
        """Integral of x^2 / r^3 over the loaded cell, for observers at all cell offsets (nx, ny).

        (x, y) is the vector from the loaded point to the observer, r its length. The integral is in
        [length].
        """
        return self._corners(self._Y * np.arcsinh(self._X / np.abs(self._Y)))

    @cached_property
    def yy_r3(self) -> Field:
        """Integral of y^2 / r^3 over the loaded cell, for observers at all cell offsets (nx, ny).

        (x, y) is the vector from the loaded point to the observer, r its length. The integral is in
        [length].
        """
        if self._X.size == self._Y.size and np.array_equal(self._X[:, 0], self._Y[0]):
            return self.xx_r3.T
        return self._corners(self._X * np.arcsinh(self._Y / np.abs(self._X)))

    @cached_property
    def xy_r3(self) -> Field:
        """Integral of x y / r^3 over the loaded cell, for observers at all cell offsets (nx, ny).

        (x, y) is the vector from the loaded point to the observer, r its length. The integral is in
        [length].
        """
        return self._corners(-self._rho)

    @cached_property
    def x_r2(self) -> Field:
        """Integral of x / r^2 over the loaded cell, for observers at all cell offsets (nx, ny).

        (x, y) is the vector from the loaded point to the observer, r its length. The integral is in
        [length].
        """
        X, Y = self._X, self._Y
        return self._corners(Y * np.log(self._rho) + X * np.arctan(Y / X))

    @cached_property
    def y_r2(self) -> Field:
        """Integral of y / r^2 over the loaded cell, for observers at all cell offsets (nx, ny).

        (x, y) is the vector from the loaded point to the observer, r its length. The integral is in
        [length].
        """
        X, Y = self._X, self._Y
        return self._corners(X * np.log(self._rho) + Y * np.arctan(X / Y))


@dataclass(frozen=True)
class HalfSpaceCoefficients:
    """Influence coefficients of a homogeneous half-space (Johnson 1985, eqs 3.19 and 3.75-3.77).

    They are surface displacements at cell centres by a unit traction on one cell.

    integrals      integrals over the loaded cell
    shear_modulus  G [force/length^2]
    poisson_ratio  Poisson's ratio nu
    """

    integrals: RectangleIntegrals
    shear_modulus: float
    poisson_ratio: float

    def __getitem__(self, component: str) -> Field:
        """Return one component of the influence coefficients of a half-space at all cell offsets
        (nx, ny).

        The coefficients are surface displacements per unit traction on one cell [length^3/force].

        component  displacement and traction, e.g. "zx" for the normal displacement by the shear q_x
        """
        nu = self.poisson_ratio
        integrals = {
            "zz": {"xx_r3": 1 - nu, "yy_r3": 1 - nu},
            "xx": {"xx_r3": 1.0, "yy_r3": 1 - nu},
            "yy": {"yy_r3": 1.0, "xx_r3": 1 - nu},
            "xy": {"xy_r3": nu},
            "zx": {"x_r2": 0.5 - nu},
            "zy": {"y_r2": 0.5 - nu},
        }[component]
        total = sum(factor * getattr(self.integrals, name) for name, factor in integrals.items())
        return np.asarray(total / (2 * pi * self.shear_modulus))
