"""Spectra of the moments of influence coefficients."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.kernels import EdgeKernels
from semi_analytical.operator.spectra import (
    KernelSpectrum,
    even_transform,
    mixed_transform,
    odd_transform,
)

Field = NDArray[np.float64]


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
