"""GMRES: the Krylov vectors' combination that leaves the least residual (Saad and Schultz 1986)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Matrix, Vector

# A vector that has lost so much to those before it is made orthogonal to them once more.
LOST = 0.1
# What rounding leaves of a vector that those before it explain.
ROUND_OFF = 1e-14


@dataclass(frozen=True)
class LeastResidual:
    """What `least_residual` finds.

    solution    v
    image       A v
    along       what came along, of v, added up from single precision
    motion      m
    iterations  products with A
    """

    solution: Vector
    image: Vector
    along: Vector
    motion: Vector
    iterations: int


def least_residual(
    apply: Callable[[Vector], tuple[Vector, Vector]],
    right: Vector,
    free: Matrix,
    extra: int,
    depth: float,
    most: int,
) -> LeastResidual:
    """Solve A v + E m = r for v and for as many m as E has columns, until the norm of the residual
    is the part `depth` of what it is with v = 0.

    apply  v -> A v, and whatever linear in v comes along, of the size `extra`
    right  r
    free   the columns of E (k, size of r); they may depend on each other

    Not by matrix products, whose rounding depends on the number of threads.
    """
    rows, turn = orthonormal(free)
    k = len(rows)
    basis = np.empty((k + most + 1, right.size))
    along = np.empty((most, extra), dtype=np.float32)
    basis[:k] = rows
    del free, rows  # as large as many vectors
    first, r = _orthogonal(right, basis[:k])
    size = float(np.sqrt(np.sum(r * r)))
    hessenberg, shares = np.zeros((k + most + 1, most)), np.zeros(0)
    goal = np.zeros(most + 1)
    goal[0] = size
    for number in range(most if size > 0 else 0):
        end = k + number + 1
        np.multiply(
            r, 1 / hessenberg[end - 1, number - 1] if number else 1 / size, out=basis[end - 1]
        )
        image, kept = apply(basis[end - 1])
        along[number] = kept
        hessenberg[:end, number], r = _orthogonal(image, basis[:end])
        hessenberg[end, number] = np.sqrt(np.sum(r * r))
        within = hessenberg[k : end + 1, : number + 1]
        shares = np.asarray(np.linalg.lstsq(within, goal[: number + 2])[0])
        left = np.linalg.norm(within @ shares - goal[: number + 2])
        broken = hessenberg[end, number] <= ROUND_OFF * np.linalg.norm(hessenberg[:, number])
        if left <= depth * size or broken:
            break
    count = len(shares)
    explained = hessenberg[: k + count, :count] @ shares
    image = np.einsum("i,ik->k", explained, basis[: k + count])
    return LeastResidual(
        np.einsum("i,ik->k", shares, basis[k : k + count]),
        image + shares[-1] * r if count else image,
        np.einsum("i,ik->k", shares, along[:count]),
        turn @ (first - explained[:k]),
        count,
    )


def _orthogonal(v: Vector, basis: Matrix) -> tuple[Vector, Vector]:
    """Components of a vector along an orthonormal basis, and what is left of it."""
    shares = np.einsum("ik,k->i", basis, v)
    left = v - np.einsum("i,ik->k", shares, basis)
    if np.sum(left * left) < LOST**2 * np.sum(v * v):
        more = np.einsum("ik,k->i", basis, left)
        shares, left = shares + more, left - np.einsum("i,ik->k", more, basis)
    return shares, left


def orthonormal(given: Matrix) -> tuple[Matrix, Matrix]:
    """Orthonormal rows (j, n) that span the same as k given ones, j <= k, and of which
    combinations of those they are (k, j)."""
    sizes, turns = np.linalg.eigh(np.einsum("ik,jk->ij", given, given))
    kept = sizes > ROUND_OFF * np.max(sizes, initial=0.0)
    turn = turns[:, kept] / np.sqrt(sizes[kept])
    return np.einsum("ij,ik->jk", turn, given), turn
