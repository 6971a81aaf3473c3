"""Invariants of the stress tensor, components (6, …) in the order of CONVENTIONS.md."""

import numpy as np

from contact_scene.array_types import Field


def von_mises(stress: Field) -> Field:
    """Equivalent stress of von Mises (1913), shape (…) [force/length^2]."""
    xx, yy, zz, yz, xz, xy = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(normal / 2 + 3 * (yz**2 + xz**2 + xy**2)))


def principal_stresses(stress: Field) -> Field:
    """Principal stresses, largest (most tensile) first (3, …) [force/length^2].

    By the eigenvalues of a symmetric matrix, not by the cubic's cosine: that loses half the digits
    where two of them are nearly equal, as they are on the axis of every axisymmetric contact.
    """
    xx, yy, zz, yz, xz, xy = stress
    tensor = np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), (0, 1), (-2, -1))
    ascending = np.linalg.eigvalsh(tensor)
    return np.moveaxis(ascending[..., ::-1], -1, 0)
