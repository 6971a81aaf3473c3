"""Stress in a half-space under point forces on its surface.

Boussinesq and Cerruti: derivatives of the potentials of `rectangle.py` at a point, contracted with
the force.
"""

from math import pi

import numpy as np

from contact_scene.array_types import Field


def stress_by_force(x: Field, y: Field, depth: float, nu: float, force: Field) -> Field:
    """Stress (6, …) times an area, in the order of CONVENTIONS.md, without what acts at the point
    alone.

    x, y   observer minus force (…), not both zero at depth zero [length]
    depth  z >= 0 [length]
    nu     Poisson's ratio
    force  (q_x, q_y, p), shape (3, …)
    """
    q_x, q_y, p = force / (2 * pi)
    if depth == 0:
        return _at_surface(x, y, nu, q_x, q_y, p)
    z, rho = depth, np.sqrt(x * x + y * y + depth * depth)
    near, deep = 1 / rho, 1 / (rho + z)
    cubed = near * near * near
    fifth, deep_squared = cubed * near * near, deep * deep
    once = (2 * rho + z) * cubed * deep_squared
    along = q_x * x + q_y * y
    # Normal force.
    g = 1 - 2 * nu
    even, square = g * p * (z * cubed - near * deep), p * (g * once - 3 * z * fifth)
    # Shear: z B_xxx + 2 nu C_xxx and what turning the axes makes of them.
    c_cubed = (3 * rho + z) * cubed * deep_squared * deep
    b_cubed = (8 * rho * rho + 9 * rho * z + 3 * z * z) * fifth * deep_squared * deep
    bend = 2 * nu * near * deep_squared + z * once
    square = square - along * (2 * nu * c_cubed + z * b_cubed)
    even = even + along * (bend - 2 * nu * cubed)
    straight = 2 * (bend - cubed)
    through = -3 * z * (along + z * p) * fifth
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


def _at_surface(x: Field, y: Field, nu: float, q_x: Field, q_y: Field, p: Field) -> Field:
    """The same at depth zero, where xx, yy and xy are left."""
    g = 1 - 2 * nu
    near = 1 / (x * x + y * y)
    root = np.sqrt(near)
    even, straight = g * near * p, -2 * g * near * root
    square = (2 * even - 6 * nu * near * root * (q_x * x + q_y * y)) * near
    stress = np.zeros((6, *even.shape))
    stress[0] = x * x * square - even + x * q_x * straight
    stress[1] = y * y * square - even + y * q_y * straight
    stress[5] = x * y * square + (y * q_x + x * q_y) * straight / 2
    return stress
