"""Fields at depth by point forces on a layered body: the radial functions they are made of.

With H_n[f] = 1/2pi int f J_n(alpha r) alpha d alpha, the scalars of `frf/depth.py` and the cosine
and sine of the angle phi of the observer, seen from the force, isotropy leaves 15 functions: six
under pressure, nine under shear: its waves along and across, turned into the axes of the scene.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.depth import DepthScalars, PlaneScalars
from semi_analytical.stress.components import empty_response

Array = NDArray[np.float64]

# Order of the Bessel function of each radial function.
ORDERS = (1, 0, 0, 1, 0, 2, 0, 2, 1, 0, 2, 1, 1, 1, 3)


def integrands(fields: DepthScalars, plane: PlaneScalars) -> Array:
    """What the Hankel transforms are taken of, shape (functions, wavenumbers)."""
    (U_q, U_p), (W_q, W_p) = fields.displacement
    (s_q, s_p), (n_q, n_p) = fields.traction
    T, t = fields.transverse_displacement, fields.transverse_traction
    mean_q, mean_p = (plane.along + plane.across) / 2
    half_q, half_p = (plane.along - plane.across) / 2
    return np.stack(
        [
            *(U_p, W_p, n_p, s_p, mean_p, half_p),
            *((U_q + T) / 2, (U_q - T) / 2, W_q),
            *((s_q + t) / 2, (s_q - t) / 2, n_q, mean_q),
            *((half_q - plane.shear) / 2, (half_q + plane.shear) / 2),
        ]
    )


def in_scene_axes(functions: Array, cos: Array, sin: Array) -> Array:
    """Fields by unit forces along x, y and z, shape (FIELDS, TRACTIONS, *cos.shape).

    functions  values of the radial functions, shape (functions, *cos.shape)
    cos, sin   of phi
    """
    ur_p, uz_p, n_p, s_p, mean_p, half_p, *by_shear = functions
    u_mean, u_twist, uz, t_mean, t_twist, n, mean, once, thrice = by_shear
    cos2, sin2 = (cos - sin) * (cos + sin), 2 * cos * sin
    cos3, sin3 = cos * (cos2 - 2 * sin * sin), sin * (cos2 + 2 * cos * cos)
    result = empty_response(cos.shape)
    by_x, by_y, by_p = result[:, 0], result[:, 1], result[:, 2]

    by_p[0], by_p[1], by_p[2] = -cos * ur_p, -sin * ur_p, uz_p
    by_p[3], by_p[4], by_p[5] = mean_p - cos2 * half_p, mean_p + cos2 * half_p, -n_p
    by_p[6], by_p[7], by_p[8] = sin * s_p, cos * s_p, -sin2 * half_p

    along, across = cos2 * u_twist, -sin2 * u_twist
    by_x[0], by_x[1], by_x[2] = u_mean - along, across, cos * uz
    by_y[0], by_y[1], by_y[2] = across, u_mean + along, sin * uz

    # Half the difference of the normal stresses, and xy.
    turn_x, slide_x = cos * once - cos3 * thrice, sin * once - sin3 * thrice
    turn_y, slide_y = -sin * once - sin3 * thrice, cos * once + cos3 * thrice
    by_x[3], by_x[4], by_x[5] = cos * mean + turn_x, cos * mean - turn_x, -cos * n
    by_y[3], by_y[4], by_y[5] = sin * mean + turn_y, sin * mean - turn_y, -sin * n
    along, across = cos2 * t_twist, sin2 * t_twist
    by_x[6], by_x[7], by_x[8] = across, along - t_mean, slide_x
    by_y[6], by_y[7], by_y[8] = -along - t_mean, across, slide_y
    return result
