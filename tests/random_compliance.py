"""Small dense compliance matrices, preconditioners and loads, for tests of the contact solver."""

import numpy as np

from contact_solver.rigid_motion import RigidMotion, RigidMotions
from contact_solver.slip_compliance_bins import COMPLIANCES


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
        held = np.mean(diagonal) * (1 + COMPLIANCES[:, None])
        shear = fields[:2] / diagonal.reshape(fields[:2].shape)
        return np.concatenate([shear, fields[2:] / held[: len(fields) - 2]])

    return divided


def rough_inverse(matrix: np.ndarray):
    """A preconditioner: the inverse of the diagonal."""
    return as_map(np.diag(1 / np.diag(matrix)))


def pressed(force=None, approach=0.0):
    """The motion of an indenter under a normal force, or at an approach."""
    return RigidMotions(1, (RigidMotion(np.ones((1, 1)), force, approach),))


def pushed(force=None, shift=(0.0, 0.0), turn=None, torque=0.0):
    """The motions of an indenter under a tangential force or at a shift, and under a torque.

    turn  displacement by the unit twist (2, n); without one there is no torque"""
    forces = (None, None) if force is None else force
    units = zip(np.eye(2)[:, :, None], forces, shift, strict=True)
    twist = () if turn is None else (RigidMotion(turn, torque),)
    return RigidMotions(2, (*(RigidMotion(*unit) for unit in units), *twist))
