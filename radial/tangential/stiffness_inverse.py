"""Inverse of the compliance of rings in zones of contact, stick and slip, from their stiffness."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack

from contact_scene.array_types import Array
from contact_scene.solver_errors import NotConverged
from contact_solver.conjugate_gradients import Map
from contact_solver.dense_inverse import DenseInverse
from contact_solver.zones import Zones
from radial.tangential.ring_operator import RingOperator


@dataclass(frozen=True)
class StiffnessInverse:
    """Inverse of the compliance in zones, from the stiffness of the rings with contact.

    The displacements of sticking points are known. The unknowns are those of slipping points, and
    of open points inside the outermost ring in contact.

    compliance  compliance of all points
    stiffness   function from a number of innermost rings to the inverse of their compliance
    count       number of points on a ring
    """

    compliance: RingOperator
    stiffness: Callable[[int], RingOperator]
    count: int
    exact = True

    def in_zones(self, zones: Zones) -> Map:
        """Return the inverse of the coupled problem in zones of contact, stick and slip.

        zones   zones of an iterate
        raises  NotConverged if the derivative is singular
        """
        rings = int(zones.contact_points[-1]) // self.count + 1
        stiffness, m = self.stiffness(rings), rings * self.count
        stick, slip, contact = zones.stick_points, zones.slip, zones.contact_points
        apart, slips = np.flatnonzero(~zones.contact[:m]), len(slip)
        unknown = np.concatenate([slip, m + slip, apart, m + apart, 2 * m + apart])
        t_x, t_y = zones.tangent[:, :, None]
        d = zones.slip_compliance[:, None]
        assert zones.friction_slope is not None
        slope = np.sum(zones.normal * zones.friction_slope, axis=0)[:, None]

        def laws(x: Array, y: Array, z: Array, apart: Array) -> Array:
            """Combine tractions to the shear along the slip less the limit, d times that across."""
            return np.concatenate([t_y * x - t_x * y - slope * z, d * (t_x * x + t_y * y), apart])

        # The stiffness is symmetric: rows, which are contiguous, are taken instead of columns.
        by_unknown = stiffness.matrix.take(unknown, axis=0)
        own, down = by_unknown.take(unknown, axis=1), by_unknown.take(2 * m + slip, axis=1).T
        system = laws(own[:slips], own[slips : 2 * slips], down, own[2 * slips :])
        number = np.arange(slips)
        system[slips + number, number] += zones.tangent[0]
        system[slips + number, slips + number] += zones.tangent[1]
        solve = _lu_inverse(system) if len(unknown) else np.asarray

        def inverse(rows: Array) -> Array:
            """Compute the free unknowns of several residuals (k, size)."""
            x, y, along, z = np.split(rows, np.cumsum([len(stick), len(stick), slips]), axis=1)
            u = np.zeros((len(rows), 3, m))
            u[:, 0, stick], u[:, 1, stick], u[:, 2, contact] = x, y, z
            known = stiffness(u).reshape(len(rows), -1)
            at_unknown = known.T[unknown]
            right = -laws(
                at_unknown[:slips],
                at_unknown[slips : 2 * slips],
                known.T[2 * m + slip],
                at_unknown[2 * slips :],
            )
            right[slips : 2 * slips] += along.T
            t = (known + solve(right).T @ by_unknown).reshape(u.shape)
            shear = zones.tangent[0] * t[:, 0, slip] + zones.tangent[1] * t[:, 1, slip]
            return np.concatenate([t[:, 0, stick], t[:, 1, stick], shear, t[:, 2, contact]], axis=1)

        return inverse

    def with_compliance(self, compliance: float) -> DenseInverse:
        """Return the inverse for surfaces with an additional compliance of each point.

        compliance  additional displacement of a point by its own unit traction [length^3/force]
        """
        return DenseInverse(self.compliance.matrix).with_compliance(compliance)


def _lu_inverse(matrix: Array) -> Map:
    # LAPACK expects columns, so it factorises the transpose.
    factors, places, failed = lapack.dgetrf(matrix.T, overwrite_a=True)
    if failed:
        raise NotConverged("the linear system of a contact step", 0, np.inf, 0.0)
    return lambda right: np.asarray(lapack.dgetrs(factors, places, right, trans=1)[0])
