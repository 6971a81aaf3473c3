"""All three displacements by all three tractions at once: the fused product of coupled bodies."""

import numpy as np
from numpy.typing import NDArray

from semi_analytical.operator import CouplingOperator, NormalOperator, TangentialOperator
from semi_analytical.padded_transform import Spectrum

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Tractions = NDArray[np.float64]


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
