"""Displacement and traction at depth in a layered body, per unit traction on its surface.

All quantities are Fourier amplitudes at one wavenumber alpha. The material below a horizontal plane
acts through the compliance C of the plane, which the compound recursion yields without
cancellation. The traction at the plane is tau = M^-1 tau_0, with tau_0 at the surface and M of the
material between. The determinant of M is the divisor of the recursion. The displacement at the
plane is C tau. All exponentials decay, and nu = 1/2 is regular. Signs and frame: CONVENTIONS.md.
Equilibrium and Hooke's law along z, with W = u_z, read

    U' = -tau_s/G - alpha W                tau_s' = -2G/(1-nu) alpha^2 U - nu/(1-nu) alpha tau_z
    W' = -(1-2nu)/(2G(1-nu)) tau_z + nu/(1-nu) alpha U                     tau_z' = alpha tau_s
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Array
from semi_analytical.frf.compound import OPAQUE, compound_rows, decaying_waves
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import (
    Compliance,
    compliance_above,
    compliances_below,
    remainder_scalars,
)


class DepthScalars(NamedTuple):
    """Displacement and traction at one depth of a layered body, per unit surface traction.

    All values are real Fourier amplitudes as functions of the wavenumber. The displacement and
    traction along the wave vector are u_s = iU and t_s = iQ. The traction at depth is tau =
    -(sigma_sz / i, sigma_zz). The first axis of a matrix is the component of the displacement or
    traction at depth (along the wave vector, normal). The second axis is the surface traction (Q,
    p).

    displacement             (U, u_z), shape (2, 2, wavenumbers) [length^3/force]
    traction                 (tau_s, tau_z), shape (2, 2, wavenumbers) [1]
    transverse_displacement  u_t by the transverse traction t_t (wavenumbers,)
    transverse_traction      -sigma_tz by the transverse traction t_t (wavenumbers,)
    """

    displacement: Array
    traction: Array
    transverse_displacement: Array
    transverse_traction: Array


class PlaneScalars(NamedTuple):
    """Fourier amplitudes of the stresses in a horizontal plane, per unit surface traction.

    The axes are s along the wave vector and t across it. The surface tractions are Q along the wave
    vector, t_t across it, and the pressure p.

    along   sigma_ss by (Q, p), shape (2, wavenumbers)
    across  sigma_tt by (Q, p), shape (2, wavenumbers)
    shear   sigma_st / i by the transverse traction t_t, shape (wavenumbers,)
    """

    along: Array
    across: Array
    shear: Array


@dataclass(frozen=True)
class Level:
    """Depth in a body with the index of its layer, because an interface belongs to two layers.

    depth  depth below the surface [length]
    layer  index of the layer from the surface; the number of layers denotes the base
    """

    depth: float
    layer: int


class Descent:
    """Displacement and traction at the depths of a layered body by unit surface tractions.

    The tractions are propagated from the surface downwards, for fixed wavenumbers.

    stack  layers and base of the body
    alpha  wavenumbers [1/length], > 0, shape (wavenumbers,)
    """

    def __init__(self, stack: Stack, alpha: Array) -> None:
        self.stack = stack
        self.alpha = alpha
        self._tops = np.cumsum([0.0, *(film.thickness for film in stack.layers)])
        self._below = compliances_below(stack, alpha)
        unit, zero = np.ones_like(alpha), np.zeros_like(alpha)
        self._traction = [np.array([[unit, zero], [zero, unit]])]
        self._transverse = [unit]
        for k, film in enumerate(stack.layers):
            through, across = _transmit_traction(
                self._below[k], film.poisson_ratio, alpha * film.thickness
            )
            self._traction.append(_multiply_matrices(through, self._traction[k]))
            self._transverse.append(across * self._transverse[k])

    def at(self, level: Level) -> DepthScalars:
        """Compute displacement and traction at one depth per unit surface traction, as Fourier
        amplitudes.

        level  depth with the index of its layer; not inside a rigid base
        """
        k = level.layer
        G, nu = material_at(self.stack, level)
        below = self._below[k]
        crossed = level.depth - self._tops[k]
        if k < len(self.stack.layers):
            # The difference of depths would cancel for a thin layer.
            thickness = self.stack.layers[k].thickness
            if level.depth >= self._tops[k + 1]:
                crossed = thickness
            left = max(0.0, thickness - crossed)
            below = compliance_above(below, nu, self.alpha * left)
        through, across = _transmit_traction(below, nu, self.alpha * crossed)
        traction = _multiply_matrices(through, self._traction[k])
        transverse = across * self._transverse[k]
        _, c11, c12, c22, _ = below.rows
        unit = 1 / (2 * G * self.alpha)
        displacement = unit * _multiply_matrices(np.array([[c11, c12], [c12, c22]]), traction)
        return DepthScalars(displacement, traction, 2 * unit * below.shear * transverse, transverse)

    @cached_property
    def _surface_remainder(self) -> tuple[Array, ...]:
        """Surface compliances of the body minus those of a half-space of its outermost material,
        times 2 G alpha with its shear modulus G."""
        unit = 2 * self.stack.outer.shear_modulus * self.alpha
        return tuple(unit * c for c in remainder_scalars(self.stack, self.alpha))

    def remainder(self, level: Level) -> DepthScalars:
        """Compute displacement and traction at one depth; in the outermost layer minus those of a
        half-space.

        The half-space has the material of the outermost layer of thickness h. The difference has no
        surface traction, and its surface displacement is computed without cancellation. The
        difference grows with depth z as exp(-alpha (2h - z)) and is exactly zero without layers.
        For alpha h > 300, exp(alpha z) may overflow.

        level  depth with the index of its layer
        """
        if level.layer > 0:
            return self.at(level)
        G, nu = self.stack.outer
        c11, c12, c22, csh = self._surface_remainder
        unit, x = 2 * G * self.alpha, self.alpha * level.depth
        e = 1 / (2 * (1 - nu))
        ch, sh = np.cosh(x), np.sinh(x)
        f, k = e * x * sh, e * _x_cosh_minus_sinh(x)
        to_displacement = np.array([[ch + f, -sh - k], [(2 * e - 1) * sh + k, ch - f]])
        to_traction = np.array([[-2 * e * sh - k, f], [-f, k]])
        start = np.array([[c11, c12], [c12, c22]])
        return DepthScalars(
            _multiply_matrices(to_displacement, start) / unit,
            _multiply_matrices(to_traction, start),
            csh / unit * ch,
            -csh / 2 * sh,
        )


def material_at(stack: Stack, level: Level) -> HalfSpace:
    """Return the elastic constants of the material at one depth of a layered body.

    stack  layers and base of the body
    level  depth with the index of its layer

    Raises ValueError in a rigid base, which has no stress.
    """
    if level.layer < len(stack.layers):
        film = stack.layers[level.layer]
        return HalfSpace(film.shear_modulus, film.poisson_ratio)
    if stack.base is None:
        raise ValueError("the level is in the rigid base, which has no fields. Use a level above")
    return stack.base


def in_plane_stresses(fields: DepthScalars, material: HalfSpace, alpha: Array) -> PlaneScalars:
    """Compute the stresses in a horizontal plane by Hooke's law, as Fourier amplitudes.

    Poisson's ratio may be 1/2.

    fields    displacement and traction at the depth
    material  elastic constants at the depth
    alpha     wavenumbers [1/length]
    """
    G, nu = material
    stretch = 2 * G * alpha * fields.displacement[0]
    squeeze = fields.traction[1]
    return PlaneScalars(
        -(stretch + nu * squeeze) / (1 - nu),
        -nu / (1 - nu) * (stretch + squeeze),
        G * alpha * fields.transverse_displacement,
    )


def _transmit_traction(below: Compliance, nu: float, x: Array) -> tuple[Array, Array]:
    """Compute the traction at a depth per unit traction at a smaller depth in one material.

    The results are Fourier amplitudes: the matrix (2, 2, wavenumbers) of the components along the
    wave vector and normal, and the factor of the transverse component (wavenumbers,). The traction
    above is M times that below; the matrix is the inverse of M.

    below  compliance of the material below the larger depth
    nu     Poisson's ratio
    x      wavenumber times the distance between the depths (wavenumbers,)
    """
    x = np.minimum(x, OPAQUE)
    decay, w = np.exp(-x), np.exp(-2 * x)
    e = 1 / (2 * (1 - nu))
    g = 1 - e
    ch, sh = (1 + w) / 2, -np.expm1(-2 * x) / 2
    f, k = e * x * sh, e * _x_cosh_minus_sinh(x, decay)
    _, c11, c12, c22, _ = below.rows
    pull = e * (x * ch + sh)
    m11 = pull * c11 + f * c12 + ch + f
    m12 = pull * c12 + f * c22 + e * x * ch - g * sh
    m21 = -f * c11 - k * c12 - e * x * ch - g * sh
    m22 = -f * c12 - k * c22 + ch - f
    divisor = compound_rows(below.rows, nu, decaying_waves(x))[4]
    sagittal = decay / divisor * np.array([[m22, -m12], [-m21, m11]])
    return sagittal, decay / (ch + sh * below.shear)


def _x_cosh_minus_sinh(x: Array, scale: Array | float = 1.0) -> Array:
    """Compute (x cosh x - sinh x) * scale, by series for x < 1, where the two terms nearly cancel.

    Used for the propagation of tractions through a layer.

    x      wavenumber times the distance
    scale  exp(-x) to keep the result bounded, or 1
    """
    series = np.zeros_like(x)
    small = np.minimum(x, 1.0)
    for n in range(9, 0, -1):
        series = (2 * n + series) * small * small / ((2 * n) * (2 * n + 1))
    if isinstance(scale, float):
        direct = x * np.cosh(x) - np.sinh(x)
    else:
        direct = (x * (1 + scale**2) + np.expm1(-2 * x)) / 2
    return np.where(x < 1, series * small * scale, direct)


def _multiply_matrices(left: Array, right: Array) -> Array:
    """Multiply matrices (i, j, wavenumbers) at each wavenumber."""
    result: Array = np.einsum("ijk,jlk->ilk", left, right)
    return result
