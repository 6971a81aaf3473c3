"""Tractions to fields at one depth: linear convolution, on whole planes or on some rows of cells.

Both pad with zeros to at least the sum of the lengths, so there is no periodic image.
"""

from collections.abc import Callable

import numpy as np
from scipy.fft import next_fast_len

from contact_scene.array_types import Field, Indices
from semi_analytical.stress.components import FIELDS, TRACTIONS, parity

# Coefficients (FIELDS, TRACTIONS, nx, ny) to fields.
Convolution = Callable[[Field], Field]


def plane_convolution(tractions: Field) -> Convolution:
    """Convolve tractions (TRACTIONS, nx, ny) on all cells; fields (FIELDS, nx, ny)."""
    _, nx, ny = tractions.shape
    period = (int(next_fast_len(2 * nx, real=False)), int(next_fast_len(2 * ny, real=True)))
    spectra = np.fft.rfft2(tractions, period)
    loaded = _loaded(tractions)

    def convolve(coefficients: Field) -> Field:
        fields = np.zeros((len(FIELDS), nx, ny))
        for field in range(len(FIELDS)):
            total = np.zeros(spectra.shape[1:], dtype=np.complex128)
            for traction in loaded:
                along_x, along_y = parity(field, traction)
                kernel = _mirrored(coefficients[field, traction], 0, along_x, period[0])
                kernel = _mirrored(kernel, 1, along_y, period[1])
                total += np.fft.rfft2(kernel) * spectra[traction]
            fields[field] = np.fft.irfft2(total, period)[:nx, :ny]
        return fields

    return convolve


def row_convolution(tractions: Field, rows: Indices) -> Convolution:
    """The same on some rows of cells only; fields (FIELDS, nx, len(rows)).

    rows  indices along y
    """
    _, nx, ny = tractions.shape
    period = int(next_fast_len(2 * nx, real=True))
    spectra = np.fft.rfft(tractions, period, axis=1)
    loaded = _loaded(tractions)
    offsets = rows[:, None] - np.arange(ny)

    def convolve(coefficients: Field) -> Field:
        fields = np.empty((len(FIELDS), nx, len(rows)))
        for field in range(len(FIELDS)):
            total = np.zeros((spectra.shape[1], len(rows)), dtype=np.complex128)
            for traction in loaded:
                along_x, along_y = parity(field, traction)
                kernel = _mirrored(coefficients[field, traction], 0, along_x, period)
                responses = np.fft.rfft(kernel, axis=0)
                sign = np.where(offsets < 0, along_y, 1)
                for row in range(len(rows)):
                    facing = responses[:, np.abs(offsets[row])] * sign[row]
                    total[:, row] += np.sum(facing * spectra[traction], axis=1)
            fields[field] = np.fft.irfft(total, period, axis=0)[:nx]
        return fields

    return convolve


def _loaded(tractions: Field) -> list[int]:
    """Components that act at all."""
    return [k for k in range(len(TRACTIONS)) if np.any(tractions[k])]


def _mirrored(coefficients: Field, axis: int, sign: int, period: int) -> Field:
    """Continue coefficients at offsets >= 0 to negative ones, cyclic with the period."""
    count = coefficients.shape[axis]
    gap = list(coefficients.shape)
    gap[axis] = period - 2 * count + 1
    reflected = sign * np.flip(np.take(coefficients, range(1, count), axis), axis)
    return np.concatenate([coefficients, np.zeros(gap), reflected], axis)
