"""Preconditioned conjugate gradients for tractions in fixed zones of contact, stick and slip."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field

Map = Callable[[Field], Field]


class Point(NamedTuple):
    """Iterate of a contact problem: tractions, and the surface displacements that they cause.

    tractions      pressure (n,) or shear (2, n) [force/length^2]
    displacements  displacement components of the same shape [length]
    """

    tractions: Field
    displacements: Field


def inner(a: Field, b: Field) -> float:
    """Compute the scalar product Σ a b of two fields of the same shape.

    Its rounding does not depend on the number of threads, unlike that of BLAS.
    """
    return float(np.einsum("i,i->", a.ravel(), b.ravel()))


def solve_in_zones(
    displace: Map,
    rows: Callable[[Field, Field], Field],
    precondition: Map,
    residual: Field,
    depth: float,
    most: int,
) -> tuple[Field, Field, int]:
    """Solve a contact problem linearised in fixed zones by preconditioned conjugate gradients.

    Displacements are carried along, so that the result needs no further product. Return the change
    of the tractions, its displacements, and the number of iterations.

    displace      map from a change of the free tractions to displacements; symmetric, positive
    rows          map from such a change and its displacements to the rows of the linear system
    precondition  approximate inverse, from rows to changes that keep the prescribed forces
    residual      rows of the residual at the start
    depth         reduction of the residual norm at which the iteration stops
    most          largest number of iterations
    """
    r = residual
    d = z = precondition(r)
    t = np.zeros_like(d)
    u: Field | float = 0.0
    rz = first = inner(r, z)
    iterations = 0
    while rz > depth**2 * first and iterations < most:
        iterations += 1
        d_u = displace(d)
        fall = rows(d, d_u)
        curvature = inner(d, fall)
        if curvature == 0:  # d is round-off: prescribed forces leave no free direction
            break
        step = rz / curvature
        t += step * d
        u = u + step * d_u
        r = r - step * fall
        z = precondition(r)
        rz, last = inner(r, z), rz
        d = z + (rz / last) * d
    return t, np.asarray(u), iterations
