"""Exact inverse of the derivative in zones, for points whose compliance is a matrix.

A Krylov solver with this preconditioner needs one or two iterations.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import cho_factor, cho_solve, lu_factor, lu_solve

from contact_scene.array_types import Field, Mask, Matrix
from contact_scene.solver_errors import NotConverged
from contact_solver.conjugate_gradients import Map
from contact_solver.zones import Zones


@dataclass(frozen=True)
class DenseInverse:
    """Inverse of the compliance of n points in zones of contact, stick and slip.

    matrix  compliance: displacements by tractions, components (q_x, q_y, p) outermost (3 n, 3 n);
            symmetric
    """

    matrix: Matrix
    exact = True

    def on_contact(self, contact: Mask) -> Map:
        """Return the inverse of the map from pressure to normal displacement on a contact set.

        contact  points in contact (n,)
        raises   NotConverged if the matrix is not positive definite
        """
        normal = slice(2 * contact.size, None)
        return inverse_on(self.matrix[normal, normal], contact)

    def in_zones(self, zones: Zones) -> Map:
        """Return the inverse in zones of contact, stick and slip, as a map of rows (k, size).

        zones   zones of an iterate
        raises  NotConverged if the derivative is singular
        """
        n = zones.contact.size
        rows = _free_rows(self.matrix, zones)
        derivative = _free_rows(rows.T, zones).T.copy()
        stuck, slips = 2 * len(zones.stick_points), len(zones.slip)
        along = np.arange(stuck, stuck + slips)
        derivative[along, along] += zones.slip_compliance
        if zones.friction_slope is None:
            solve = _symmetric_inverse(derivative)
            return lambda rows: solve(rows.T).T
        # In slipping points the shear along the slip follows the pressure.
        pressed = stuck + slips + np.searchsorted(zones.contact_points, zones.slip)
        for axis, slope in enumerate(zones.friction_slope):
            derivative[:, pressed] += rows[:, axis * n + zones.slip] * slope
        factors = lu_factor(derivative, check_finite=False)
        if not np.all(np.diagonal(factors[0])):
            raise NotConverged("the linear system of a contact step", 0, np.inf, 0.0)
        return lambda rows: np.asarray(lu_solve(factors, rows.T, check_finite=False).T)

    def with_compliance(self, compliance: float) -> DenseInverse:
        """Return the inverse for surfaces with an additional compliance of each point.

        compliance  additional displacement of a point by its own unit traction [length^3/force]
        """
        return replace(self, matrix=self.matrix + compliance * np.eye(len(self.matrix)))


def inverse_on(matrix: Matrix, contact: Mask) -> Map:
    """Return the inverse of a map from pressure to normal displacement on a contact set.

    matrix   displacements by pressures (n, n); symmetric
    contact  points in contact (n,)
    raises   NotConverged if the matrix is not positive definite
    """
    chosen = np.flatnonzero(contact)
    solve = _symmetric_inverse(matrix[np.ix_(chosen, chosen)])

    def inverse(gap: Field) -> Field:
        p = np.zeros_like(gap)
        p[chosen] = solve(gap[chosen])
        return p

    return inverse


def _free_rows(matrix: Matrix, zones: Zones) -> Matrix:
    """Restrict rows for the components q_x, q_y, p of n points (3 n, k) to the free unknowns."""
    n, stick, slip = zones.contact.size, zones.stick_points, zones.slip
    t_x, t_y = zones.tangent[:, :, None]
    across = t_x * matrix[slip] + t_y * matrix[n + slip]
    pressed = matrix[2 * n + zones.contact_points]
    return np.concatenate([matrix[stick], matrix[n + stick], across, pressed])


def _symmetric_inverse(matrix: Matrix) -> Map:
    try:
        factor = cho_factor(matrix, lower=True, check_finite=False)
    except np.linalg.LinAlgError as error:
        raise NotConverged("the linear system of a contact step", 0, np.inf, 0.0) from error
    return lambda right: np.asarray(cho_solve(factor, right, check_finite=False))
