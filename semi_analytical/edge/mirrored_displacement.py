"""Displacement by what pressures that are even about x = 0 and y = 0 do within their cells, on a
quarter of the window."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.displacement import Within, around
from semi_analytical.edge.kernels import PARTS, REACH, EdgeKernels
from semi_analytical.edge.moment_spectra import spectra_of
from semi_analytical.kernel_spectrum import KernelSpectrum
from semi_analytical.mirrored_transform import BLOCK, Cosines, mirrored_offsets
from semi_analytical.padded_transform import Convolutions
from semi_analytical.sines import Sines

Field = NDArray[np.float64]


class MirroredEdgeOperator:
    """What `EdgeOperator` gives of the pressures on the whole window, twice as long along each
    side; one call is one and a half convolutions.

    The slope along x is odd about x = 0, a sum of sines there; so is its kernel, and what it moves
    is even again: a sum of cosines, -1 times the product.
    """

    def __init__(
        self,
        kernels: EdgeKernels,
        shape: tuple[int, int],
        counter: Convolutions,
        known: KernelSpectrum | None = None,
    ) -> None:
        """kernels  of the zz component
        known    spectrum of the coefficients, if it is
        """
        self._counter = counter
        nx, ny = mirrored_offsets(shape)
        reach = slice(nx), slice(ny)
        self._symbols = [spectrum.quarter for spectrum in spectra_of(kernels, reach, known)]
        self._cosines = [Cosines(n, m - 1) for n, m in zip(shape, (nx, ny), strict=True)]
        self._sines = [Sines(n, m - 1) for n, m in zip(shape, (nx, ny), strict=True)]
        self._near = kernels.near.reshape(-1, PARTS**2)

    def __call__(self, within: Within) -> Field:
        """u_z (1, nx, ny) at the centres of the cells [length]."""
        u = self._by_slopes(*within.slopes)
        u += _folded(around(within, self._near, 1)[0])
        return u[None]

    def _by_slopes(self, along_x: Field, along_y: Field) -> Field:
        self._counter.count += 1.5
        (cos_x, cos_y), (sin_x, sin_y) = self._cosines, self._sines
        D_x, D_y = self._symbols
        lines, others = cos_y.forward(along_x), sin_y.forward(along_y)
        width = max(1, BLOCK // cos_x.m)
        for first in range(0, cos_y.m, width):
            columns = slice(first, min(first + width, cos_y.m))
            block = sin_x.forward(lines[:, columns].T)
            block *= D_x[columns, :-1]
            other = cos_x.forward(others[:, columns].T)
            other *= D_y[columns, :-1]
            block += other
            lines[:, columns] = cos_x.back(block).T
        return -cos_y.back(lines)


def _folded(u: Field) -> Field:
    """Displacements on a frame of REACH cells about the quarter, without it: what they are beyond
    the planes by a cell they are within by its image."""
    images = slice(REACH - 1, None, -1)
    within = slice(REACH, 2 * REACH)
    u[within] += u[images]
    u[:, within] += u[:, images]
    return u[REACH:-REACH, REACH:-REACH]
