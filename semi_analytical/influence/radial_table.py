"""Table of the surface displacement by a point force on a layered body, by radial functions.

The point solutions are Hankel transforms of the surface FRF,

    zz    K0 = 1/2pi  int  C22 J0(alpha r) alpha d alpha,
    mean  P  = 1/4pi  int (C11 + Csh) J0(alpha r) alpha d alpha,
    twist Q  = 1/4pi  int (C11 - Csh) J2(alpha r) alpha d alpha,
    cross C  = 1/2pi  int  C12 J1(alpha r) alpha d alpha,

with u_z = K0 p, u_x = (P - cos 2phi Q) q_x - sin 2phi Q q_y, u_z = cos phi C q_x.
The functions fall like 1/r near and far, with different constants. The table contains r times the
functions, which is bounded and smooth in log r for layers of all thicknesses.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np
from scipy.special import j0, j1

from contact_scene.array_types import Array
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import SurfaceScalars, remainder_scalars, scalars
from semi_analytical.influence.hankel_points import faded_points, hankel_points
from semi_analytical.influence.radial_panels import (
    NODES,
    coefficients_of,
    interpolated,
    nodes_between,
    panel_edges,
    places_on_panels,
)

# Wavenumber times thickness beyond which the remainder of the FRF, exp(-2x) x^2, is below 1e-17.
REMAINDER_REACH = 24.0


@dataclass(frozen=True)
class RadialTable:
    """Table of r times the four radial functions (zz, mean, twist, cross) on 0 <= r <= edges[-1].

    The functions yield the surface displacement of a layered body by a point force.

    edges         panel bounds [length], shape (panels + 1,), edges[0] = 0
    coefficients  Chebyshev coefficients, shape (panels, NODES, 4) [length^2/force]
    near          values at r = 0, those of a half-space of the outer material, shape (4,)
    """

    edges: Array
    coefficients: Array
    near: Array

    @property
    def core(self) -> float:
        """Bound of the first panel of the table [length], which contains the point of the force.

        On this panel the response is that of a half-space plus a smooth remainder.
        """
        return float(self.edges[1])

    def remainder(self) -> RadialTable:
        """Return the table minus the response of a half-space of the outer material, valid on
        the first panel."""
        coefficients = self.coefficients.copy()
        coefficients[:, 0] -= self.near
        return RadialTable(self.edges, coefficients, np.zeros(4))

    def __call__(self, r: Array, functions: slice) -> Array:
        """Interpolate some of the radial functions at distances r, shape (len(r), functions).

        functions  slice of the functions
        """
        coefficients = self.coefficients[:, :, functions]
        values = np.empty((len(r), coefficients.shape[2]))
        for panel, inside, place in places_on_panels(self.edges, r):
            values[inside] = interpolated(coefficients[panel], place).T
        return values


def radial_table(stack: Stack, reach: float) -> RadialTable:
    """Compute the table of the point response of a layered body, up to the distance `reach`
    [length].

    On the first panel, half the outermost thickness, the response is that of the half-space plus
    the Hankel transform of the remainder. Beyond, it is the transform of the full FRF (frequency
    response function), which avoids cancellation above a rigid or stiff base.
    """
    near = half_space_response(stack.outer)
    if not stack.layers:
        return RadialTable(np.array([0.0, reach]), _constant(near), near)
    edges = panel_edges(min(stack.layers[0].thickness / 2, reach), reach)
    values = []
    for panel, (low, high) in enumerate(pairwise(edges)):
        r = nodes_between(low, high)
        if panel == 0:
            alpha, weight = hankel_points(high, REMAINDER_REACH / stack.layers[0].thickness)
            values.append(near + _hankel(r, alpha, weight, remainder_scalars(stack, alpha)))
        else:
            alpha, weight = faded_points(low, high)
            values.append(_hankel(r, alpha, weight, scalars(stack, alpha)))
    return RadialTable(edges, coefficients_of(np.stack(values)), near)


def half_space_response(material: HalfSpace) -> Array:
    """Return r times the radial functions (zz, mean, twist, cross) of a homogeneous half-space
    (4,).

    The products are constants. r is the distance from a point force on the surface.
    """
    G, nu = material
    return np.array([2 - 2 * nu, 2 - nu, -nu, 1 - 2 * nu]) / (4 * pi * G)


def _hankel(r: Array, alpha: Array, weight: Array, response: SurfaceScalars) -> Array:
    """Compute r times the Hankel transforms of the four radial functions at distances r (len(r),
    4).

    alpha, weight  wavenumbers and quadrature weights
    response       surface FRF at these wavenumbers
    """
    c11, c12, c22, csh = response
    phase = np.outer(r, alpha)
    bessel0, bessel1 = j0(phase), j1(phase)
    bessel2 = 2 * bessel1 / phase - bessel0
    measure = alpha * weight
    zz = bessel0 @ (measure * c22) / (2 * pi)
    mean = bessel0 @ (measure * (c11 + csh)) / (4 * pi)
    twist = bessel2 @ (measure * (c11 - csh)) / (4 * pi)
    cross = bessel1 @ (measure * c12) / (2 * pi)
    transforms: Array = np.stack([zz, mean, twist, cross], axis=1)
    return r[:, None] * transforms


def _constant(near: Array) -> Array:
    """Return the Chebyshev coefficients (1, NODES, 4) of four constant functions on one panel.

    near  the four constants
    """
    coefficients = np.zeros((1, NODES, 4))
    coefficients[0, 0] = near
    return coefficients
