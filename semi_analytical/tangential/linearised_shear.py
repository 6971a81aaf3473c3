"""Tangential problem linearised in given zones of stick and slip, by projected conjugate gradients.

Rigid motions of prescribed force are additional unknowns, and all iterates preserve these forces.
Where all cells slip in one direction, the force along it cannot be preserved: the pseudo-inverse
leaves it to the exact projection.
"""

from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, VectorField
from semi_analytical.tangential.admissible_shear import TangentialLoad
from semi_analytical.tangential.shear_zones import (
    Map,
    ShearZones,
)

MAX_ITERATIONS = 100
# Relative singular value below which the zones do not determine a force.
UNDETERMINED = 1e-12


class Point(NamedTuple):
    """Shear and its displacement, each (2, nx, ny)."""

    shear: VectorField
    displacement: VectorField


class LinearisedShear:
    """Derivative of the tangential problem in given zones under a load.

    displace, inverse  see `tangential_problem.solve_tangential`
    carriers           shears (2, nx, ny) that correct the prescribed forces in these zones
    """

    def __init__(
        self,
        displace: Map,
        inverse: Map,
        zones: ShearZones,
        load: TangentialLoad,
        carriers: list[VectorField] | None = None,
    ) -> None:
        """Compute the carriers, or reuse `carriers` of another point with the same zones."""
        self._displace, self._inverse, self._zones, self._load = displace, inverse, zones, load
        if carriers is None:
            units = load.free_motions(zones.sliding_shear.shape)
            self.carriers = [zones.preconditioned(zones.free(unit), inverse) for unit in units]
        else:
            self.carriers = [zones.free(carrier) for carrier in carriers]
        responses = np.array([load.forces(carrier) for carrier in self.carriers])
        count = len(self.carriers)
        self._shares = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return an admissible shear near q that slips in the slip zone."""
        near = self._zones.sliding_shear + self._zones.free(q)
        self._carry(self._load.given - self._load.forces(near), near)
        return self._load.admissible(near, bound)

    def solved(self, base: Point, slipped: VectorField, depth: float) -> tuple[Point, int]:
        """Solve the linearised problem by preconditioned conjugate gradients.

        Iterations stop when the norm of the residual at the base has fallen by the factor `depth`.
        Returns the point and the iterations.

        slipped  ω + c - u at the base (2, nx, ny)
        """
        zones = self._zones
        q, u = base.shear.copy(), base.displacement.copy()
        r = zones.free(slipped - zones.slip_compliance * q)
        t = z = self._preconditioned(r)
        rz = first = float(np.sum(r * z))
        iterations = 0
        while rz > depth**2 * first and iterations < MAX_ITERATIONS:
            iterations += 1
            A_t = self._displace(t)
            H_t = zones.free(A_t) + zones.slip_compliance * t
            step = rz / float(np.sum(t * H_t))
            q += step * t
            u += step * A_t
            r -= step * H_t
            z = self._preconditioned(r)
            rz, last = float(np.sum(r * z)), rz
            t = z + (rz / last) * t
        return Point(q, u), iterations

    def _preconditioned(self, v: VectorField) -> VectorField:
        """Apply the preconditioner and remove the prescribed forces of the result."""
        free = self._zones.preconditioned(v, self._inverse)
        self._carry(-self._load.forces(free), free)
        return free

    def _carry(self, forces: Field, free: VectorField) -> None:
        """Add carriers with the given forces to a free shear, in place."""
        for share, carrier in zip(self._shares @ forces, self.carriers, strict=True):
            free += share * carrier
