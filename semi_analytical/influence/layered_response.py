"""Surface displacement of a layered body at a point by unit forces at the origin.

The response is that of a half-space of the outermost material plus a remainder by the layers. With
the difference of the two surface FRFs (frequency response functions, functions of the wavenumber
alpha) the remainder is

    zz    K0 = 1/2pi  int  C22 J0(alpha r) alpha d alpha,
    mean  P  = 1/4pi  int (C11 + Csh) J0(alpha r) alpha d alpha,
    twist Q  = 1/4pi  int (C11 - Csh) J2(alpha r) alpha d alpha,
    cross C  = 1/2pi  int  C12 J1(alpha r) alpha d alpha,

with u_z = K0 p, u_x = (P - cos 2phi Q) q_x - sin 2phi Q q_y, u_z = cos phi C q_x. (r, phi) are the
polar coordinates of the point.
"""

from math import pi

import numpy as np
from scipy.special import j0, j1

from contact_scene.array_types import Array, Field
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import remainder_scalars
from semi_analytical.influence.radial_table import RadialTable, tabulate


def remainder_table(stack: Stack, reach: float) -> RadialTable:
    """Tabulate the displacement under a point force that layers add to a half-space.

    The table holds four functions of the distance from the force: zz (normal displacement by a
    normal force), mean and twist (tangential by tangential), cross (normal by tangential). Their
    nearest singularity is the image of the force in the first interface, at twice the thickness of
    the outermost layer.

    stack  layers and base of the body
    reach  largest distance from the force [length]
    """

    def transforms(r: Array, alpha: Array, weight: Array) -> Array:
        c11, c12, c22, csh = alpha * weight / (4 * pi) * remainder_scalars(stack, alpha)
        phase = np.outer(r, alpha)
        bessel0, bessel1 = j0(phase), j1(phase)
        bessel2 = 2 * bessel1 / phase - bessel0
        zz, mean = bessel0 @ (2 * c22), bessel0 @ (c11 + csh)
        return np.stack([zz, mean, bessel2 @ (c11 - csh), bessel1 @ (2 * c12)], axis=1)

    return RadialTable(*tabulate(transforms, 2 * stack.layers[0].thickness, reach))


def half_space_response(material: HalfSpace) -> Array:
    """Return the surface displacement of a half-space under a point force, times the distance (4,).

    The displacement has four radial functions: zz (normal by a normal force), mean and twist
    (tangential by tangential), cross (normal by tangential). Their products with the distance are
    constants.

    material  shear modulus G and Poisson's ratio
    """
    G, nu = material
    return np.array([2 - 2 * nu, 2 - nu, -nu, 1 - 2 * nu]) / (4 * pi * G)


def point_response(
    component: str, remainder: RadialTable, half_space: Array, x: Field, y: Field
) -> Field:
    """Compute one component of the displacement at (x, y) by a unit force at the origin.

    The result has the shape (1, *x.shape) and the dimension [length/force]. At the origin the
    displacement of the half-space is not defined; a finite number is returned.

    component   displacement and force, e.g. "zx"
    remainder   table of the displacement that the layers add to a half-space
    half_space  r times the response of the half-space (4,); zeros for the remainder alone
    x, y        coordinates of the points [length]
    """
    r = np.hypot(x, y)
    away = np.where(r > 0, r, 1.0)
    cos, sin = np.where(r > 0, x / away, 1.0), y / away
    functions = remainder(r.ravel()) + half_space[:, None] / away.ravel()
    zz, mean, twist, cross = functions.reshape(4, *r.shape)
    along = (cos - sin) * (cos + sin) * twist
    found = {
        "zz": zz,
        "xx": mean - along,
        "yy": mean + along,
        "xy": -2 * cos * sin * twist,
        "zx": cos * cross,
        "zy": sin * cross,
    }
    return found[component][None]
