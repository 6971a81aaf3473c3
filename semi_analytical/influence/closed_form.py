"""Influence coefficients of a homogeneous half-space in closed form.

The point solutions of Boussinesq and Cerruti (Johnson 1985, sections 3.2 and 3.6) are integrated
over the loaded cell. Each integral is the second difference of a primitive F(X, Y) over the four
corners (Love 1929 for pressure). r is the length of (x, y).
"""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from contact_scene.array_types import Field


@dataclass(frozen=True)
class HalfSpaceCoefficients:
    """Influence coefficients of a homogeneous half-space (Johnson 1985, eqs 3.19 and 3.75-3.77).

    They are surface displacements at cell centres by a unit traction on one cell. The observers are
    at the cell offsets (i dx, j dy), i < nx, j < ny.

    spacing        cell sides (dx, dy) [length]
    shape          number of offsets (nx, ny), including zero
    shear_modulus  G [force/length^2]
    poisson_ratio  Poisson's ratio nu
    """

    spacing: tuple[float, float]
    shape: tuple[int, int]
    shear_modulus: float
    poisson_ratio: float

    def __getitem__(self, component: str) -> Field:
        """Return one component of the influence coefficients of a half-space at all cell offsets
        (nx, ny).

        The coefficients are surface displacements per unit traction on one cell [length^3/force].

        component  displacement and traction, e.g. "zx" for the normal displacement by the shear q_x
        """
        # Lengths in units of the cell minimise the cancellation in differences of logarithms.
        unit, nu = sqrt(self.spacing[0] * self.spacing[1]), self.poisson_ratio
        x, y = (
            (np.arange(n + 1, dtype=np.float64) - 0.5) * side / unit
            for n, side in zip(self.shape, self.spacing, strict=True)
        )
        primitive, along_x, along_y = {
            "zz": (_square_over_cube, 1 - nu, 1 - nu),
            "xx": (_square_over_cube, 1.0, 1 - nu),
            "yy": (_square_over_cube, 1 - nu, 1.0),
            "xy": (_product_over_cube, nu, 0.0),
            "zx": (_over_square, 0.5 - nu, 0.0),
            "zy": (_over_square, 0.0, 0.5 - nu),
        }[component]
        total = np.zeros(self.shape)
        for factor, s, o in ((along_x, x[:, None], y), (along_y, y, x[:, None])):
            if factor:
                total += factor * unit * np.diff(np.diff(primitive(s, o), axis=0), axis=1)
        return total / (2 * pi * self.shear_modulus)


def _square_over_cube(x: Field, y: Field) -> Field:
    """Return the primitive of x²/r³ with respect to x and y."""
    return y * np.arcsinh(x / np.abs(y))


def _product_over_cube(x: Field, y: Field) -> Field:
    """Return the primitive of xy/r³ with respect to x and y."""
    return -np.hypot(x, y)


def _over_square(x: Field, y: Field) -> Field:
    """Return the primitive of x/r² with respect to x and y."""
    return y * np.log(np.hypot(x, y)) + x * np.arctan(y / x)
