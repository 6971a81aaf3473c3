"""Surface compliance of a layered body as a function of the wavenumber alpha = |(m, n)|.

Isotropy reduces the compliance to four functions. In the frame along the wave vector the traction
(t_s, p) causes the displacement (u_s, u_z) by [[C11, i C12], [-i C12, C22]]. The transverse
traction causes the transverse displacement by Csh. For signs see CONVENTIONS.md.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from contact_scene.array_types import Array
from semi_analytical.frf.compound import (
    OPAQUE,
    compound_rows,
    decaying_waves,
    echo_waves,
)
from semi_analytical.frf.stack import HalfSpace, Stack


class Compliance(NamedTuple):
    """Compliance (displacement per traction) of the material below a horizontal plane of a body.

    The compliance is a function of the wavenumber alpha. G is the shear modulus of the material to
    which the plane is assigned, above or below the plane.

    rows   (det C, C11, C12, C22, 1) of the compliance C along the wave vector and z, in units of
           1/(2 G alpha)
    shear  transverse compliance in units of 1/(G alpha)
    """

    rows: tuple[Array, ...]
    shear: Array


class SurfaceScalars(NamedTuple):
    """Surface compliance of a body at given wavenumbers [length^3/force], as four functions.

    Each array has the shape of the wavenumbers.

    c11  displacement along the wave vector by traction along the wave vector
    c12  coupling between normal and tangential components
    c22  normal displacement by pressure
    csh  transverse displacement by transverse traction
    """

    c11: Array
    c12: Array
    c22: Array
    csh: Array


def half_space_scalars(material: HalfSpace, alpha: ArrayLike) -> SurfaceScalars:
    """Compute the surface compliance of a homogeneous half-space at given wavenumbers.

    The compliances are the transforms of the Boussinesq and Cerruti solutions (Johnson 1985,
    section 3.2).

    material  shear modulus and Poisson's ratio
    alpha     wavenumbers [1/length], > 0
    """
    G, nu = material
    unit = 1 / (G * _check_wavenumbers(alpha))
    return SurfaceScalars((1 - nu) * unit, (0.5 - nu) * unit, (1 - nu) * unit, unit)


def scalars(stack: Stack, alpha: ArrayLike) -> SurfaceScalars:
    """Compute the surface compliance of layers on a half-space or rigid base by wavenumber.

    The compound recursion is used. The error is a few units in the last place, for c12 relative to
    sqrt(c11 c22).

    stack  layers and base of the body
    alpha  wavenumbers [1/length], > 0

    Raises ValueError for alpha = 0: the displacement of an infinite body under uniform load is
    unbounded.
    """
    alpha = _check_wavenumbers(alpha)
    if stack.is_rigid:
        return SurfaceScalars(*(np.zeros_like(alpha) for _ in range(4)))
    flat = alpha.reshape(-1)
    below = _compliance_below_layer(stack, flat)
    for film in stack.layers[:1]:
        below = compliance_above(below, film.poisson_ratio, flat * film.thickness)
    (_, c11, c12, c22, _), shear = below
    unit = 1 / (stack.outer.shear_modulus * flat)
    four = (c11 * unit / 2, c12 * unit / 2, c22 * unit / 2, shear * unit)
    return SurfaceScalars(*(value.reshape(alpha.shape) for value in four))


def remainder_scalars(stack: Stack, alpha: ArrayLike) -> SurfaceScalars:
    """Compute the surface compliance minus that of a half-space of the outermost material.

    The differences vanish as exp(-2 alpha h), with the thickness h of the outermost layer, and are
    computed with full relative accuracy. They are exactly zero without layers.

    stack  layers and base of the body
    alpha  wavenumbers [1/length], > 0
    """
    alpha = _check_wavenumbers(alpha)
    if not stack.layers:
        return SurfaceScalars(*(np.zeros_like(alpha) for _ in range(4)))
    flat = alpha.reshape(-1)
    # For thin layers the difference does not cancel, but `_remainder_of_thick_layer` does.
    thin = flat * stack.layers[0].thickness < 0.5
    four = np.empty((4, flat.size))
    full, half_space = scalars(stack, flat[thin]), half_space_scalars(stack.outer, flat[thin])
    four[:, thin] = np.subtract(full, half_space)
    four[:, ~thin] = _remainder_of_thick_layer(stack, flat[~thin])
    return SurfaceScalars(*four.reshape(4, *alpha.shape))


def _remainder_of_thick_layer(stack: Stack, alpha: Array) -> SurfaceScalars:
    """Compute the surface compliance of a body minus that of a half-space, for thick outermost
    layers.

    The half-space has the material of the outermost layer. The parts of an infinitely thick layer
    are omitted from the hyperbolic functions, so that the difference does not cancel.

    stack  layers and base of the body
    alpha  wavenumbers (n,) [1/length]
    """
    film = stack.layers[0]
    x = np.minimum(alpha * film.thickness, OPAQUE)
    below, shear = _compliance_below_layer(stack, alpha)
    divisor = compound_rows(below, film.poisson_ratio, decaying_waves(x))[4]
    _, e11, e12, e22, e_divisor = compound_rows(below, film.poisson_ratio, echo_waves(x))
    direct = 2 * (1 - film.poisson_ratio)
    coupling = 1 - 2 * film.poisson_ratio
    w = np.exp(-2 * x)
    unit = 1 / (film.shear_modulus * alpha)
    half = unit * w / (2 * divisor)
    # 1 - tanh x = 2w/(1+w)
    shear_echo = (shear - 1) * (2 * w / (1 + w)) / (1 + shear * np.tanh(x))
    return SurfaceScalars(
        (e11 - direct * e_divisor) * half,
        (e12 - coupling * e_divisor) * half,
        (e22 - direct * e_divisor) * half,
        shear_echo * unit,
    )


def _compliance_below_layer(stack: Stack, alpha: Array) -> Compliance:
    """Compute the compliance of the material below the outermost layer,
    or of the base without layers, times 2 G alpha with the shear modulus G of this layer."""
    return compliances_below(stack, alpha)[0]


def compliances_below(stack: Stack, alpha: Array) -> list[Compliance]:
    """Compute the compliance of the material below each layer of a body, with its bond.

    A compliant bond adds its opening and its tangential jump to the displacements. The list begins
    with the outermost layer and ends with the base itself. Each compliance is in units of 1/(2 G
    alpha), with the shear modulus G of its layer, for the last one of the base.

    stack  layers and base of the body
    alpha  wavenumbers (n,) [1/length]
    """
    one, zero = np.ones_like(alpha), np.zeros_like(alpha)
    if stack.base is None:
        here, G = Compliance((zero, zero, zero, zero, one), zero), 1.0
    else:
        G, nu = stack.base
        rows = (3 - 4 * nu, 2 - 2 * nu, 1 - 2 * nu, 2 - 2 * nu, 1.0)
        here = Compliance(tuple(row * one for row in rows), one)
    found, upward = [here], stack.layers[::-1]
    for film, lower in zip(upward, (None, *upward), strict=False):
        if lower is not None:
            here = compliance_above(here, lower.poisson_ratio, alpha * lower.thickness)
            G = lower.shear_modulus
        (det, c11, c12, c22, unit), ratio = here.rows, film.shear_modulus / G
        det, c11, c12, c22 = det * ratio**2, c11 * ratio, c12 * ratio, c22 * ratio
        own = 2 * film.shear_modulus * alpha
        opening, jump = own * film.normal_opening, own * film.tangential_jump
        det = det + opening * c11 + jump * c22 + opening * jump
        here = Compliance(
            (det, c11 + jump, c12, c22 + opening, unit), here.shear * ratio + jump / 2
        )
        found.append(here)
    return found[::-1]


def compliance_above(below: Compliance, nu: float, x: Array) -> Compliance:
    """Compute the compliance below a plane from that below a deeper plane in one material.

    below  compliance of the material below the deeper plane
    nu     Poisson's ratio of the material between the planes
    x      wavenumber times the distance of the planes
    """
    x = np.minimum(x, OPAQUE)
    *rows, divisor = compound_rows(below.rows, nu, decaying_waves(x))
    tanh = np.tanh(x)
    return Compliance(
        (*(row / divisor for row in rows), np.ones_like(x)),
        (below.shear + tanh) / (1 + below.shear * tanh),
    )


def _check_wavenumbers(alpha: ArrayLike) -> Array:
    """Raise ValueError unless wavenumbers are positive and finite:
    the compliance at 0 is unbounded."""
    alpha = np.asarray(alpha, dtype=np.float64)
    if not (np.all(alpha > 0) and np.all(np.isfinite(alpha))):
        raise ValueError("wavenumbers must be positive and finite: alpha = 0 has no response")
    return alpha
