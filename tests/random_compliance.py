"""Small dense compliance matrices and preconditioners, for tests of the iterative contact
solvers."""

import numpy as np

from semi_analytical.operator.slip_compliance_bins import COMPLIANCES


def compliance(rng, size: int) -> np.ndarray:
    """A random symmetric positive definite matrix with a decent condition number."""
    B = rng.standard_normal((size, 2 * size))
    return B @ B.T / size + 0.5 * np.eye(size)


def as_map(matrix: np.ndarray):
    """The matrix as a map of fields of any shape."""
    return lambda field: (matrix @ field.ravel()).reshape(field.shape)


def graded_inverse(matrix: np.ndarray):
    """A preconditioner of shears: the inverse of the diagonal, and of its mean where slip is held
    back."""
    diagonal = np.diag(matrix)

    def divided(fields):
        held = np.mean(diagonal) * (1 + COMPLIANCES[:, None, None])
        shear = fields[:2] / diagonal.reshape(fields[:2].shape)
        return np.concatenate([shear, fields[2:] / held[: len(fields) - 2]])

    return divided


def rough_inverse(matrix: np.ndarray):
    """A preconditioner: the inverse of the diagonal."""
    return as_map(np.diag(1 / np.diag(matrix)))
