"""Roughly the inverse of the generalised derivative, graded by how much slip is held back.

On stick the tangential operator alone acts; where a cell slips, d is added to it, which grows from
nothing at the border of stick to many times the self-compliance. Neither the inverse of the
operator nor that of the diagonal fits in between. So slip is graded: with hats χ_j² over log d,
which add up to one,

    M = Π F⁻¹ Π + Σ_j χ_j t (f + d_j)⁻¹ t χ_j,    Π = stick + χ_0 t t,    d_j = K₀ 4^(j-1)

F the tangential spectrum with the unpadded period, f its scalar mean and K₀ the self-compliance.
"""

import numpy as np
from numpy.typing import NDArray

from semi_analytical.coupled_operator import RATIO, STIFFNESSES
from semi_analytical.coupled_problem import CoupledProblem
from semi_analytical.generalised_derivative import Zones

Field = NDArray[np.float64]


class GradedPreconditioner:
    """Roughly the free unknowns that the derivative makes rows of, both (3, nx, ny)."""

    def __init__(self, zones: Zones, problem: CoupledProblem) -> None:
        self._zones, self._inverse = zones, problem.precondition_together
        d, last = zones.turning / problem.self_compliance, STIFFNESSES[-1]
        grade = np.log(np.maximum(d, 1 / RATIO)) / np.log(RATIO) + 1
        number = np.arange(len(STIFFNESSES) + 1)[:, None, None]
        hats = np.maximum(0.0, 1 - np.abs(np.minimum(grade, number[-1]) - number))
        shares = np.sqrt(hats) * (zones.contact - zones.stick)
        # Beyond the last grade its stiffness is too small.
        shares[-1] *= np.sqrt((1 + last) / (1 + np.maximum(d, last)))
        self._sticking, self._shares = zones.tangent * shares[0], shares[1:]
        self._rows = np.empty((3 + len(STIFFNESSES), *d.shape), dtype=np.float32)

    def __call__(self, rows: Field) -> Field:
        """M rows."""
        zones, v = self._zones, self._rows
        along = zones.along(rows)
        v[:2] = self._stuck(rows, along)
        np.multiply(zones.contact, rows[2], out=v[2])
        np.multiply(self._shares, along, out=v[3:])
        u = self._inverse(v)
        u[:2] = self._stuck(u, zones.along(u))
        u[:2] += zones.tangent * np.einsum("kij,kij->ij", self._shares, u[3:])
        u[2] *= zones.contact
        return u[:3].astype(np.float64)

    def _stuck(self, v: Field, along: Field) -> Field:
        """Π v, t·v given."""
        return v[:2] * self._zones.stick + self._sticking * along
