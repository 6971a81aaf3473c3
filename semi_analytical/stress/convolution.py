"""Linear convolution of tractions with fields at one depth, on planes or on rows of cells.

Zero padding to at least the sum of both lengths avoids periodic images.
"""

from collections.abc import Callable

import numpy as np
from scipy.fft import fft, ifft, irfft, next_fast_len, rfft

from contact_scene.array_types import Field, Indices
from semi_analytical.operator.spectra import even_transform, mixed_transform, odd_transform
from semi_analytical.stress.components import FIELDS, each_response

# Coefficients (FIELDS, acting tractions, nx, ny) to fields.
Convolution = Callable[[Field], Field]


def plane_convolution(tractions: Field) -> Convolution:
    """Return a convolution with tractions (acting tractions, nx, ny); fields (FIELDS, nx, ny)."""
    _, nx, ny = tractions.shape
    half_x, half_y = (_half_period(cells) for cells in (nx, ny))
    along_y = rfft(np.swapaxes(tractions, 1, 2), 2 * half_y, axis=1)
    spectra = fft(along_y, 2 * half_x, axis=2)
    # For responses that are odd along one side, whose spectra are -i times real ones.
    turned = -1j * spectra
    padded = np.zeros((half_x + 1, half_y + 1))

    def convolve(coefficients: Field) -> Field:
        fields = np.empty((len(FIELDS), nx, ny))
        responses = each_response(coefficients)
        for field in fields:
            total = np.zeros(spectra.shape[1:], dtype=np.complex128)
            for traction in range(len(spectra)):
                padded[:nx, :ny], parity = next(responses)
                by = spectra if parity[0] == parity[1] else turned
                total += _spectrum(padded, parity) * by[traction]
            rows = ifft(total, axis=1, overwrite_x=True)[:, :nx]
            field[:] = irfft(rows, 2 * half_y, axis=0)[:ny].T
        return fields

    return convolve


def row_convolution(tractions: Field, rows: Indices) -> Convolution:
    """Return a convolution for some rows of cells; fields (FIELDS, nx, len(rows)).

    rows  indices along y
    """
    _, nx, ny = tractions.shape
    period = 2 * _half_period(nx)
    spectra = rfft(tractions, period, axis=1)
    offsets = rows[:, None] - np.arange(ny)

    def convolve(coefficients: Field) -> Field:
        fields = np.empty((len(FIELDS), nx, len(rows)))
        responses = each_response(coefficients)
        for field in fields:
            total = np.zeros((spectra.shape[1], len(rows)), dtype=np.complex128)
            for spectrum in spectra:
                response, (along_x, along_y) = next(responses)
                mirrored = along_x * response[:0:-1]
                gap = np.zeros((period - len(response) - len(mirrored), response.shape[1]))
                transformed = rfft(np.concatenate([response, gap, mirrored]), axis=0)
                sign = np.where(offsets < 0, along_y, 1)
                for row in range(len(rows)):
                    facing = transformed[:, np.abs(offsets[row])] * sign[row]
                    total[:, row] += np.sum(facing * spectrum, axis=1)
            field[:] = irfft(total, period, axis=0)[:nx]
        return fields

    return convolve


def _half_period(cells: int) -> int:
    return int(next_fast_len(cells, real=True))


def _spectrum(coefficients: Field, parity: tuple[int, int]) -> Field:
    """Transform coefficients at the offsets 0 … m along each side, (my + 1, 2 mx).

    The transform of a response that is odd along one side is divided by -i.
    """
    if parity == (1, 1):
        return even_transform(coefficients)[:]
    if parity == (-1, -1):
        return odd_transform(coefficients)[:]
    return mixed_transform(coefficients, odd_axis=0 if parity[0] < 0 else 1)[:]
