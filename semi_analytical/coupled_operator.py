"""All three displacements by all three tractions at once: the fused product of coupled bodies."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semi_analytical.operator import CouplingOperator, NormalOperator, TangentialOperator
from semi_analytical.padded_transform import Spectrum

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Tractions = NDArray[np.float64]

# Stiffnesses that hold slip back, over the self-compliance: see graded_preconditioner.
RATIO = 4.0
STIFFNESSES = np.array([1.0, RATIO, RATIO**2, RATIO**3])


class CoupledOperator:
    """(u_x, u_y, u_z) by (q_x, q_y, p), each (3, nx, ny); one call is three convolutions.

    The same as the normal, tangential and coupling operators together, whose spectra it reads, but
    with three forward and three inverse transforms instead of six and six. With i p and i u_z in
    place of p and u_z the matrix of a wavenumber is real and symmetric.
    """

    def __init__(
        self, normal: NormalOperator, tangential: TangentialOperator, coupling: CouplingOperator
    ) -> None:
        self.normal, self.tangential, self.coupling = normal, tangential, coupling
        self._transform = tangential.transform

    def __call__(self, tractions: Tractions) -> Field:
        """Displacements caused by tractions."""
        return self._transform.convolved(tractions, 3, self._multiplied)

    def _multiplied(self, spectra: Spectrum, columns: slice) -> Spectrum:
        """Tractions to displacements in some columns of the spectra."""
        q_x, q_y, p = spectra
        xx, yy, xy = (symbol[columns] for symbol in self.tangential.symbols)
        zx, zy = (symbol[columns] for symbol in self.coupling.symbols)
        p *= 1j
        u_x = xx * q_x + xy * q_y + zx * p
        u_y = xy * q_x + yy * q_y + zy * p
        p *= self.normal.symbols[0][columns]
        p += zx * q_x + zy * q_y
        p *= -1j
        q_x[:], q_y[:] = u_x, u_y
        return spectra


class PeriodicInverse:
    """Roughly the tractions that cause displacements: by the spectra repeated with the unpadded
    period, the coupling left out, in single precision.

    Behind the three components follow shears of one component that are held back by stiffnesses
    besides, all transformed together. A quarter of the cost of a convolution each; not counted.
    """

    def __init__(self, operator: CoupledOperator, stiffness: Vector) -> None:
        """stiffness (k,) [length^3/force]"""
        normal, tangential = operator.normal, operator.tangential
        self._period = tangential.transform.period
        self._unit = 1 / np.max(np.abs(normal.inverse))  # keeps single precision within its range
        turning = 1 / (tangential.mean() + stiffness[:, None, None])
        symbols = np.concatenate([np.stack(tangential.inverse), normal.inverse[None], turning])
        self._symbols = (self._unit * symbols).astype(np.float32)
        rows, columns = self._period
        # The stubs of numpy.fft know double precision alone.
        self._spectra: NDArray[Any] = np.empty((2, rows, columns // 2 + 1), dtype=np.complex64)
        self._values: NDArray[Any] = np.zeros((2, rows, columns), dtype=np.float32)

    def __call__(self, displacements: NDArray[Any]) -> NDArray[Any]:
        """Tractions (3 + k, nx, ny) of displacements of that shape, neither tiny nor huge."""
        tractions = np.empty(displacements.shape, dtype=np.float32)
        xx, yy, xy = self._symbols[:3]
        with self._transformed(displacements[:2], tractions[:2]) as (u_x, u_y):
            across = xy * u_x
            u_x *= xx
            u_x += xy * u_y
            u_y *= yy
            u_y += across
        for number in range(2, len(displacements)):
            one = slice(number, number + 1)
            with self._transformed(displacements[one], tractions[one]) as spectrum:
                spectrum *= self._symbols[number + 1]
        return tractions

    @contextmanager
    def _transformed(self, values: NDArray[Any], into: NDArray[Any]) -> Iterator[NDArray[Any]]:
        """Spectra of values, and back again; one component or two."""
        count, nx, ny = values.shape
        padded, spectra = self._values[:count], self._spectra[:count]
        padded[:, nx:], padded[:, :, ny:] = 0, 0
        padded[:, :nx, :ny] = values
        np.fft.rfft(padded, axis=-1, out=spectra)
        np.fft.fft(spectra, axis=-2, out=spectra)
        yield spectra
        np.fft.ifft(spectra, axis=-2, out=spectra)
        np.fft.irfft(spectra, n=self._period[1], axis=-1, out=padded)
        np.multiply(padded[:, :nx, :ny], 1 / self._unit, out=into)
