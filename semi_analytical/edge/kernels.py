"""Displacements by what cell-constant tractions leave out: slopes within cells, and what is left.

Within a cell a traction is its mean, a slope, and a rest that matters to near cells alone. Slopes
act by the first moments D of the influence coefficients, rests by a table of PARTS x PARTS parts of
a cell as seen from the cells around it. Both are made of influence coefficients at the spacing of
the parts, whichever the bodies: PARTS is odd, so that parts and cells have common centres.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.operator.spectra import (
    KernelSpectrum,
    even_transform,
    mixed_transform,
    odd_transform,
)

PARTS = 11
# Cells around a part of a cell that see the rest.
REACH = 2
# Cells within which a moment is summed over the parts; beyond it is a derivative, right to 5e-4.
NEAR = 8
# How many offsets of influence coefficients the parts need.
PART_OFFSETS = NEAR * PARTS + PARTS // 2 + 1

# Parity along x and y of what each component reads.
PARITY = {
    "zz": (1, 1),
    "xx": (1, 1),
    "yy": (1, 1),
    "xy": (-1, -1),
    "zx": (-1, 1),
    "zy": (1, -1),
}


def part_centres() -> Field:
    """Centres of the parts of a cell along one side, (PARTS,) in cells."""
    return (np.arange(PARTS) - PARTS // 2) / PARTS


@dataclass(frozen=True)
class EdgeKernels:
    """Of one component of the influence coefficients.

    component  as in `InfluenceCoefficients`
    cells      influence coefficients of the cells
    parts      influence coefficients at PART_OFFSETS of the parts
    """

    component: str
    cells: InfluenceCoefficients
    parts: InfluenceCoefficients

    @property
    def parity(self) -> tuple[int, int]:
        """Along x and y, of the coefficients."""
        return PARITY[self.component]

    @property
    def even(self) -> bool:
        """Whether the coefficients are alike along both sides: even, or odd."""
        return self.parity[0] == self.parity[1]

    @cached_property
    def moments(self) -> Field:
        """Displacement at cell offsets i, j >= 0 by tractions x and y on the cell at the origin,
        lengths in cells, shape (2, nx, ny) [length^3/force]."""
        A = getattr(self.cells, self.component)
        moments = np.stack([-_slope(A, axis, self.parity[axis]) / 12 for axis in (0, 1)])
        nx, ny = (min(n, NEAR + 1) for n in A.shape)
        moments[:, :nx, :ny] = self.near_moments[:, :nx, :ny]
        return moments

    @cached_property
    def near_moments(self) -> Field:
        """The same at NEAR + 1 offsets along each side."""
        K = getattr(self.parts, self.component)[:PART_OFFSETS, :PART_OFFSETS]
        x, one = part_centres(), np.ones(PARTS)
        along_x, along_y = (_added_up(x, parity) for parity in self.parity)
        across_x, across_y = (_added_up(one, parity) for parity in self.parity)
        by_both = along_x @ K @ across_y.T, across_x @ K @ along_y.T
        # The moment of the parts is a little less than that of the slope.
        return np.stack(by_both) / (1 - 1 / PARTS**2)

    @cached_property
    def near(self) -> Field:
        """Displacement at cell offsets -REACH … REACH by unit traction on a part of the cell at the
        origin, shape (2 REACH + 1, 2 REACH + 1, PARTS, PARTS) [length^3/force]."""
        K = getattr(self.parts, self.component)
        i = PARTS * np.arange(-REACH, REACH + 1)[:, None] - np.arange(PARTS) + PARTS // 2
        sign_x, sign_y = (np.where(i < 0, parity, 1) for parity in self.parity)
        seen = K[np.abs(i)[:, None, :, None], np.abs(i)[:, None]]
        return np.asarray(sign_x[:, None, :, None] * sign_y[:, None] * seen)


def _added_up(weights: Field, parity: int) -> Field:
    """Of values at offsets of parts, even or odd, to what they are at offsets of cells, the parts
    having these weights (NEAR + 1, PART_OFFSETS)."""
    offsets = PARTS * np.arange(NEAR + 1)[:, None] - np.arange(PARTS) + PARTS // 2
    added = np.zeros((NEAR + 1, PART_OFFSETS))
    rows = np.broadcast_to(np.arange(NEAR + 1)[:, None], offsets.shape)
    np.add.at(added, (rows, np.abs(offsets)), weights * np.where(offsets < 0, parity, 1))
    return added


def _slope(values: Field, axis: int, parity: int) -> Field:
    """Derivative per cell along an axis of values at offsets >= 0, of fourth order but at the far
    end."""
    v = np.moveaxis(values, axis, 0)
    v = np.concatenate([parity * v[2:0:-1], v])
    slope = np.gradient(v, axis=0)
    slope[2:-2] = (8 * (v[3:-1] - v[1:-3]) - (v[4:] - v[:-4])) / 12
    return np.moveaxis(slope[2:], 0, axis)


def spectra_of(
    of: EdgeKernels, reach: tuple[slice, slice], known: KernelSpectrum | None = None
) -> tuple[KernelSpectrum, KernelSpectrum]:
    """Those of the moments along x and y; times -i where the component is even (odd) along both
    sides.

    known  that of the coefficients, even along both, which saves the transforms
    """
    if known is not None:
        return _by_differences(of, known, 0), _by_differences(of, known, 1)
    x, y = of.parity
    along_x, along_y = (moment[reach] for moment in of.moments)
    return _spectrum(along_x, (-x, y)), _spectrum(along_y, (x, -y))


def _spectrum(moment: Field, parity: tuple[int, int]) -> KernelSpectrum:
    """That of a moment; times -i where it is odd along one side only."""
    if parity == (1, 1):
        return even_transform(moment)
    if parity == (-1, -1):
        return odd_transform(moment)
    return mixed_transform(moment, odd_axis=parity.index(-1))


def _by_differences(of: EdgeKernels, known: KernelSpectrum, axis: int) -> KernelSpectrum:
    """Far moments along an axis are differences of the coefficients, repeated with the period of
    their spectrum: a product with it. The few that are near are told by their parts."""
    periods = known.quarter.shape[1] - 1, known.quarter.shape[0] - 1
    near = of.near_moments[axis][tuple(slice(m + 1) for m in periods)]
    values = getattr(of.cells, of.component)
    along = values[:, : near.shape[1]] if axis == 0 else values[: len(near)].T
    far = _far(along, periods[axis], near.shape[axis])
    besides = near - (far if axis == 0 else far.T)
    by_x, by_y = (
        _waves(np.sin if side == axis else np.cos, m, n)
        for side, (m, n) in enumerate(zip(periods, near.shape, strict=True))
    )
    turn = np.pi / periods[axis] * np.arange(periods[axis] + 1)
    slope = (8 * np.sin(turn) - np.sin(2 * turn)) / 72
    quarter = known.quarter * (slope[:, None] if axis else slope)
    quarter += by_y @ besides.T @ by_x.T
    return KernelSpectrum(quarter, 1 if axis else -1)


def _far(values: Field, m: int, count: int) -> Field:
    """Moments along the first axis as derivatives, by differences of fourth order (count, …)."""
    far = np.zeros((count, *values.shape[1:]))
    for step, weight in ((1, 8), (-1, -8), (2, -1), (-2, 1)):
        far -= weight / 144 * values[m - np.abs(m - np.abs(np.arange(count) + step))]
    return far


def _waves(wave: np.ufunc, m: int, count: int) -> Field:
    """Of Fourier sums over the first offsets of 0 … m (m + 1, count): twice those between."""
    turn = wave(np.pi / m * np.arange(2 * m))
    waves = turn[np.outer(np.arange(m + 1), np.arange(count)) % (2 * m)]
    waves[:, 1:m] *= 2
    return np.asarray(waves)
