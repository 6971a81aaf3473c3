"""Roughly the tractions that cause displacements: by spectra repeated with the unpadded period."""

from collections.abc import Iterator
from contextlib import contextmanager
from copy import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semi_analytical.grades import STIFFNESSES
from semi_analytical.operator import NormalOperator, TangentialOperator


class PeriodicInverse:
    """Shear by tangential displacement, pressure by normal displacement (the coupling left out),
    and behind them shears of one component that are held back by the stiffnesses of the grades
    besides.

    A quarter of the cost of a convolution each; not counted.
    """

    def __init__(
        self,
        tangential: TangentialOperator,
        self_compliance: float,
        normal: NormalOperator | None = None,
        precision: type[np.floating[Any]] = np.float64,
    ) -> None:
        """normal     None where there is no pressure
        precision  of the transforms
        """
        self._period = tangential.transform.period
        turning = 1 / (tangential.mean() + self_compliance * STIFFNESSES[:, None, None])
        pressed = [] if normal is None else [normal.inverse[None]]
        symbols = np.concatenate([np.stack(tangential.inverse), *pressed, turning])
        self._unit = 1 / np.max(np.abs(symbols))  # keeps single precision within its range
        self._precision = precision
        self._symbols = (self._unit * symbols).astype(precision)
        rows, columns = self._period
        # The stubs of numpy.fft know double precision alone.
        self._spectra: NDArray[Any] = np.empty(
            (2, rows, columns // 2 + 1), dtype=np.result_type(precision, np.complex64)
        )
        self._values: NDArray[Any] = np.zeros((2, rows, columns), dtype=precision)

    def __call__(self, displacements: NDArray[Any]) -> NDArray[Any]:
        """Tractions (2 or 3 + grades, nx, ny) of displacements of that shape, neither tiny nor
        huge."""
        tractions = np.empty(displacements.shape, dtype=self._precision)
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

    def yielding(self, compliance: float) -> "PeriodicInverse":
        """The same for cells that yield to their own tractions by as much more, and grades that
        count by the self-compliance which that makes; it shares the work space."""
        symbols = self._symbols.astype(np.float64) / self._unit
        xx, yy, xy = symbols[:3]
        # (F + ρ)⁻¹ = F⁻¹ (1 + ρ F⁻¹)⁻¹, from F⁻¹ alone.
        both = compliance * (xx * yy - xy * xy)
        whole = 1 + compliance * (xx + yy + both)
        symbols[:3] = (xx + both) / whole, (yy + both) / whole, xy / whole
        more = np.full(len(symbols) - 3, compliance)
        more[-len(STIFFNESSES) :] *= 1 + STIFFNESSES
        symbols[3:] /= 1 + more[:, None, None] * symbols[3:]
        found = copy(self)
        found._unit = 1 / np.max(np.abs(symbols))
        found._symbols = (found._unit * symbols).astype(self._precision)
        return found

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
