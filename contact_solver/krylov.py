"""GMRES: solution of linear systems by minimisation of the residual over a Krylov space.

The method is that of Saad and Schultz (1986). Newton's method for coupled increments uses it.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Matrix, Vector

# Norm ratio below which a vector is orthogonalised a second time.
REORTHOGONALISE = 0.1
# Relative norm of a linearly dependent vector after orthogonalisation.
ROUND_OFF = 1e-14


@dataclass(frozen=True)
class LeastResidual:
    """Solution of the linear system A v + E m = r by right-preconditioned GMRES.

    In Newton's method v are changes of tractions, m changes of rigid motions and r the residual.

    solution    vector v
    image       product A v
    extra       product B v with another linear map B, summed from single-precision values
    motion      coefficients m of the columns of E (rigid motions of the indenter)
    iterations  number of products with A
    """

    solution: Vector
    image: Vector
    extra: Vector
    motion: Vector
    iterations: int


def least_residual(
    apply: Callable[[Vector], tuple[Vector, Vector, Vector]],
    right: Vector,
    free: Matrix,
    extra: int,
    depth: float,
    most: int,
) -> LeastResidual:
    """Solve the linear system A v + E m = r for v = M w and m by right-preconditioned GMRES.

    Newton's method uses this function: v are changes of tractions, m changes of rigid motions. The
    rounding does not depend on the number of threads (no matrix products).

    apply  function w -> (v, A v, B v), with v = M w, preconditioner M and another linear map B, to
           vectors of the size `extra`
    right  right-hand side r (n,)
    free   columns of E as rows (k, n); they may be linearly dependent
    extra  size of B v
    depth  residual at which the solve ends, over the minimum residual for v = 0
    most   maximum number of iterations
    """
    rows, combination = orthonormal(free)
    k = len(rows)
    basis = np.empty((k + most + 1, right.size))
    changes, extras = np.empty((most, right.size)), np.empty((most, extra), dtype=np.float32)
    basis[:k] = rows
    del free, rows  # release the memory of many vectors
    first, r = _orthogonalise(right, basis[:k])
    size = float(np.sqrt(np.sum(r * r)))
    hessenberg, weights = np.zeros((k + most + 1, most)), np.zeros(0)
    goal = np.zeros(most + 1)
    goal[0] = size
    for number in range(most if size > 0 else 0):
        end = k + number + 1
        np.multiply(
            r, 1 / hessenberg[end - 1, number - 1] if number else 1 / size, out=basis[end - 1]
        )
        changes[number], image, extras[number] = apply(basis[end - 1])
        hessenberg[:end, number], r = _orthogonalise(image, basis[:end])
        hessenberg[end, number] = np.sqrt(np.sum(r * r))
        within = hessenberg[k : end + 1, : number + 1]
        weights = np.asarray(np.linalg.lstsq(within, goal[: number + 2])[0])
        residual = np.linalg.norm(within @ weights - goal[: number + 2])
        breakdown = hessenberg[end, number] <= ROUND_OFF * np.linalg.norm(hessenberg[:, number])
        if residual <= depth * size or breakdown:
            break
    count = len(weights)
    components = hessenberg[: k + count, :count] @ weights
    image = np.einsum("i,ik->k", components, basis[: k + count])
    return LeastResidual(
        np.einsum("i,ik->k", weights, changes[:count]),
        image + weights[-1] * r if count else image,
        np.einsum("i,ik->k", weights, extras[:count]),
        combination @ (first - components[:k]),
        count,
    )


def _orthogonalise(v: Vector, basis: Matrix) -> tuple[Vector, Vector]:
    """Compute the components of v (n,) along orthonormal rows (k, n), and the orthogonal remainder.

    Gram-Schmidt orthogonalisation is repeated once if the remainder is small.
    """
    components = np.einsum("ik,k->i", basis, v)
    remainder = v - np.einsum("i,ik->k", components, basis)
    if np.sum(remainder * remainder) < REORTHOGONALISE**2 * np.sum(v * v):
        more = np.einsum("ik,k->i", basis, remainder)
        components, remainder = components + more, remainder - np.einsum("i,ik->k", more, basis)
    return components, remainder


def orthonormal(given: Matrix) -> tuple[Matrix, Matrix]:
    """Compute orthonormal rows (j, n) that span the same space as given rows (k, n), with j <= k.

    The second result is the matrix (k, j) of the coefficients of the orthonormal rows in terms of
    the given rows.
    """
    sizes, vectors = np.linalg.eigh(np.einsum("ik,jk->ij", given, given))
    independent = sizes > ROUND_OFF * np.max(sizes, initial=0.0)
    combination = vectors[:, independent] / np.sqrt(sizes[independent])
    return np.einsum("ij,ik->jk", combination, given), combination
