"""All three displacements by all three tractions at once: the fused product of coupled bodies."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semi_analytical.operator import (
    CouplingOperator,
    NormalOperator,
    PaddedTransform,
    Spectrum,
    TangentialOperator,
)

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Tractions = NDArray[np.float64]

# Entries of the spectra that are multiplied at a time: three components of them stay in the cache.
BLOCK = 8192
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
        one = tangential.transform
        self._transform = PaddedTransform(one.shape, one.counter, components=3)

    def __call__(self, tractions: Tractions) -> Field:
        """Displacements caused by tractions."""
        work = self._transform.spectra()
        self._transform.forward(tractions, work)
        lines = max(1, BLOCK // work.shape[2])
        for first in range(0, work.shape[1], lines):
            self._multiply(work[:, first : first + lines], slice(first, first + lines))
        return self._transform.inverse(work)

    def _multiply(self, spectra: Spectrum, rows: slice) -> None:
        """Tractions to displacements in some rows of the spectra."""
        q_x, q_y, p = spectra
        xx, yy, xy = (symbol[rows] for symbol in self.tangential.symbols)
        zx, zy = (symbol[rows] for symbol in self.coupling.symbols)
        p *= 1j
        u_x = xx * q_x + xy * q_y + zx * p
        u_y = xy * q_x + yy * q_y + zy * p
        p *= self.normal.symbols[0][rows]
        p += zx * q_x + zy * q_y
        p *= -1j
        q_x[:], q_y[:] = u_x, u_y


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
        turning = 1 / (tangential.mean + stiffness[:, None, None])
        symbols = np.concatenate([np.stack(tangential.inverse), normal.inverse[None], turning])
        self._symbols = (self._unit * symbols).astype(np.float32)
        rows, columns = self._period
        count = 3 + len(stiffness)
        # The stubs of numpy.fft know double precision alone.
        self._spectra: NDArray[Any] = np.empty((count, rows, columns // 2 + 1), dtype=np.complex64)
        self._values: NDArray[Any] = np.empty((count, rows, columns), dtype=np.float32)

    def __call__(self, displacements: NDArray[Any]) -> NDArray[Any]:
        """Tractions (3 + k, nx, ny) of displacements of that shape, neither tiny nor huge."""
        _, nx, ny = displacements.shape
        if (nx, ny) != self._period:
            self._values[:] = 0
        self._values[:, :nx, :ny] = displacements
        spectra = self._spectra
        np.fft.rfft(self._values, axis=-1, out=spectra)
        np.fft.fft(spectra, axis=-2, out=spectra)
        xx, yy, xy = self._symbols[:3]
        u_x, u_y = spectra[:2]
        across = xy * u_x
        u_x *= xx
        u_x += xy * u_y
        u_y *= yy
        u_y += across
        spectra[2:] *= self._symbols[3:]
        np.fft.ifft(spectra, axis=-2, out=spectra)
        np.fft.irfft(spectra, n=self._period[1], axis=-1, out=self._values)
        return np.multiply(self._values[:, :nx, :ny], 1 / self._unit, dtype=np.float32)
