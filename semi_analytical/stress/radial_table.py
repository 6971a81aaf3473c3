"""Table of the radial functions of displacement and stress in a layered body at several depths.

The functions are tabulated in panels over the distance r from a point force. They are smooth. In
the outermost layer they are the contribution of the layers to a half-space of its material, with
image sources at a distance of at least 2h - z (h: thickness of this layer). Below it they are the
whole response, with sources at a distance of at least z. This clearance is the length scale near
the axis. With H_n[f] = 1/2pi int f J_n(alpha r) alpha d alpha, the scalars of `frf/depth.py` and
the angle phi of the observer, seen from the force, isotropy leaves 15 functions: six for pressure
and nine for shear (transforms along and across the wave, rotated to the axes of the scene).
"""

from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np
from scipy.special import j0, j1

from contact_scene.array_types import Array
from semi_analytical.frf.depth import (
    DepthScalars,
    Descent,
    Level,
    PlaneScalars,
    in_plane,
    material_at,
)
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.hankel_points import faded_points, hankel_points
from semi_analytical.influence.radial_panels import (
    coefficients_of,
    interpolated,
    nodes_between,
    panel_edges,
    places_on_panels,
)
from semi_analytical.stress.components import empty_response

# Value of alpha d above which exp(-alpha d) (alpha d)^2 is below 1e-17.
REACH = 48.0

# Order of the Bessel function of each radial function.
ORDERS = (1, 0, 0, 1, 0, 2, 0, 2, 1, 0, 2, 1, 1, 1, 3)
BY_PRESSURE = 6  # number of functions for pressure, which are first


@dataclass(frozen=True)
class DepthTable:
    """Radial functions of displacement and stress at several depths, on 0 <= r <= edges[-1].

    edges         panel bounds [length], shape (panels + 1,), edges[0] = 0
    coefficients  Chebyshev coefficients, shape (levels, panels, NODES, functions)
    """

    edges: Array
    coefficients: Array

    @property
    def sheared(self) -> bool:
        """True if the table includes the responses to shear."""
        return self.coefficients.shape[-1] > BY_PRESSURE

    def at(self, level: int, r: Array) -> Array:
        """Interpolate the radial functions of one depth at distances r, shape (functions, len(r)).

        level  index of the depth in the table
        """
        coefficients = self.coefficients[level]
        values = np.empty((coefficients.shape[2], len(r)))
        for panel, inside, place in places_on_panels(self.edges, r):
            values[:, inside] = interpolated(coefficients[panel], place)
        return values


def clearance(stack: Stack, level: Level) -> float:
    """Return the distance from a depth to the nearest singularity of the tabulated functions
    [length].

    In the outermost layer of thickness h the singularity is an image source at 2h - z. Below this
    layer the singularity is the force at the surface.

    level  depth z with the index of its layer
    """
    if level.layer == 0:
        return 2 * stack.layers[0].thickness - level.depth
    return level.depth


def depth_table(
    stack: Stack, levels: tuple[Level, ...], reach: float, *, sheared: bool = True
) -> DepthTable:
    """Tabulate displacement and stress of a layered body at some depths, up to a distance from the
    force.

    reach    largest distance [length]
    sheared  include the responses to shear
    """
    orders = ORDERS if sheared else ORDERS[:BY_PRESSURE]
    nearest = min(clearance(stack, level) for level in levels)
    edges = panel_edges(min(nearest / 2, reach), reach)
    values = []
    for panel, (low, high) in enumerate(pairwise(edges)):
        died_out = REACH / nearest
        points = faded_points(low, high, died_out) if panel else hankel_points(high, died_out)
        values.append(_transforms(stack, levels, nodes_between(low, high), *points, orders))
    return DepthTable(edges, coefficients_of(np.stack(values, axis=1)))


def _transforms(
    stack: Stack,
    levels: tuple[Level, ...],
    r: Array,
    alpha: Array,
    weight: Array,
    orders: tuple[int, ...],
) -> Array:
    """Compute the Hankel transforms of all radial functions, shape (levels, len(r), functions).

    r              distances from the force [length]
    alpha, weight  wavenumbers and quadrature weights
    orders         order of the Bessel function of each radial function
    """
    descent = Descent(stack, alpha)
    sources = np.stack([_integrands(descent, level)[: len(orders)] for level in levels])
    sources *= alpha * weight / (2 * pi)
    values = np.empty((len(levels), len(r), len(orders)))
    for order, bessel in enumerate(_bessel(np.outer(r, alpha))):
        chosen = [k for k, of in enumerate(orders) if of == order]
        values[:, :, chosen] = np.einsum("ra,lfa->lrf", bessel, sources[:, chosen], optimize=True)
    return values


def _integrands(descent: Descent, level: Level) -> Array:
    fields = descent.remainder(level)
    return integrands(fields, in_plane(fields, material_at(descent.stack, level), descent.alpha))


def _bessel(x: Array) -> tuple[Array, Array, Array, Array]:
    """Compute the Bessel functions J_0 to J_3 of x.

    The recurrence cancels at small x, where the weight alpha d alpha of the integral vanishes.
    """
    first, second = j0(x), j1(x)
    third = 2 * second / x - first
    return first, second, third, 4 * third / x - second


def integrands(fields: DepthScalars, plane: PlaneScalars) -> Array:
    """Compute the integrands of the 15 Hankel transforms of displacement and stress at one depth.

    The shape is (functions, wavenumbers).

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
    """Compute displacement and stress by unit forces; shape (FIELDS, acting tractions, *cos.shape).

    functions  values of all radial functions, or of those for pressure (functions, *cos.shape)
    cos, sin   direction cosines of the observer, seen from the force
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
