"""Table of the radial functions of displacement and stress in a layered body at several depths.

The functions are tabulated in panels over the distance r from a point force. They are smooth. In
the outermost layer they are the contribution of the layers to a half-space of its material, with
image sources at a distance of at least 2h - z (h: thickness of this layer). Below it they are the
whole response, with sources at a distance of at least z. This clearance is the length scale near
the axis. With H_n[f] = 1/2pi int f J_n(alpha r) alpha d alpha, the scalars of `frf/depth.py` and
the angle phi of the observer, seen from the force, isotropy leaves 15 functions: six for pressure
and nine for shear (transforms along and across the wave, rotated to the axes of the scene).
"""

from collections.abc import Iterator
from functools import lru_cache, partial
from math import ceil, hypot, log2, pi

import numpy as np
from scipy.special import j0, j1

from contact_scene.array_types import Array, Field
from semi_analytical.frf.depth import (
    DepthScalars,
    Descent,
    Level,
    PlaneScalars,
    in_plane_stresses,
    material_at,
)
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.layered_cells import MARGIN, cell_integrals
from semi_analytical.influence.radial_table import RadialTable, tabulate
from semi_analytical.stress.components import FIELDS, acting, empty_response, parity

# Levels of the tables in memory, whose work space is some tens of megabytes.
AT_ONCE = 64
# Order of the Bessel function of each radial function.
ORDERS = (1, 0, 0, 1, 0, 2, 0, 2, 1, 0, 2, 1, 1, 1, 3)
BY_PRESSURE = 6  # number of functions for pressure, which are first


def clearance(stack: Stack, level: Level) -> float:
    """Return the distance from a depth on the load axis to the nearest singularity of the response.

    The response of a layered body to a point force is tabulated, and the distance [length] is the
    length scale of the table. In the outermost layer of thickness h the singularity is an image
    source at 2h - z. Below this layer the singularity is the force at the surface.

    stack  layers and base of the body
    level  depth z with the index of its layer
    """
    if level.layer == 0:
        return 2 * stack.layers[0].thickness - level.depth
    return level.depth


@lru_cache(maxsize=1)
def _known_tables(_stack: Stack, _reach: float, _sheared: bool) -> dict[Level, RadialTable]:
    """Return the tables of one body computed so far, by depth; the error estimate uses them again.
    The arguments are the key of the cache."""
    return {}


def depth_tables(
    stack: Stack, levels: tuple[Level, ...], reach: float, *, sheared: bool = True
) -> list[RadialTable]:
    """Compute tables of displacement and stress of a layered body under a point force.

    Each table holds the radial functions of one depth up to a distance from the force. In the
    outermost layer the response of a half-space of its material is excluded.

    stack    layers and base of the body
    levels   depths, each with the index of its layer
    reach    largest distance from the force [length]
    sheared  include the responses to shear
    """
    orders = ORDERS if sheared else ORDERS[:BY_PRESSURE]
    known = _known_tables(stack, reach, sheared)
    if len({*known, *levels}) > AT_ONCE:
        known.clear()
    missing = tuple(level for level in levels if level not in known)
    if missing:
        transforms = partial(_hankel_transforms, stack, missing, orders)
        # No clearance is smaller than the thickness of the outermost layer.
        edges, coefficients = tabulate(transforms, stack.layers[0].thickness, reach)
        known.update(zip(missing, (RadialTable(edges, one) for one in coefficients), strict=True))
    return [known[level] for level in levels]


def _hankel_transforms(
    stack: Stack,
    levels: tuple[Level, ...],
    orders: tuple[int, ...],
    r: Array,
    alpha: Array,
    weight: Array,
) -> Array:
    """Compute the radial functions of displacement and stress under a point force by Hankel
    transforms.

    The functions are integrals over the wavenumber. The shape is (levels, len(r), functions).

    stack          layers and base of the body
    levels         depths, each with the index of its layer
    orders         order of the Bessel function of each radial function
    r              distances from the force [length]
    alpha, weight  wavenumbers and quadrature weights
    """
    descent = Descent(stack, alpha)
    each = [descent.remainder(level) for level in levels]
    planes = [
        in_plane_stresses(one, material_at(stack, at), alpha)
        for one, at in zip(each, levels, strict=True)
    ]
    sources = np.stack(
        [integrands(*pair)[: len(orders)] for pair in zip(each, planes, strict=True)]
    )
    sources *= alpha * weight / (2 * pi)
    values = np.empty((len(levels), len(r), len(orders)))
    for order, bessel in enumerate(_bessel_functions(np.outer(r, alpha))):
        chosen = [k for k, of in enumerate(orders) if of == order]
        values[:, :, chosen] = np.einsum("ra,lfa->lrf", bessel, sources[:, chosen], optimize=True)
    return values


def _bessel_functions(x: Array) -> tuple[Array, Array, Array, Array]:
    """Compute J_0 to J_3.
    The recurrence cancels at small x, where the weight of the Hankel transform vanishes."""
    first, second = j0(x), j1(x)
    third = 2 * second / x - first
    return first, second, third, 4 * third / x - second


def integrands(fields: DepthScalars, plane: PlaneScalars) -> Array:
    """Compute the integrands of the 15 Hankel transforms of displacement and stress at one depth.

    The transforms yield the radial functions of the response to a point force. The shape is
    (functions, wavenumbers).

    fields  displacement and traction at the depth, in Fourier space
    plane   stress in the horizontal plane at the depth, in Fourier space
    """
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
    """Convert radial functions to displacement and stress by unit forces in scene axes.

    The result (9, tractions, *cos.shape) has 3 displacements and 6 stresses by each force
    component.

    functions  values of all radial functions, or of those for pressure (functions, *cos.shape)
    cos, sin   direction cosines of the vector from the force to the observed point
    """
    ur_p, uz_p, n_p, s_p, mean_p, half_p, *by_shear = functions
    cos2, sin2 = (cos - sin) * (cos + sin), 2 * cos * sin
    result = empty_response(cos.shape, sheared=bool(by_shear))
    by_p = result[:, -1]

    by_p[0], by_p[1], by_p[2] = -cos * ur_p, -sin * ur_p, uz_p
    by_p[3], by_p[4], by_p[5] = mean_p - cos2 * half_p, mean_p + cos2 * half_p, -n_p
    by_p[6], by_p[7], by_p[8] = sin * s_p, cos * s_p, -sin2 * half_p

    if not by_shear:
        return result
    u_mean, u_twist, uz, t_mean, t_twist, n, mean, once, thrice = by_shear
    cos3, sin3 = cos * (cos2 - 2 * sin * sin), sin * (cos2 + 2 * cos * cos)
    by_x, by_y = result[:, 0], result[:, 1]
    along, across = cos2 * u_twist, -sin2 * u_twist
    by_x[0], by_x[1], by_x[2] = u_mean - along, across, cos * uz
    by_y[0], by_y[1], by_y[2] = across, u_mean + along, sin * uz

    # Half the difference of the normal stresses xx and yy, and the stress xy.
    turn_x, slide_x = cos * once - cos3 * thrice, sin * once - sin3 * thrice
    turn_y, slide_y = -sin * once - sin3 * thrice, cos * once + cos3 * thrice
    by_x[3], by_x[4], by_x[5] = cos * mean + turn_x, cos * mean - turn_x, -cos * n
    by_y[3], by_y[4], by_y[5] = sin * mean + turn_y, sin * mean - turn_y, -sin * n
    along, across = cos2 * t_twist, sin2 * t_twist
    by_x[6], by_x[7], by_x[8] = across, along - t_mean, slide_x
    by_y[6], by_y[7], by_y[8] = -along - t_mean, across, slide_y
    return result


def layered_coefficients(
    stack: Stack,
    levels: tuple[Level, ...],
    spacing: tuple[float, float],
    shape: tuple[int, int],
    *,
    sheared: bool,
) -> Iterator[Field]:
    """Yield displacement and stress of a layered body by unit tractions on a cell, by depth.

    Displacements [length^3/force] and stresses [1] are those at all cell offsets >= 0. At a depth
    in the outermost layer, the response of a half-space of its material is excluded.

    stack    layers and base of the body
    levels   depths, each with the index of its layer
    spacing  cell sides [length]
    shape    number of offsets nx, ny along x and y, including zero
    sheared  include the responses to the shear components, before those to pressure
    yields   shape (9, tractions, nx, ny): 3 displacements and 6 stresses, by each traction
             component
    """
    reach = hypot(*((n + MARGIN) * d for n, d in zip(shape, spacing, strict=True)))
    thickness = stack.layers[0].thickness  # windows of similar size share their tables
    reach = thickness * 2.0 ** ceil(log2(reach / thickness))
    parities = [parity(field, traction) for field in FIELDS for traction in acting(sheared)]
    for start in range(0, len(levels), AT_ONCE):
        batch = levels[start : start + AT_ONCE]
        for level, table in zip(
            batch, depth_tables(stack, batch, reach, sheared=sheared), strict=True
        ):
            response = partial(_point_response, table)
            distance = clearance(stack, level)
            result = cell_integrals(response, parities, spacing, shape, distance)
            yield result.reshape(len(FIELDS), -1, *shape)


def _point_response(table: RadialTable, x: Field, y: Field) -> Field:
    """Compute 3 displacements and 6 stresses at points of one depth (9 times tractions, *x.shape),
    by each unit force at the origin of the surface."""
    r = np.hypot(x, y)
    away = np.where(r > 0, r, 1.0)  # on the axis functions of the direction vanish
    functions = table(r.ravel()).reshape(-1, *x.shape)
    found = in_scene_axes(functions, np.where(r > 0, x / away, 1.0), y / away)
    return found.reshape(-1, *x.shape)
