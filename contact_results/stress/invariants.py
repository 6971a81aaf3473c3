"""Invariants of the stress tensor, whose components (6, …) are xx, yy, zz, yz, xz, xy."""

from itertools import combinations

import numpy as np

from contact_scene.array_types import Field

BLOCK = 1 << 14  # points whose intermediate numbers fit into the cache


def von_mises(stress: Field) -> Field:
    """Compute the equivalent stress of von Mises (1913), shape (…) [force/length^2].

    stress  components xx, yy, zz, yz, xz, xy (6, …) [force/length^2]
    """
    xx, yy, zz, yz, xz, xy = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(normal / 2 + 3 * (yz**2 + xz**2 + xy**2)))


def principal_stresses(stress: Field) -> Field:
    """Compute the principal stresses, most tensile first, shape (3, …) [force/length^2].

    The principal stresses are the roots of the characteristic cubic by its angle θ, cos 3θ =
    (27/4)^½ J3/J2^(3/2), with the invariants J2 and J3 of the deviatoric stress s. The arccosine
    loses half the digits if two roots are nearly equal, as on the axis of every axisymmetric
    contact. Therefore sin 3θ is computed from the discriminant 4 J2³ - 27 J3² as a sum of squares:
    the Gram determinant of 1, s and s² by the formula of Cauchy and Binet (Parlett 2002).

    stress  components xx, yy, zz, yz, xz, xy (6, …) [force/length^2]
    """
    flat = stress.reshape(6, -1)
    found = np.empty((3, flat.shape[1]))
    for first in range(0, flat.shape[1], BLOCK):
        some = slice(first, first + BLOCK)
        found[:, some] = _principal_roots(flat[:, some])
    return found.reshape(3, *stress.shape[1:])


def _principal_roots(stress: Field) -> Field:
    """Compute the principal stresses of a block of points, most tensile first (3, n).

    stress  components xx, yy, zz, yz, xz, xy (6, n) [force/length^2]
    """
    xx, yy, zz, yz, xz, xy = stress
    mean = (xx + yy + zz) / 3
    a, b, c = xx - mean, yy - mean, zz - mean
    second = (a * a + b * b + c * c) / 2 + yz * yz + xz * xz + xy * xy
    third = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)
    normal, shear = (a, b, c), (yz, xz, xy)
    normal_2 = (a * a + xy * xy + xz * xz, xy * xy + b * b + yz * yz, xz * xz + yz * yz + c * c)
    shear_2 = (xy * xz - yz * a, xy * yz - xz * b, xz * yz - xy * c)
    discriminant = (
        (b - a) * (normal_2[2] - normal_2[0]) - (c - a) * (normal_2[1] - normal_2[0])
    ) ** 2
    for i, j in combinations(range(3), 2):
        rise, rise_2 = normal[j] - normal[i], normal_2[j] - normal_2[i]
        for s, s_2 in zip(shear, shear_2, strict=True):
            discriminant += 2 * (rise * s_2 - rise_2 * s) ** 2
        discriminant += 12 * (shear[i] * shear_2[j] - shear[j] * shear_2[i]) ** 2
    angle = np.arctan2(np.sqrt(discriminant), np.sqrt(27) * third) / 3
    shifts = 2 * np.pi / 3 * np.array([[0], [-1], [1]])
    return np.asarray(mean + 2 * np.sqrt(second / 3) * np.cos(angle + shifts))
