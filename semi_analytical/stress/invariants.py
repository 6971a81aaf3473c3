"""Invariants of the stress tensor, components in the order of CONVENTIONS.md."""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

XX, YY, ZZ, YZ, XZ, XY = range(6)


def von_mises(stress: Field, axis: int = 0) -> Field:
    """Equivalent stress of von Mises (1913), the axis of components removed.

    stress  six components along `axis` [force/length^2]
    """
    s = np.moveaxis(stress, axis, 0)
    normal = (s[XX] - s[YY]) ** 2 + (s[YY] - s[ZZ]) ** 2 + (s[ZZ] - s[XX]) ** 2
    shear = s[YZ] ** 2 + s[XZ] ** 2 + s[XY] ** 2
    return np.asarray(np.sqrt(normal / 2 + 3 * shear))


def principal_stresses(stress: Field, axis: int = 0) -> Field:
    """Principal stresses, largest (most tensile) first, along the same axis, three of them.

    By the eigenvalues of a symmetric matrix, not by the cubic's cosine: that loses half the digits
    where two of them are nearly equal, as they are on the axis of every axisymmetric contact.
    """
    s = np.moveaxis(stress, axis, 0)
    rows = [[s[XX], s[XY], s[XZ]], [s[XY], s[YY], s[YZ]], [s[XZ], s[YZ], s[ZZ]]]
    tensor = np.moveaxis(np.array(rows), (0, 1), (-2, -1))
    ascending = np.linalg.eigvalsh(tensor)
    return np.moveaxis(ascending[..., ::-1], -1, axis)


def greatest_shear(stress: Field, axis: int = 0) -> Field:
    """Half the difference of the extreme principal stresses (Tresca), the axis removed."""
    principal = np.moveaxis(principal_stresses(stress, axis), axis, 0)
    return np.asarray((principal[0] - principal[2]) / 2)
