"""Hertz contact with an elliptical contact area, in closed form.

The undeformed gap is x²/2Rx + y²/2Ry. All formulas use Carlson's symmetric elliptic integrals,
which have no 0/0 in the circular limit and do not depend on which axis is the longer. The solution
is valid for semi-axes much smaller than the radii and for uncoupled pairs.
"""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import elliprd, elliprf


def axis_ratio(radius_x: float, radius_y: float) -> float:
    """Compute the ratio k = b/a of the semi-axes along y and x of an elliptical Hertz contact.

    k follows from Rx/Ry = R_D(1, 0, k²)/R_D(k², 0, 1) with Carlson's integral R_D. The equation is
    the classical B/A = [(a/b)²E - K]/[K - E] (Hertz 1882) after cancelling the common factor 1 -
    k².

    radius_x  radius of curvature Rx of the gap along x [length]
    radius_y  radius of curvature Ry of the gap along y [length]
    """
    if radius_x == radius_y:
        return 1.0
    target = np.log(radius_x / radius_y)

    def mismatch(log_k: float) -> float:
        square = np.exp(2 * log_k)
        return float(np.log(elliprd(1, 0, square) / elliprd(square, 0, 1)) - target)

    # k lies between 1 and Ry/Rx: the ellipse is less slender than the ratio of the radii
    return float(np.exp(brentq(mismatch, -target, 0.0, xtol=1e-15, rtol=8.9e-16)))


@dataclass(frozen=True)
class EllipticalContact:
    """Hold an elliptical Hertz contact (Hertz 1882; Johnson 1985, ch. 4.2); created by
    `under_load`.

    radii            principal radii of curvature (Rx, Ry) of the gap [length]
    contact_modulus  contact modulus E* [force/length²]
    semi_axes        semi-axes (a, b) of the contact along x and y [length]
    axis_ratio       b/a, which is also defined at first touch, where the semi-axes vanish
    """

    radii: tuple[float, float]
    contact_modulus: float
    semi_axes: tuple[float, float]
    axis_ratio: float

    @classmethod
    def under_load(
        cls, load: float, radii: tuple[float, float], contact_modulus: float
    ) -> "EllipticalContact":
        """Compute the elliptical Hertz contact under a normal load W >= 0 [force].

        radii            principal radii of curvature (Rx, Ry) of the gap [length]
        contact_modulus  contact modulus E* [force/length²]
        """
        k = axis_ratio(*radii)
        a = np.cbrt(load * radii[0] * elliprd(k**2, 0, 1) / (pi * contact_modulus))
        return cls(radii, contact_modulus, (float(a), float(k * a)), k)

    @property
    def _pressure_slope(self) -> float:
        # p0/a, independent of the load
        k = self.axis_ratio
        return float(3 * self.contact_modulus / (2 * self.radii[0] * k * elliprd(k**2, 0, 1)))

    @property
    def peak_pressure(self) -> float:
        """Pressure p0 = 3W/2πab at the centre of the contact [force/length²].

        W is the normal load; a and b are the semi-axes.
        """
        return self._pressure_slope * self.semi_axes[0]

    @property
    def load(self) -> float:
        """Normal load W = 2πab p0/3 [force], with the semi-axes a and b and the peak
        pressure p0.
        """
        a, b = self.semi_axes
        return 2 * pi / 3 * a * b * self.peak_pressure

    @property
    def approach(self) -> float:
        """Approach of distant points of the two bodies since first touch [length].

        The approach is 3WK/2πE*a with the complete elliptic integral K, normal load W and semi-axis
        a.
        """
        b = self.semi_axes[1]
        return float(self.peak_pressure * b * elliprf(1, self.axis_ratio**2, 0)) / (
            self.contact_modulus
        )

    def pressure(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Compute the pressure of the elliptical Hertz contact at points (x, y) [force/length²].

        The coordinates are broadcast together. The pressure is zero outside the contact ellipse.
        """
        xs, ys = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        room = self.semi_axes[0] ** 2 - xs**2 - (ys / self.axis_ratio) ** 2
        return np.asarray(self._pressure_slope * np.sqrt(np.maximum(room, 0)))

    def surface_displacement(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Compute the normal surface displacement of both bodies together at points (x, y)
        [length].

        The points may lie inside or outside the contact. The displacement is the potential of an
        ellipsoidal density: the integrals start at the parameter of the confocal ellipse through
        (x, y), which is zero inside. The load must be above zero.
        """
        xs, ys = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        a2, b2 = self.semi_axes[0] ** 2, self.semi_axes[1] ** 2
        half = (xs**2 + ys**2 - a2 - b2) / 2
        product = b2 * xs**2 + a2 * ys**2 - a2 * b2
        root = np.sqrt(np.maximum(half**2 + product, 0))
        # of the two forms of the quadratic's positive root, the one that does not cancel
        near = np.divide(product, root - half, out=np.zeros_like(root), where=half < 0)
        confocal = np.where(product > 0, np.where(half < 0, near, half + root), 0.0)
        potential = (
            elliprf(a2 + confocal, b2 + confocal, confocal)
            - xs**2 * elliprd(b2 + confocal, confocal, a2 + confocal) / 3
            - ys**2 * elliprd(a2 + confocal, confocal, b2 + confocal) / 3
        )
        scale = self._pressure_slope * a2 * self.semi_axes[1] / self.contact_modulus
        return np.asarray(scale * potential)

    def gap(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Compute the gap of the deformed surfaces at points (x, y) [length].

        The gap is zero to rounding inside the contact.
        """
        xs, ys = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        undeformed = xs**2 / (2 * self.radii[0]) + ys**2 / (2 * self.radii[1])
        if self.semi_axes[0] == 0:
            return np.asarray(undeformed)
        return np.asarray(undeformed - self.approach + self.surface_displacement(xs, ys))
