"""Stress below strips of uniform traction, in plane strain and antiplane shear (line contacts).

In the outermost material the stress is that of a half-space in closed form (Johnson 1985, eqs 2.31
and 2.33) plus a remainder by the layers; below it is computed as a whole. With the amplitudes f(m)
of `frf.depth` at the wave vector (m, 0), the stress at x by a line load is 1/pi int f(m) cos(m x)
dm, or with sin. Its integral over x is tabulated, and differences of it belong to strips. Along y,
sigma_yy = nu (sigma_xx + sigma_zz).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi

import numpy as np

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
        stress = np.zeros((len(FIELDS), n))
        kernels = strip_responses(stack, level, width, n)
        for name, parity, kernel in zip(RESPONSES, PARITY, kernels, strict=True):
            field, traction = name.split()
            if traction in spectra:
                both = np.concatenate([parity * kernel[:0:-1], kernel])
                product = spectra[traction] * np.fft.rfft(both, period)
                stress[FIELDS.index(field)] += np.fft.irfft(product, period)[n - 1 : 2 * n - 1]
        nu = material_at(stack, level).poisson_ratio
        xx, yy, zz = (FIELDS.index(name) for name in ("xx", "yy", "zz"))
        stress[yy] = nu * (stress[xx] + stress[zz])
        yield stress[STRESS, :, None]


def strip_responses(stack: Stack, level: Level, width: float, count: int) -> Field:
    """Compute the stresses by unit tractions on one strip, in the order of RESPONSES (8, count).

    stack  layers and base of the body
    level  depth with its layer
    width  width of a strip [length]
    count  number of offsets, including zero
    """
    found = np.zeros((len(RESPONSES), count))
    if level.layer == 0:
        places = width * np.arange(count, dtype=np.float64)
        found += _half_space(places, width / 2, level.depth)
    if stack.layers:
        borders = width * (np.arange(count + 1) - 0.5)
        rest = _integrals_by_layers(stack, level, count * width)(np.abs(borders))
        # The integral over x of an even response is odd.
        rest[:, 0] *= -PARITY
        found += np.diff(rest)
    return found


def _half_space(x: Array, half: float, z: float) -> Field:
    """Compute the responses of a half-space (8, n); at its surface, those just below it.

    x     distances from the middle of the loaded strip [length]
    half  half width of the strip [length]
    z     depth [length]
    """
    angles = np.arctan2(z, np.array([x - half, x + half]))
    seen, sine, cosine = (
        one[0] - one[1] for one in (angles, np.sin(2 * angles), np.cos(2 * angles))
    )
    nearer, farther = (np.hypot(at, z) for at in (x - half, x + half))
    ratio = np.log(nearer / farther)
    twice = [
        -2 * seen - sine,
        -2 * seen + sine,
        cosine,
        4 * ratio - cosine,
        cosine,
        -2 * seen - sine,
        -2 * seen,
        2 * ratio,
    ]
    return np.array(twice) / (2 * pi)


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
