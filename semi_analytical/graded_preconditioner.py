"""Roughly the inverse of the generalised derivative, graded by how much slip is held back.

On stick the tangential operator alone acts; where a cell slips, d is added to it. Neither the
inverse of the operator nor that of the diagonal fits in between. So slip is graded (see `grades`):

    M = Π F⁻¹ Π + Σ_j χ_j t (f + d_j)⁻¹ t χ_j,    Π = stick + χ_0 t t

F the tangential spectrum with the unpadded period and f its scalar mean.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semi_analytical.coupled_problem import CoupledProblem
from semi_analytical.generalised_derivative import Zones
from semi_analytical.grades import shares

Vector = NDArray[np.float64]


class GradedPreconditioner:
    """Roughly the free unknowns that the derivative makes rows of, both vectors of the zones."""

    def __init__(self, zones: Zones, problem: CoupledProblem) -> None:
        self._zones, self._inverse = zones, problem.precondition_together
        self._shares = shares(zones.turning / problem.self_compliance)

    def __call__(self, rows: Vector) -> Vector:
        """M rows."""
        zones, slip, shares = self._zones, self._zones.slip, self._shares
        shape = zones.contact.shape
        v: NDArray[Any] = np.zeros((2 + len(shares), zones.contact.size), dtype=np.float32)
        v[:3] = zones.field(rows).reshape(3, -1)
        along = zones.parts(rows)[1]
        for one in v[:2]:
            one[slip] *= shares[0]
        for one, share in zip(v[3:], shares[1:], strict=True):
            one[slip] = share * along
        u = self._inverse(v.reshape(-1, *shape)).reshape(v.shape)
        for one in u[:2]:
            one[slip] *= shares[0]
        free = zones.free(u[:3])
        turned = zones.parts(free)[1]
        for one, share in zip(u[3:], shares[1:], strict=True):
            turned += share * one[slip]
        return free
