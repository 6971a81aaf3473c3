"""Pressures that are even about x = 0 and y = 0 to displacements, and roughly back, on a quarter of
the window."""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.mirrored_transform import MirroredTransform
from semi_analytical.operator import normal_spectra, positive_inverse
from semi_analytical.padded_transform import Convolutions

Field = NDArray[np.float64]


class MirroredNormalOperator:
    """u_z by pressure on the quarter x > 0, y > 0, both (nx, ny); one call is one convolution.

    What `NormalOperator` gives of the whole fields, twice as long along each side.

    symbols  spectrum of the zz coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self._transform = MirroredTransform(shape, counter)
        self.symbols = normal_spectra(coefficients, self._transform.reach)

    @cached_property
    def inverse(self) -> Field:
        """Roughly the spectrum of the inverse, with the unpadded period; columns are wavenumbers
        along x."""
        return positive_inverse(self.symbols[0].quarter[:-1:2, :-1:2])

    def __call__(self, pressure: Field) -> Field:
        """Normal displacement caused by a pressure."""
        return self._transform.convolved(pressure, self._multiplied)

    def _multiplied(self, amplitudes: Field, columns: slice) -> Field:
        amplitudes *= self.symbols[0].quarter[columns, :-1]
        return amplitudes

    def precondition(self, displacement: Field) -> Field:
        """Roughly the pressure that causes a displacement, as `NormalOperator.precondition`."""
        return self._transform.filtered(displacement, self._divided)

    def _divided(self, amplitudes: Field, columns: slice) -> Field:
        amplitudes *= self.inverse[columns]
        return amplitudes
