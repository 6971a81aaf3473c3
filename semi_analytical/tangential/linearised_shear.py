"""Tangential problem linearised in given stick and slip zones, solved by projected conjugate
gradients.

Rigid motions of prescribed force are additional unknowns, and all iterates preserve these forces.
Where all cells slip in one direction, the force along this direction cannot be preserved: the
pseudo-inverse leaves it to the exact projection.
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
    """Iterate of the tangential problem: a shear and the displacement that it causes.

    shear         q (2, nx, ny) [force/length^2]
    displacement  tangential displacement by the shear (2, nx, ny) [length]
    """

    shear: VectorField
    displacement: VectorField


class LinearisedShear:
    """Tangential problem linearised in given stick and slip zones under a load.

    displace, inverse  shear-to-displacement map and its approximate inverse, see
                       `tangential_problem.solve_tangential`
    zones              stick and slip zones
    load               prescribed tangential load
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
        """Compute the carriers, shears that correct the prescribed forces in the stick and slip
        zones.

        carriers  carriers of another iterate with the same zones, which are reused; None to compute
                  them
        """
        self._displace, self._inverse, self._zones, self._load = displace, inverse, zones, load
        if carriers is None:
            units = load.free_motions(zones.sliding_shear.shape)
            self.carriers = [zones.precondition(zones.free(unit), inverse) for unit in units]
        else:
            self.carriers = [zones.free(carrier) for carrier in carriers]
        responses = np.array([load.forces(carrier) for carrier in self.carriers])
        count = len(self.carriers)
        self._shares = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return an admissible shear near q: within the friction limit and with the prescribed
        forces.

        Slipping cells first receive the friction limit along their slip. The result is then
        corrected to the prescribed forces and projected.

        q      shear (2, nx, ny)
        bound  friction limit µp (nx, ny)
        """
        near = self._zones.sliding_shear + self._zones.free(q)
        self._correct_forces(self._load.prescribed_forces - self._load.forces(near), near)
        return self._load.admissible(near, bound)

    def solve_in_zones(self, base: Point, slipped: VectorField, depth: float) -> tuple[Point, int]:
        """Solve the tangential problem in fixed stick and slip zones by preconditioned conjugate
        gradients.

        Return the solution and the number of iterations. The iteration stops when the norm of the
        residual has fallen by the factor `depth`.

        base     starting point: shear and its displacement
        slipped  slip at the starting point (2, nx, ny) [length]: rigid motion plus the displacement
                 that stick requires minus the actual displacement
        """
        zones = self._zones
        q, u = base.shear.copy(), base.displacement.copy()
        r = zones.free(slipped - zones.slip_compliance * q)
        t = z = self._precondition(r)
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
            z = self._precondition(r)
            rz, last = float(np.sum(r * z)), rz
            t = z + (rz / last) * t
        return Point(q, u), iterations

    def _precondition(self, v: VectorField) -> VectorField:
        """Apply the preconditioner to a residual v (2, nx, ny), without changing the prescribed
        forces."""
        free = self._zones.precondition(v, self._inverse)
        self._correct_forces(-self._load.forces(free), free)
        return free

    def _correct_forces(self, forces: Field, free: VectorField) -> None:
        """Add a combination of carrier shears to a shear in place, so that its forces change as
        required.

        Carriers are the shears that correct the prescribed forces in the present zones.

        forces  required change of the forces (k,), divided by the cell area
        free    shear that is changed (2, nx, ny)
        """
        for share, carrier in zip(self._shares @ forces, self.carriers, strict=True):
            free += share * carrier
