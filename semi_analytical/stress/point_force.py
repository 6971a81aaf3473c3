"""Stress in a half-space under point forces on its surface (Boussinesq 1885, Cerruti 1882).

The formulas are derivatives of the potentials of `rectangle.py` at a point, contracted with the
force.
"""

from math import pi

import numpy as np

from contact_scene.array_types import Field


def stress_by_force(x: Field, y: Field, depth: float, nu: float, force: Field) -> Field:
    """Compute the stress, times an area, in a half-space under point forces on its surface (6, …).

    The forces are tractions times area. Points of action are excluded. The components have the
    order xx, yy, zz, yz, xz, xy.

    x, y   vector from each force to the observed point (…), not both zero at depth zero [length]
    depth  depth z >= 0 of the observed points [length]
    nu     Poisson's ratio
    force  (q_x, q_y, p) times area, shape (3, …)
    """
    q_x, q_y, p = force / (2 * pi)
    sheared = bool(q_x.any() or q_y.any())
    if depth == 0:
        return _stress_at_surface(x, y, nu, (q_x, q_y, p), sheared)
    z, rho = depth, np.sqrt(x * x + y * y + depth * depth)
    near, deep = 1 / rho, 1 / (rho + z)
    cubed = near * near * near
    fifth, deep_squared = cubed * near * near, deep * deep
    once = (2 * rho + z) * cubed * deep_squared
    # Normal force.
    g = 1 - 2 * nu
    even, square = g * p * (z * cubed - near * deep), p * (g * once - 3 * z * fifth)
    through = -3 * z * z * p * fifth
    if not sheared:
        normal = [even + x * x * square, even + y * y * square, z * through]
        return np.stack([*normal, y * through, x * through, x * y * square])
    # Shear: z B_xxx + 2 nu C_xxx, and their components in rotated axes.
    along = q_x * x + q_y * y
    c_cubed = (3 * rho + z) * cubed * deep_squared * deep
    b_cubed = (8 * rho * rho + 9 * rho * z + 3 * z * z) * fifth * deep_squared * deep
    bend = 2 * nu * near * deep_squared + z * once
    square = square - along * (2 * nu * c_cubed + z * b_cubed)
    even = even + along * (bend - 2 * nu * cubed)
    straight = 2 * (bend - cubed)
    through = through - 3 * z * along * fifth
    return np.stack(
        [
            even + x * x * square + x * q_x * straight,
            even + y * y * square + y * q_y * straight,
            z * through,
            y * through,
            x * through,
            x * y * square + (y * q_x + x * q_y) * straight / 2,
        ]
    )


def _stress_at_surface(
    x: Field, y: Field, nu: float, force: tuple[Field, Field, Field], sheared: bool
) -> Field:
    """Compute the stress, times an area, on the surface of a half-space under point forces (6, …).

    Only the components xx, yy and xy are not zero. Used for depth zero, where the formulas are
    shorter.

    x, y     vector from each force to the observed point (…) [length]
    nu       Poisson's ratio
    force    (q_x, q_y, p) as traction times area, divided by 2π
    sheared  True if q_x or q_y is not zero
    """
    q_x, q_y, p = force
    g = 1 - 2 * nu
    near = 1 / (x * x + y * y)
    even = g * near * p
    square = 2 * even * near
    stress = np.zeros((6, *even.shape))
    if sheared:
        root = near * np.sqrt(near)
        square -= 6 * nu * root * (q_x * x + q_y * y) * near
        straight = -2 * g * root
        stress[0], stress[1] = x * q_x * straight, y * q_y * straight
        stress[5] = (y * q_x + x * q_y) * straight / 2
    stress[0] += x * x * square - even
    stress[1] += y * y * square - even
    stress[5] += x * y * square
    return stress
