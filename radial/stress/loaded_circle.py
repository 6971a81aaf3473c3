"""Tractions on a circle that are proportional to a root at its edge.

The fields below the surface are computed from these tractions. With a tangential load the centre of
the circle is displaced from the axis.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Array
from radial.response.quadrature import unit_gauss

Complex = NDArray[np.complex128]

# PANEL: Gauss points of a panel. LOAD_POINTS: points of the integral of the load. HARMONICS:
# highest harmonic of the load, large enough against aliasing.
PANEL = 16
LOAD_POINTS = 128
HARMONICS = 15


@dataclass(frozen=True, eq=False)
class LoadedCircle:
    """Pressure and shear on the lower body over a circular contact area, zero at its edge.

    The tractions are `smooth` times √(1-η²), where η is the distance from the centre over the
    radius. The stress below the surface is computed from these tractions.

    radius  radius of the circle [length]
    centre  x coordinate of the centre, whose y is 0 [length]
    smooth  q_x, q_y, p over √(1-η²) at η = k/(n-1) and angles 2πj/J (3, n, J) [force/length²]; for
            J = 1 the axisymmetric q_r, q_θ, p
    """

    radius: float
    centre: float
    smooth: Array

    @property
    def is_round(self) -> bool:
        """True if the tractions of the circle are axisymmetric and stored at one angle."""
        return self.smooth.shape[2] == 1

    @property
    def load(self) -> float:
        """Normal force on the circle, the integral ∫ p dA of the pressure [force]."""
        eta, area = self.disc_rule(LOAD_POINTS)
        return float(2 * np.pi * self.radius**2 * self.harmonics(eta, HARMONICS)[2][0].real @ area)

    @staticmethod
    def disc_rule(count: int) -> tuple[Array, Array]:
        """Return points η and weights η dη of Gauss quadrature over the radius of a unit disc.

        Used to integrate tractions over a loaded circle. The substitution η = sin α removes the
        root of the tractions at the edge.

        count  least number of points
        """
        panels = -(-count // PANEL)
        v, weights = unit_gauss(PANEL)
        angle = ((np.arange(panels)[:, None] + v) / panels).ravel() * (np.pi / 2)
        eta = np.sin(angle)
        return eta, np.tile(weights, panels) / panels * (np.pi / 2) * np.cos(angle) * eta

    def tractions_on_upper_body(self) -> LoadedCircle:
        """Return the tractions on the upper body, the indenter, whose shear has the opposite sign.

        The axis z points into the upper body. Used for the stress in the indenter.
        """
        return replace(self, smooth=self.smooth * np.array([-1.0, -1.0, 1.0])[:, None, None])

    def interpolate_tractions(self, x: Array, y: Array) -> Array:
        """Interpolate shear q_x, q_y and pressure to given positions (3, …) [force/length²].

        The tractions are 0 outside the circle.

        x, y  coordinates from the centre of the circle over its radius (…)
        """
        eta = np.hypot(x, y)
        root = np.sqrt(np.maximum((1 - eta) * (1 + eta), 0.0))
        _, n, angles = self.smooth.shape
        place = np.minimum(eta, 1.0) * (n - 1)
        k = np.minimum(place.astype(np.intp), n - 2)
        off = place - k
        turn = np.arctan2(y, x) * (angles / (2 * np.pi)) % angles
        j = np.minimum(turn.astype(np.intp), angles - 1)
        offset = turn - j
        flat = self.smooth.reshape(3, -1)
        here, next_ = k * angles + j, k * angles + (j + 1) % angles
        inner, inner_next, outer, outer_next = (
            flat.take(one, axis=1) for one in (here, next_, here + angles, next_ + angles)
        )
        inner = inner * (1 - offset) + inner_next * offset
        outer = outer * (1 - offset) + outer_next * offset
        found = np.asarray(root * (inner * (1 - off) + outer * off))
        if self.is_round:
            outward, around, p = found
            cos, sin = (np.divide(part, eta, out=0 * eta, where=eta > 0) for part in (x, y))
            return np.stack([outward * cos - around * sin, outward * sin + around * cos, p])
        return found

    def harmonics(self, eta: Array, highest: int) -> tuple[Complex, Complex, Complex]:
        """Compute the angular harmonics 0 … M of the tractions on rings about the centre.

        The three results are the complex amplitudes of exp(imθ) of q_r + i q_θ, q_r - i q_θ and the
        pressure, each (M + 1, n) [force/length²]. Except for m = 0 they are doubled, as sums over
        m ≥ 0 require.

        eta      radii of the rings over the radius of the circle (n,)
        highest  highest harmonic M
        """
        count = 2 * highest + 2
        theta = 2 * np.pi * np.arange(count) / count
        cos, sin = np.cos(theta), np.sin(theta)
        x, y, p = self.interpolate_tractions(eta[:, None] * cos, eta[:, None] * sin)
        outward, around = x * cos + y * sin, y * cos - x * sin
        found = np.fft.rfft(np.stack([outward, around, p]), axis=-1)[..., : highest + 1] / count
        found[..., 1:] *= 2
        outward, around, p = np.moveaxis(found, -1, 1)
        return outward + 1j * around, outward - 1j * around, p
