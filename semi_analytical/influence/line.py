"""Influence coefficients of strips of infinite length with uniform tractions, in plane strain.

A line load along y has the surface response of the wave vectors (m, 0) alone. Per unit load,

    u(x) = 1/pi  int_0^inf C(m) cos(m x) dm         (zz: C22, xx: C11, yy: Csh, antiplane)
    u(x) = 1/pi  int_0^inf C12(m) sin(m x) dm       (zx; the other components are zero)

with the surface compliances of `frf.surface`. The outermost material determines m C for short
waves, the base for long waves. With h the thickness of the outermost layer and t = 2h,

    C = c_outer/m + (c_base - c_outer) exp(-m t)/m + rest.

The first two parts are integrated over the loaded strip in closed form. Their displacement is zero
at the reference length from the load. The rest is bounded at m = 0 and falls like exp(-m t); its
integral over x is tabulated.
"""

from dataclasses import dataclass
from functools import cached_property
from math import log, pi

import numpy as np

from contact_scene.array_types import Array, Field
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import half_space_scalars, remainder_scalars
from semi_analytical.influence.radial_table import RadialTable, tabulate

# Function of `SurfaceScalars` by component, in the order of its fields.
SCALARS = {"xx": 0, "zx": 1, "zz": 2, "yy": 3}
ODD = "zx"


@dataclass(frozen=True)
class StripCoefficients:
    """Influence coefficients of strips on layers with a half-space or a rigid base below.

    The coefficients are surface displacements at the centre of a strip by a unit traction on
    another strip. They are zero for all offsets along y except zero, since a grid of strips has one
    row. Their error is about 1e-8 of the largest coefficient for strips of h/50, and less for wider
    strips.

    stack             body with or without layers
    width             width of a strip [length]
    shape             number of offsets along x and y, including zero
    reference_length  distance from the load at which the surface does not move [length]; without
                      effect on a rigid base
    """

    stack: Stack
    width: float
    shape: tuple[int, int]
    reference_length: float

    def __getitem__(self, component: str) -> Field:
        """Return one component of the influence coefficients at all offsets (nx, ny)
        [length^3/force].

        component  displacement and traction, e.g. "zx" for the normal displacement by the shear q_x
        """
        found = np.zeros(self.shape)
        if component not in SCALARS:
            return found
        own = SCALARS[component]
        stack = self.stack
        outer, base = _long_waves(stack.outer)[own], _long_waves(stack.base)[own]
        borders: Array = np.arange(self.shape[0] + 1, dtype=np.float64) - 0.5
        closed = _odd_part if component == ODD else self._even_part
        total = outer * closed(borders, 0.0)
        if stack.layers:
            depth = 2 * stack.layers[0].thickness
            total += (base - outer) * closed(borders, depth / self.width)
            # The integral over x of an even response is odd, and that of an odd response even.
            rest = self._rest_table(np.abs(borders) * self.width)[own] / self.width
            total += rest if component == ODD else np.sign(borders) * rest
        found[:, 0] = self.width / pi * np.diff(total)
        if component == ODD:
            found[0] = 0.0
        return found

    def _even_part(self, x: Array, t: float) -> Array:
        """Integrate -ln(√(x² + t²)/L) over x, with L the reference length (n,);
        x and t in strip widths."""
        size = np.log(np.hypot(x, t)) + log(self.width / self.reference_length)
        return x - x * size - (t * np.arctan(x / t) if t else 0.0)

    @cached_property
    def _rest_table(self) -> RadialTable:
        """Table of the integral of the rest over x, as function of the distance [length]."""
        stack, reach = self.stack, self.shape[0] * self.width
        depth = 2 * stack.layers[0].thickness
        jump = np.subtract(_long_waves(stack.base), _long_waves(stack.outer))[:, None]

        def transforms(x: Array, m: Array, weight: Array) -> Array:
            rest = (remainder_scalars(stack, m) - jump * np.exp(-m * depth) / m) * weight / m
            phase = np.outer(x, m)
            even = np.sin(phase)
            # exp(-m reach) - cos m x: a constant of integration that is bounded at m = 0.
            odd = np.expm1(-m * reach) + 2 * np.sin(phase / 2) ** 2
            return np.stack([(odd if n == SCALARS[ODD] else even) @ rest[n] for n in range(4)], 1)

        return RadialTable(*tabulate(transforms, depth, reach))


def _odd_part(x: Array, t: float) -> Array:
    """Integrate arctan(x/t) over x (n,); t = 0 gives π|x|/2."""
    return x * np.arctan(x / t) - t * np.log(np.hypot(x, t)) if t else pi / 2 * np.abs(x)


def _long_waves(material: HalfSpace | None) -> Array:
    """Compute the wavenumber times the surface compliances of a half-space (4,)."""
    return np.zeros(4) if material is None else np.array(half_space_scalars(material, 1.0))
