"""A law that every surface FRF obeys, and its worst violation over random bodies."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

SEED = 20_240_511
DRAWS = 200
# Rounding of one evaluation, relative to the largest entry: the FRFs are right to about 1e-15.
ROUNDING = 1e-14


@dataclass(frozen=True)
class Law:
    """A law and how it is measured.

    name       for verdicts
    number     in the list of properties, P1 to P20
    statement  what holds, in words
    violation  by how much it fails on one random body, 0 if it holds
    allowed    what rounding, or the law's own next order, may leave
    draws      random bodies it is tried on
    """

    name: str
    number: str
    statement: str
    violation: Callable[[Generator], float]
    allowed: float = ROUNDING
    draws: int = DRAWS


def worst_violation(law: Law) -> float:
    """Largest violation over random bodies, the same ones every time; NaN wins."""
    rng = np.random.default_rng([SEED, *law.name.encode()])
    return float(np.max([law.violation(rng) for _ in range(law.draws)]))


def apart(F: NDArray[np.complex128], expected: NDArray[np.complex128]) -> float:
    """Largest difference over the largest entry."""
    return float(np.abs(F - expected).max() / np.abs(expected).max())


def deficit(larger: NDArray[np.complex128], smaller: NDArray[np.complex128]) -> float:
    """By how much larger - smaller fails to be positive semidefinite (Loewner order)."""
    least = float(np.linalg.eigvalsh(larger - smaller).min())
    return max(0.0, -least / float(np.abs(larger).max()))
