"""What tractions do within their cells, and the displacement by it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.kernels import PARTS, REACH, EdgeKernels, part_centres
from semi_analytical.kernel_spectrum import (
    KernelSpectrum,
    even_transform,
    mixed_transform,
    odd_transform,
)
from semi_analytical.padded_transform import Convolutions, PaddedTransform, Spectrum

Field = NDArray[np.float64]
Indices = NDArray[np.intp]

# A slope of one per cell has a twelfth of a moment; that of its parts is a little less.
MOMENT = 12 / (1 - 1 / PARTS**2)


@dataclass(frozen=True)
class Within:
    """A traction within its cells, beside its means.

    slopes  (2, nx, ny) change from side to side of a cell, along x and y [force/length^2]
    i, j    cells in which it is more than a slope, (n,)
    rest    (n, PARTS, PARTS) what mean and slope leave of its parts there [force/length^2]
    """

    slopes: Field
    i: Indices
    j: Indices
    rest: Field

    @classmethod
    def of(cls, means: Field, i: Indices, j: Indices, parts: Field) -> Within:
        """From means (nx, ny) by central differences, and in the cells (i, j) by parts."""
        loaded = means != 0
        slopes = np.stack([np.gradient(means, axis=axis) * loaded for axis in (0, 1)])
        rest = parts - parts.mean(axis=(1, 2), keepdims=True)
        x = part_centres()
        by_x = MOMENT * np.einsum("nab,a->n", rest, x) / PARTS**2
        by_y = MOMENT * np.einsum("nab,b->n", rest, x) / PARTS**2
        slopes[:, i, j] = by_x, by_y
        rest = rest - by_x[:, None, None] * x[:, None] - by_y[:, None, None] * x
        return cls(slopes, i, j, rest)

    def times(self, factor: Field) -> Within:
        """The rest alone times a field (nx, ny) that hardly changes from cell to cell."""
        of_cells = factor[self.i, self.j]
        some = of_cells != 0
        rest = of_cells[some, None, None] * self.rest[some]
        return Within(self.slopes, self.i[some], self.j[some], rest)

    @classmethod
    def together(cls, slopes: Field, rests: Sequence[Within]) -> Within:
        """These slopes, and all these rests."""
        parts = ((w.i, w.j, w.rest) for w in rests)
        i, j, rest = (np.concatenate(part) for part in zip(*parts, strict=True))
        return cls(slopes, i, j, rest)


class EdgeOperator:
    """Displacement (nx, ny) by what a traction does within its cells; one call is one and a half
    convolutions."""

    def __init__(self, kernels: EdgeKernels, shape: tuple[int, int], counter: Convolutions) -> None:
        self._near = kernels.near
        self._transform = PaddedTransform(shape, counter)
        reach = self._transform.reach
        x, y = kernels.parity
        self._spectra = [
            _spectrum(moment[reach], parity)
            for moment, parity in zip(kernels.moments, ((-x, y), (x, -y)), strict=True)
        ]
        self._odd = x * y > 0

    def __call__(self, within: Within) -> Field:
        """The displacement at the centres of the cells [length]."""
        u = self._transform.convolved(within.slopes, 1, self._multiplied)[0]
        return u + self._by_rest(within)

    def _multiplied(self, spectra: Spectrum, columns: slice) -> Spectrum:
        total, other = spectra
        for work, spectrum in zip(spectra, self._spectra, strict=True):
            work *= spectrum[columns]
        total += other
        if self._odd:
            total *= -1j
        return spectra[:1]

    def _by_rest(self, within: Within) -> Field:
        u = np.zeros(np.array(within.slopes.shape[1:]) + 2 * REACH)
        # Not by matrix products, whose rounding depends on the number of threads.
        seen = np.einsum("nab,ijab->ijn", within.rest, self._near)
        for i, j in np.ndindex(seen.shape[:2]):
            np.add.at(u, (within.i + i, within.j + j), seen[i, j])
        return u[REACH:-REACH, REACH:-REACH]


def _spectrum(moment: Field, parity: tuple[int, int]) -> KernelSpectrum:
    """That of a moment; times -i where it is odd along one side only."""
    if parity == (1, 1):
        return even_transform(moment)
    if parity == (-1, -1):
        return odd_transform(moment)
    return mixed_transform(moment, odd_axis=parity.index(-1))
