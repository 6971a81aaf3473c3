"""What tractions do within their cells, and the displacement by it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.kernels import PARTS, REACH, EdgeKernels, part_centres
from semi_analytical.edge.moment_spectra import spectra_of
from semi_analytical.kernel_spectrum import KernelSpectrum
from semi_analytical.padded_transform import Convolutions, PaddedTransform, Spectrum
from semi_analytical.part import WHOLE, Part

Field = NDArray[np.float64]
Indices = NDArray[np.intp]
# Of displacements by tractions.
Matrix = Sequence[Sequence[tuple[int, EdgeKernels]]]

# A slope of one per cell has a twelfth of a moment; that of its parts is a little less.
MOMENT = 12 / (1 - 1 / PARTS**2)
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
# One and both places at the parts of a cell: what mean and slopes go with.
LINEAR = np.stack([np.ones(PARTS**2), X, Y], axis=-1)


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
    def of(cls, means: Field, i: Indices, j: Indices, parts: Field, part: Part = WHOLE) -> Within:
        """From means (nx, ny) by central differences, and in the cells (i, j) by parts.

        part  of the window that all are on
        """
        slopes = part.differences(means) * (means != 0)
        values = parts.reshape(-1, PARTS**2)
        told = values @ (LINEAR / [1, 1 / MOMENT, 1 / MOMENT] / PARTS**2)
        slopes[:, i, j] = told[:, 1:].T
        rest = values - told @ LINEAR.T
        return cls(slopes, i, j, rest.reshape(parts.shape))

    def along(self, n: Field, component: Field) -> Within:
        """Within a component of a vector of this size and direction n (nx, ny).

        component  its means over the cells (nx, ny)
        """
        slopes = np.stack(list(np.gradient(component)))
        at = self.i, self.j
        slopes[:, *at] = n[at] * self.slopes[:, *at]
        return Within(slopes, self.i, self.j, n[at][:, None, None] * self.rest)

    @classmethod
    def nothing(cls, cells: tuple[int, ...]) -> Within:
        """Of no traction on these cells."""
        none = np.zeros(0, dtype=int)
        return cls(np.zeros((2, *cells)), none, none, np.zeros((0, PARTS, PARTS)))

    def unfolded(self, part: Part) -> Within:
        """On the whole window what an even traction is on its part."""
        if not part.quarter:
            return self
        slopes, i, j, rest = self.slopes, self.i, self.j, self.rest
        for axis, (nx, ny) in enumerate((slopes.shape[1:], (2 * slopes.shape[1], slopes.shape[2]))):
            images = np.flip(slopes, axis + 1).copy()
            images[axis] *= -1
            slopes = np.concatenate([images, slopes], axis + 1)
            at, beside = (i, j) if axis == 0 else (j, i)
            count = (nx, ny)[axis]
            at, beside = np.concatenate([count - 1 - at, count + at]), np.tile(beside, 2)
            i, j = (at, beside) if axis == 0 else (beside, at)
            rest = np.concatenate([np.flip(rest, axis + 1), rest])
        return Within(slopes, i, j, rest)

    @classmethod
    def summed(cls, slopes: Field, terms: Sequence[tuple[Field, Within]]) -> Within:
        """These slopes, and the rests times fields (nx, ny) that hardly change from cell to cell;
        once where several have the same cell, or each turn of a load would add its own."""
        ny = slopes.shape[2]
        some = [factor[w.i, w.j] != 0 for factor, w in terms]
        each = [(w.i * ny + w.j)[of] for of, (_, w) in zip(some, terms, strict=True)]
        cells = np.unique(np.concatenate(each))
        rest = np.zeros((len(cells), PARTS, PARTS))
        for of, at, (factor, w) in zip(some, each, terms, strict=True):
            scale = factor[w.i[of], w.j[of], None, None]
            rest[np.searchsorted(cells, at)] += scale * w.rest[of]
        return cls(slopes, cells // ny, cells % ny, rest)


class EdgeOperator:
    """Displacements by what tractions do within their cells, of one component of the influence
    coefficients or, transformed together, of several.

    A call is half a convolution for every displacement and one for every traction.
    """

    def __init__(
        self,
        kernels: Matrix,
        shape: tuple[int, int],
        counter: Convolutions,
        known: Mapping[str, KernelSpectrum] | None = None,
    ) -> None:
        """kernels  rows are displacements, columns tractions: sign and kernels of a component
        known    spectra of components of the coefficients that are even along both sides
        """
        self._transform = PaddedTransform(shape, counter)
        self._components: dict[str, tuple[KernelSpectrum, KernelSpectrum]] = {}
        for _, of in chain.from_iterable(kernels):
            if of.component not in self._components:
                spectrum = known.get(of.component) if known else None
                moments = spectra_of(of, self._transform.reach, spectrum)
                self._components[of.component] = moments
        self._matrix = [
            [(sign * (-1j if of.even else 1), of.component) for sign, of in row] for row in kernels
        ]
        self._near = [
            np.concatenate([sign * of.near.reshape(-1, PARTS**2) for sign, of in column])
            for column in zip(*kernels, strict=True)
        ]

    def __call__(self, *within: Within) -> Field:
        """The displacements (rows, nx, ny) at the centres of the cells by one `Within` per column
        [length]."""
        slopes = np.concatenate([w.slopes for w in within])
        u = self._transform.convolved(slopes, len(self._matrix), self._multiplied)
        for traction, near in zip(within, self._near, strict=True):
            moved = around(traction, near, len(self._matrix))
            u += moved[:, REACH:-REACH, REACH:-REACH]
        return u

    def _multiplied(self, spectra: Spectrum, columns: slice) -> Spectrum:
        symbols = {
            name: [spectrum[columns] for spectrum in pair]
            for name, pair in self._components.items()
        }
        u = np.zeros((len(self._matrix), *spectra.shape[1:]), dtype=spectra.dtype)
        for total, row in zip(u, self._matrix, strict=True):
            for k, (factor, name) in enumerate(row):
                along_x, along_y = symbols[name]
                part = along_x * spectra[2 * k]
                part += along_y * spectra[2 * k + 1]
                part *= factor
                total += part
        return u


def around(within: Within, near: Field, count: int) -> Field:
    """Displacements (count, nx + 2 REACH, ny + 2 REACH) of the cells about each by its rest.

    near  (count of offsets, PARTS²) displacement by each part, one displacement after the other
    """
    shape = np.array(within.slopes.shape[1:]) + 2 * REACH
    seen = near @ within.rest.reshape(-1, PARTS**2).T
    offset = np.arange(2 * REACH + 1)
    at = (within.i + offset[:, None])[:, None] * shape[1] + (within.j + offset[:, None])
    u = np.empty((count, *shape))
    for total, one in zip(u, seen.reshape(count, -1), strict=True):
        total.flat = np.bincount(at.ravel(), weights=one, minlength=total.size)
    return u
