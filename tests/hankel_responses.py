"""Reference energies of smooth tractions on a coated half-space, by Hankel transforms, for tests.

In harmonic n the tractions (q_r cos n theta, q_t sin n theta, p cos n theta) have transforms

    a = (H_{n-1}[q_r - q_t] - H_{n+1}[q_r + q_t]) / 2     along the wave vector
    b = -(H_{n-1}[q_r - q_t] + H_{n+1}[q_r + q_t]) / 2    across it
    c = H_n[p]

and the displacements those of F_ss a + C c, F_tt b, F_zz c + C a. F is the response of the
semi-analytical solver, which other tests compare with values of 60 digits.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import gamma, jv

from semi_analytical.frf.surface import scalars

POWER = 2  # of (1 - r^2): two continuous derivatives where the patch ends


@dataclass(frozen=True)
class Patch:
    """q_r - q_t = s r^|n-1| (1-r^2)^2, q_r + q_t = d r^(n+1) (1-r^2)^2, p = v r^n (1-r^2)^2."""

    harmonic: int
    s: float
    d: float
    v: float

    def tractions(self, r):
        """(3, ...) amplitudes q_r, q_theta, p."""
        n, inside = self.harmonic, np.maximum(1 - r**2, 0.0) ** POWER
        difference = self.s * r ** abs(n - 1) * inside
        total = self.d * r ** (n + 1) * inside
        return np.stack(
            [(total + difference) / 2, (total - difference) / 2, self.v * r**n * inside]
        )

    def transforms(self, k):
        """a, b, c at wavenumbers k."""
        n = self.harmonic
        lower = np.sign(n - 0.5) ** (n - 1) * self.s * _sonine(abs(n - 1), k)  # J_-1 = -J_1
        upper = self.d * _sonine(n + 1, k)
        return (lower - upper) / 2, -(lower + upper) / 2, self.v * _sonine(n, k)


def _sonine(order, k):
    """Integral of r^(order+1) (1-r^2)^POWER J_order(kr) over the unit disc's radius."""
    return 2**POWER * gamma(POWER + 1) * jv(order + POWER + 1, k) / k ** (POWER + 1)


def patch_energy(stacks, patch, signs=(1,)):
    """Integral of t . u r dr; responses of bodies add, with the sign of C given for each."""
    edges = np.concatenate([[1e-9], np.geomspace(1e-4, 2, 40), np.arange(4, 400, 2.0)])
    x, w = np.polynomial.legendre.leggauss(16)
    half = np.diff(edges)[:, None] / 2
    k = ((edges[:-1, None] + half) + half * x).ravel()
    weights = (half * w).ravel()
    responses = [scalars(stack, k) for stack in stacks]
    ss, _, zz, tt = sum(map(np.array, responses))
    C = sum(sign * response.c12 for sign, response in zip(signs, responses, strict=True))
    a, b, c = patch.transforms(k)
    return float(np.sum(weights * k * (ss * a**2 + tt * b**2 + zz * c**2 + 2 * C * a * c)))


def nodal_forces(patch, radii):
    """(3, m) integrals of psi_i t r dr over the patch for the quadratic traces on the radii."""
    forces = np.zeros((3, radii.size))
    x, w = np.polynomial.legendre.leggauss(8)
    for first in range(0, radii.size - 2, 2):
        left, right = radii[first], min(radii[first + 2], 1.0)
        if left >= 1.0:
            break
        r = left + (right - left) * (x + 1) / 2
        xi = (r - left) / (radii[first + 2] - left)
        psi = np.stack([(1 - xi) * (1 - 2 * xi), 4 * xi * (1 - xi), xi * (2 * xi - 1)])
        forces[:, first : first + 3] += patch.tractions(r) * r * (w * (right - left) / 2) @ psi.T
    return forces
