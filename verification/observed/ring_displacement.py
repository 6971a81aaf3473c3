"""Displacement of points on rings by their tractions, from the responses of bodies to waves.

The tractions are hat functions of the radius r, times waves of the angle θ. In a harmonic m the
shear and the pressure are q_r cos mθ, q_θ sin mθ and p cos mθ, or the same turned by a quarter
wave. The transforms P of q_r - q_θ by J_{m-1}, Q of q_r + q_θ by J_{m+1} and Z of p by J_m respond
to each other at every wavenumber k:

    (C11 + Csh)/4 P + (Csh - C11)/4 Q + C12/2 Z   by J_{m-1}, added to u_r, subtracted from u_θ
    (C11 + Csh)/4 Q + (Csh - C11)/4 P - C12/2 Z   by J_{m+1}, added to u_r and u_θ
    C22 Z + C12/2 (P - Q)                         by J_m, added to u_z

C is the response of both bodies (`surface_response`). Means over hat functions converge with the
fourth power of the largest wavenumber. The solver integrates kernels in closed form instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene import Scene
from contact_scene.array_types import Field
from radial.response.bessel_functions import bessel_functions
from radial.response.wavenumbers import waves as wave_quadrature
from semi_analytical.frf.response_matrix import surface_response
from verification.observed.ring_points import displacement_by_harmonics, sum_over_hats

# Largest and smallest wavenumber times the radius of the last ring. The displacements have an
# error of 3e-5 for the rings of the solver, of which the smallest are 1/1000 of this radius apart.
SHORTEST = 500.0
LONGEST = 1e-3
# Largest wavenumber times radius per ring: the phase changes by at most 25 over an even ring of 7.
PER_RING = 14.0
# Gauss points of an element between two rings: n resolve a change of the phase of 4 (n - 6).
PLACES, PARTS = np.polynomial.legendre.leggauss(12)
BLOCK = 256  # wavenumbers that are transformed at a time


@dataclass(frozen=True)
class RingDisplacement:
    """Displacement of the rings of a result by tractions, as means over the hat function of each.

    scene    bodies with their layers
    radii    radii of the rings, from 0 (rings,) [length]
    highest  highest harmonic of the angle
    """

    scene: Scene
    radii: Field
    highest: int

    def by(self, tractions: Field, angles: Field) -> Field:
        """Compute the displacement r, θ, z of the lower body relative to the indenter [length].

        tractions  shear r, θ and pressure at the rings and angles (3, rings, angles)
                   [force/length²]
        angles     angles of the points, one, half a circle or the whole circle [radian]
        """
        highest = 0 if len(angles) == 1 else self.highest
        return displacement_by_harmonics(tractions, angles, highest, self._of_harmonic)

    def _of_harmonic(self, m: int, _: bool, loads: Field) -> Field:
        """Compute the amplitudes (3, rings) of the displacement by those of the tractions."""
        shares, hats, (c11, c12, c22, across) = *self._hats, self._responses
        # For m = 0 the order -1 is J_{-1} = -J_1.
        lower, upper, same = (1 if m else -1) * hats[abs(m - 1)], hats[m + 1], hats[m]
        P, Q, Z = lower @ (loads[0] - loads[1]), upper @ (loads[0] + loads[1]), same @ loads[2]
        mean, apart, half = (c11 + across) / 4, (across - c11) / 4, c12 / 2
        by_lower = (mean * P + apart * Q + half * Z) @ lower
        by_upper = (mean * Q + apart * P - half * Z) @ upper
        normal = (c22 * Z + half * (P - Q)) @ same
        return np.stack([by_lower + by_upper, by_upper - by_lower, normal]) / shares

    @cached_property
    def _wavenumbers(self) -> tuple[Field, Field]:
        """Wavenumbers k and their weights k dk, each (k,)."""
        reach = float(self.radii[-1])
        shortest = min(SHORTEST, PER_RING * len(self.radii))
        places, weights = wave_quadrature(shortest, LONGEST, 1.0).rule
        return places / reach, places * weights / reach**2

    @cached_property
    def _responses(self) -> Field:
        """Responses C11, C12, C22 and Csh of both bodies times the weights of k (4, k)."""
        k, weights = self._wavenumbers
        total = np.zeros((4, len(k)))
        for body, sign in ((self.scene.body, 1.0), (self.scene.indenter, -1.0)):
            F = surface_response(body, k, 0.0)
            across, along = F[:, 1, 1].real, F[:, 0, 0].real
            total += (along, sign * F[:, 0, 2].imag, F[:, 2, 2].real, across)
        return total * weights

    @cached_property
    def _hats(self) -> tuple[Field, Field]:
        """Integrals ∫ φ r dr (rings,) and transforms ∫ φ J_m r dr (orders, k, rings)."""
        share, length = (1 + PLACES) / 2, np.diff(self.radii)[:, None]
        r = self.radii[:-1, None] + length * share
        area = 0.5 * length * PARTS * r
        k, _ = self._wavenumbers
        found = np.empty((self.highest + 2, len(k), len(self.radii)))

        for start in range(0, len(k), BLOCK):
            some = slice(start, start + BLOCK)
            at = np.multiply.outer(k[some], r)
            for order, values in enumerate(bessel_functions(self.highest + 1, at)):
                found[order, some] = sum_over_hats(values * area, share)
        return sum_over_hats(area, share), found
