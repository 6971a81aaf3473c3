"""Stress below strips of uniform traction, in plane strain and antiplane shear (line contacts).

In the outermost material the stress is that of a half-space in closed form (Johnson 1985, eqs 2.31
and 2.33) plus a remainder by the layers; below it is computed as a whole. With the amplitudes f(m)
of `frf.depth` at the wave vector (m, 0), the stress at x by a line load is 1/pi int f(m) cos(m x)
dm, or with sin. Its integral over x is tabulated, and differences of it belong to strips. Along y,
sigma_yy = nu (sigma_xx + sigma_zz).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebpts1, chebvander

from contact_scene.array_types import Array, Field
from semi_analytical.frf.depth import Descent, Level, in_plane_stresses, material_at
from semi_analytical.frf.stack import Stack
from semi_analytical.grid import SurfaceGrid
from semi_analytical.influence.radial_table import RadialTable, tabulate
from semi_analytical.operator.transforms import fast_length
from semi_analytical.stress.components import FIELDS, STRESS, TRACTIONS

# Responses, as stress and traction component, and their parity along x.
RESPONSES = ("xx z", "zz z", "xz z", "xx x", "zz x", "xz x", "yz y", "xy y")
PARITY = np.array([1, 1, -1, -1, -1, 1, 1, -1])
# The interpolation error of 32 nodes is 2.6^-32 = 5e-14 at 1.5 half widths of the load.
NODES_OF_JUMPS = 32


def strip_stresses(
    stack: Stack, grid: SurfaceGrid, tractions: Field, levels: Sequence[Level]
) -> Iterator[Field]:
    """Yield the stress below all strips at one level after the other, shape (6, nx, 1).

    stack      layers and base of the body
    grid       strips that carry the tractions
    tractions  (q_x, q_y, p), or p alone (components, nx, 1) [force/length^2]
    levels     depths, each with its layer
    """
    n, width = grid.cells[0], grid.spacing[0]
    period = fast_length(3 * n)
    spectra = dict(
        zip(TRACTIONS[-len(tractions) :], np.fft.rfft(tractions[..., 0], period), strict=True)
    )
    for level in levels:
        by_response = {}
        kernels = strip_responses(stack, level, width, n)
        for name, parity, kernel in zip(RESPONSES, PARITY, kernels, strict=True):
            traction = name.split()[1]
            if traction in spectra:
                both = np.concatenate([parity * kernel[:0:-1], kernel])
                product = spectra[traction] * np.fft.rfft(both, period)
                by_response[name] = np.fft.irfft(product, period)[n - 1 : 2 * n - 1]
        nu = material_at(stack, level).poisson_ratio
        yield _add_responses(by_response, nu, n)[..., None]


def spread(stack: Stack, width: float, depth: float) -> float:
    """Return a distance from a line load beyond which no stress in a body has its largest value.

    Layers of thickness h and modulus E on a modulus E_b bend over h (E/E_b)^(1/3) and transfer
    their tension over h E/E_b. These lengths are at most the sum of all lengths of the body times
    the largest ratio of its moduli, where a bond of the compliance c counts as the length G c. The
    distance is 10 times that: in 60 random bodies the largest values lay within 3.1 times.

    stack  layers and base of the body
    width  half width of the loaded strips [length]
    depth  depth of the stress [length]
    """
    bases = [] if stack.base is None else [stack.base.shear_modulus]
    moduli = [*(film.shear_modulus for film in stack.layers), *bases]
    compliance = sum(film.normal_opening + film.tangential_jump for film in stack.layers)
    thickness = sum(film.thickness for film in stack.layers)
    length = width + depth + thickness + max(moduli) * compliance
    return 10 * length * max(moduli) / min(moduli)


class Jumps(NamedTuple):
    """Few jumps of traction with the stress of all strips outside the load.

    There the stress by a jump is a smooth function of its place, which Chebyshev polynomials
    interpolate.

    x     places of the jumps (n,) [length]
    size  jumps by traction component: (q_x, q_y, p), or p alone (components, n) [force/length^2]
    """

    x: Array
    size: Array

    @classmethod
    def of_strips(cls, grid: SurfaceGrid, tractions: Field) -> Jumps:
        """Combine the jumps at the borders of strips.

        grid       strips that carry the tractions
        tractions  (q_x, q_y, p), or p alone (components, nx, 1) [force/length^2]
        """
        borders = np.append(grid.x, grid.x[-1] + grid.spacing[0]) - grid.spacing[0] / 2
        jumps = np.diff(tractions[..., 0], prepend=0.0, append=0.0)
        loaded = np.any(jumps != 0, axis=0)
        first, last = borders[loaded][[0, -1]]
        middle, half = (first + last) / 2, (last - first) / 2
        nodes = chebpts1(NODES_OF_JUMPS)
        degree = NODES_OF_JUMPS - 1
        moments = jumps[:, loaded] @ chebvander((borders[loaded] - middle) / half, degree)
        return cls(middle + half * nodes, moments @ np.linalg.inv(chebvander(nodes, degree)))

    def stresses(self, stack: Stack, level: Level, x: Array) -> Field:
        """Compute the stress at one level, shape (6, n).

        stack  layers and base of the body
        level  depth with its layer
        x      places, at least 1.5 half widths of the load from its middle (n,) [length]
        """
        offsets = x[:, None] - self.x
        responses = border_responses(stack, level, offsets.ravel()).reshape(-1, *offsets.shape)
        size = dict(zip(TRACTIONS[-len(self.size) :], self.size, strict=True))
        by_response = {
            name: response @ size[name.split()[1]]
            for name, response in zip(RESPONSES, responses, strict=True)
            if name.split()[1] in size
        }
        return _add_responses(by_response, material_at(stack, level).poisson_ratio, len(x))


def _add_responses(by_response: Mapping[str, Field], nu: float, count: int) -> Field:
    """Sum the stresses by the traction components, and add sigma_yy of plane strain (6, n)."""
    stress = np.zeros((len(FIELDS), count))
    for name, values in by_response.items():
        stress[FIELDS.index(name.split()[0])] += values
    xx, yy, zz = (FIELDS.index(name) for name in ("xx", "yy", "zz"))
    stress[yy] = nu * (stress[xx] + stress[zz])
    return stress[STRESS]


def strip_responses(stack: Stack, level: Level, width: float, count: int) -> Field:
    """Compute the stresses by unit tractions on one strip, in the order of RESPONSES (8, count).

    stack  layers and base of the body
    level  depth with its layer
    width  width of a strip [length]
    count  number of offsets, including zero
    """
    borders = width * (np.arange(count + 1, dtype=np.float64) - 0.5)
    return np.diff(border_responses(stack, level, borders))


def border_responses(stack: Stack, level: Level, x: Array) -> Field:
    """Compute the stresses by a unit traction on all x > 0, in the order of RESPONSES (8, n).

    The stress by a strip is the difference of two. A response may contain a constant, which this
    difference removes.

    stack  layers and base of the body
    level  depth with its layer
    x      distances from the border, positive on the loaded side [length]
    """
    found = np.zeros((len(RESPONSES), len(x)))
    if level.layer == 0:
        found += _half_space(x, level.depth)
    if stack.layers:
        # Powers of two: responses of strips of other widths share the table.
        reach = 2.0 ** np.ceil(np.log2(np.max(np.abs(x))))
        rest = _integrals_by_layers(stack, level, reach)(np.abs(x))
        # The integral over x of an even response is odd.
        found += np.where(PARITY[:, None] > 0, np.sign(x), 1.0) * rest
    return found


def _half_space(x: Array, z: float) -> Field:
    """Compute the responses of a half-space (8, n) at the depth z; at its surface, just below it.
    x is the distance from the border of the load, positive on the loaded side."""
    angle, log_distance = np.arctan2(z, x), np.log(np.hypot(x, z))
    sine, cosine = np.sin(2 * angle), np.cos(2 * angle)
    twice = [
        2 * angle + sine,
        2 * angle - sine,
        -cosine,
        cosine - 4 * log_distance,
        -cosine,
        2 * angle + sine,
        2 * angle,
        -2 * log_distance,
    ]
    return np.array(twice) / (2 * pi)


@lru_cache(maxsize=64)
def _integrals_by_layers(stack: Stack, level: Level, reach: float) -> RadialTable:
    """Tabulate the integrals over x of the stresses by a line load that layers cause (8 functions).

    In the outermost layer these are the differences from a half-space, whose nearest singularity is
    the image of the load in the first interface.

    stack  layers and base of the body
    level  depth with its layer
    reach  largest distance [length]
    """
    inner = level.layer > 0
    clearance = level.depth if inner else 2 * stack.layers[0].thickness - level.depth

    def transforms(x: Array, m: Array, weight: Array) -> Array:
        fields = Descent(stack, m).remainder(level)
        planes = in_plane_stresses(fields, material_at(stack, level), m)
        by_q, by_p = fields.traction[:, 0], fields.traction[:, 1]
        amplitudes = (
            *(planes.along[1], -by_p[1], by_p[0]),
            *(planes.along[0], -by_q[1], -by_q[0]),
            *(-fields.transverse_traction, -planes.shear),
        )
        phase = np.outer(x, m)
        even = np.sin(phase)
        # exp(-m reach) - cos m x: a constant of integration that is bounded at m = 0.
        odd = np.expm1(-m * reach) + 2 * np.sin(phase / 2) ** 2
        each = zip(PARITY, amplitudes, strict=True)
        return np.stack(
            [(even if parity > 0 else odd) @ (f * weight / (pi * m)) for parity, f in each], axis=1
        )

    return RadialTable(*tabulate(transforms, clearance, reach))
