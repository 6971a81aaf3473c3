"""Newton step of the contact and friction laws of an increment at points.

Unknowns are the displacements of slipping and open points, and the rigid motions. Tractions follow
from displacements harmonic by harmonic (`ContactPoints.inverse_compliance`), scaled so that small
and large rings have entries of equal magnitude. All quantities are differences from the current
iterate, so that round-off is proportional to the remaining step.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from radial.tangential.ring_laws import (
    ContactLaws,
    NewtonIterate,
)
from radial.tangential.ring_state import NORMAL

Numbers = NDArray[np.int64]


class _FreePoints(NamedTuple):
    """Slipping and open points of a Newton step, whose displacements are the unknowns of the step.

    Sticking points have known displacements. The friction law of a slipping point is linearised
    about its trial shear. All entries but `points`, `slips`, `c` and `s` are 0 at open points.
    Tractions are scaled by the square root of the compliance of the point.

    points  indices of the n slipping and open points (n,)
    slips   true for slipping, false for open points (n,)
    c, s    cosine and sine of the angle between the trial shear and the radial direction (n, 1)
    share   friction limit over the magnitude of the trial shear (n, 1) [1]
    slopes  derivative of the friction limit with respect to the pressure, both scaled (n, 1) [1]
    rests   friction limit minus slope times pressure, scaled (n, 1)
    """

    points: Numbers
    slips: NDArray[np.bool_]
    c: Array
    s: Array
    share: Array
    slopes: Array
    rests: Array

    def displacements(self, m: int) -> Numbers:
        """Return the indices of the unknown displacements in the vector of all displacements.

        Slipping and open points have unknown displacements r and θ. Open points also have an
        unknown displacement z. The vector of all displacements has the components r, θ, z of m
        points (3 m,).

        m  number of points on the rings with contact
        """
        apart = self.points[~self.slips]
        return np.concatenate([self.points, m + self.points, 2 * m + apart])


def _find_free_points(
    at: NewtonIterate, m: int, friction: CoulombFriction, units: Array
) -> _FreePoints:
    """Find the slipping and open points of a Newton iterate, with the terms of their friction law.

    A point is open if its trial pressure is not positive. A point in contact slips if its trial
    shear exceeds the friction limit. The displacements of these points are the unknowns of the
    Newton step.

    at        current iterate
    m         number of points on the rings with contact
    friction  friction law
    units     square roots of the compliance of all components and points, as scales of tractions
              (3 m,)
    """
    y, limit = at.y[:, :m], at.limit[:m]
    length = np.hypot(*y)
    points = np.flatnonzero((at.z[:m] <= 0) | (length > limit))
    slips = at.z[points] > 0
    safe = np.where(slips, length[points], 1.0)
    c, s = np.where(slips, y[:, points] / safe, [[1.0], [0.0]])
    across, down = units[points], units[2 * m + points]
    pressure, most = np.maximum(at.z[points], 0.0), limit[points]
    slope = friction.slope(pressure)
    share, slopes, rests = np.where(
        slips, [most / safe, slope * across / down, (most - slope * pressure) * across], 0.0
    )
    return _FreePoints(points, slips, *(of[:, None] for of in (c, s, share, slopes, rests)))


def newton_iterate(laws: ContactLaws, at: NewtonIterate) -> Array | None:
    """Compute tractions and rigid motion of the indenter after one full Newton step (3 N + 4,).

    The step solves the contact and friction laws with fixed sticking, slipping and open points. The
    result is None if the linear system is singular, or if the normal force is prescribed and all
    points are open.

    laws  contact and friction laws of the increment at N points
    at    current iterate
    """
    points, size = laws.points, len(at.z)
    if laws.loads.forces[NORMAL] is not None and not np.any(at.z > 0):
        return None
    # Rings outside the outermost ring in contact carry no traction.
    rings = int(np.max(np.flatnonzero(at.z > 0), initial=0)) // points.count + 1
    K, m = points.inverse_compliance(rings), rings * points.count
    units = np.sqrt(points.restrict_to_rings(points.diagonal_compliance, rings))
    free = _find_free_points(at, m, laws.friction, units)
    own = free.displacements(m)
    t = points.restrict_to_rings(at.x[:-4], rings)
    imposed = _imposed_displacements(laws, at, rings, t) / units[:, None]
    residual = imposed[own, 4]
    imposed[own, 4] = 0.0
    # Tractions by the rigid motions, and at the iterate; their work on the rigid motions.
    carried = K @ imposed
    by_motion = imposed.T @ carried
    carried[:, 4] += t * units
    by_motion[4] += imposed.T @ (t * units)
    found = _solve_system(
        _point_equations(laws, at, free, K, carried, residual),
        _load_equations(laws, at, carried[own], by_motion),
    )
    if found is None:
        return None
    moved = np.zeros(3 * m)
    moved[own] = found[:-4]
    t = ((K @ moved + carried @ np.append(found[-4:], 1.0)) / units).reshape(3, m)
    t[:, at.z[:m] <= 0] = 0.0
    x = np.append(np.zeros(3 * size), at.x[-4:] + found[-4:])
    x[:-4].reshape(3, size)[:, :m] = t
    return x


def _imposed_displacements(laws: ContactLaws, at: NewtonIterate, rings: int, t: Array) -> Array:
    """Return the displacements that rigid motions and errors of a Newton iterate impose on points.

    All displacements are multiplied by the areas of the points. The shape is (3 m, 5), with the
    components r, θ, z of m points. The first four columns are the displacements by unit rigid
    motions. The last column is the displacement that contact and stick require at the motion of the
    iterate, minus the displacement by the tractions of the iterate.

    laws   contact and friction laws of the increment
    at     current iterate
    rings  number of innermost rings, which have m points
    t      tractions of these points at the iterate (3 m,)
    """
    points, m = laws.points, rings * laws.points.count
    whole = np.zeros((3, len(at.z)))
    whole[:, :m] = t.reshape(3, m)
    same = np.array_equal(whole.ravel(), at.x[:-4])
    u = points.restrict_to_rings(at.u if same else points.compliance @ whole.ravel(), rings)
    tied = points.rigid_motions.reshape(3, 2, -1)[:, :, :m].reshape(3, -1)
    moved = laws.moved.reshape(2, -1)[:, :m].ravel() - laws.motion[:NORMAL] @ tied
    imposed = np.zeros((3 * m, 5))
    imposed[: 2 * m, :3], imposed[2 * m :, 3] = tied.T, points.areas[:m]
    imposed[:, 4] = np.append(moved, -points.gap_areas[:m]) + imposed[:, :4] @ at.x[-4:] - u
    return imposed


def _point_equations(
    laws: ContactLaws,
    at: NewtonIterate,
    free: _FreePoints,
    K: Array,
    carried: Array,
    residual: Array,
) -> tuple[Array, Array]:
    """Assemble the linear equations of slipping and open points for one Newton step.

    A slipping point has the friction limit along its shear direction w, and the linearised friction
    law across w. An open point has zero pressure. The function returns the matrix of the unknown
    displacements (unknowns, unknowns), and the columns of the 4 rigid motions and the constants
    (unknowns, 5).

    laws      contact and friction laws of the increment
    at        current iterate
    free      slipping and open points
    K         stiffness matrix, scaled tractions per scaled displacements of m points (3 m, 3 m)
    carried   scaled tractions by unit rigid motions and at the iterate (3 m, 5)
    residual  required minus present displacement of the unknowns (unknowns,)
    """
    n, m = len(free.points), len(K) // 3
    c, s, share = free.c, free.s, free.share
    own = free.displacements(m)
    every = np.concatenate([own[: 2 * n], 2 * m + free.points])
    across = np.arange(n, 2 * n)
    found = []
    # K is symmetric, so rows are taken instead of columns: they are contiguous in memory.
    for by in (K.take(every, axis=0).take(own, axis=1), carried[every]):
        outward, around, down = by[:n], by[n : 2 * n], by[2 * n :]
        found.append(np.concatenate([
            c * outward + s * around - free.slopes * down,
            (1 - share) * (c * around - s * outward),
            down[~free.slips],
        ]))  # fmt: skip
    rows, left = found
    left[:n, 4] -= free.rests[:, 0]
    rows[across, across] += (share * c)[:, 0]
    rows[across, across - n] -= (share * s)[:, 0]
    left[across, 4] -= (share * (c * residual[n : 2 * n, None] - s * residual[:n, None]))[:, 0]
    return rows, left


def _load_equations(
    laws: ContactLaws, at: NewtonIterate, carried: Array, by_motion: Array
) -> Array:
    """Assemble the four linear equations of prescribed loads and motions for one Newton step.

    A prescribed force gives an equation of equilibrium. A prescribed motion gives the value of this
    motion. The shape is (4, unknowns + 5): unknown displacements, 4 rigid motions and the constant.

    laws       contact and friction laws of the increment, with the prescribed loads and motions
    at         current iterate
    carried    scaled tractions of the unknown displacements, by unit rigid motions and at the
               iterate (unknowns, 5)
    by_motion  work of the tractions by unit rigid motions, and at the iterate, on unit rigid
               motions (5, 5)
    """
    rows = np.concatenate([carried, by_motion]).T[:4]
    ends = zip(laws.loads.forces, laws.loads.motions, strict=True)
    for i, (force, motion) in enumerate(ends):
        # A prescribed force gives an equation of equilibrium, a prescribed motion gives its value.
        if force is None:
            rows[i], rows[i, i - 5], rows[i, -1] = 0.0, -1.0, motion
            rows[i, -1] -= at.x[i - 4]
        else:
            rows[i, -1] -= force
    return rows


def _solve_system(laws: tuple[Array, Array], loads: Array) -> Array | None:
    """Solve the linear system of a Newton step for unknown displacements and rigid motions.

    The unknowns are changes from the current iterate. The result is None if the system is singular.

    laws   equations of slipping and open points: matrix (n, n), and columns of the 4 rigid motions
           and the constants (n, 5)
    loads  equations of prescribed loads and motions, constants last (4, n + 5)
    """
    rows, left = laws
    n = len(rows)
    whole = np.empty((n + 4, n + 4))
    whole[:n, :n], whole[:n, n:], whole[n:] = rows, left[:, :4], loads[:, :-1]
    right = np.append(left[:, 4], loads[:, -1])
    # LAPACK expects columns, so it factorises the transpose.
    LU, places, failed = lapack.dgetrf(whole.T, overwrite_a=True)
    if failed:
        return None
    found = lapack.dgetrs(LU, places, -right, trans=1)[0]
    return found if np.all(np.isfinite(found)) else None
