"""Shear to tangential displacements on a part of the window with mirror planes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semi_analytical.amplitudes import Periods, Responses, between, filtered
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.kernel_spectrum import KernelSpectrum
from semi_analytical.operator import tangential_spectra
from semi_analytical.padded_transform import Convolutions
from semi_analytical.part import Part

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Rows = list[list[Field]]


class MirroredTangentialOperator:
    """(u_x, u_y) by shear (q_x, q_y) on a part of the window, each (2, nx, ny); one call is two
    convolutions.

    What `TangentialOperator` gives of the fields with their images.

    given    what it was made of
    symbols  spectra of the xx, yy and xy coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        part: Part,
        counter: Convolutions,
    ) -> None:
        self.given = coefficients, shape, part, counter
        self.part, self.periods, self.counter = part, Periods(shape, part), counter
        self.symbols = tangential_spectra(coefficients, self.periods.reach)
        self._sides = self.periods.sides(part.vector, self.periods.padded)

    def __call__(self, shear: VectorField) -> VectorField:
        """Tangential displacement caused by a shear traction."""
        self.counter.count += 2
        return filtered(shear, self._sides, self._responses.times)

    @cached_property
    def rows(self) -> Rows:
        """Between the amplitudes of both components."""
        return tangential_rows(self.part, self.symbols)

    @cached_property
    def _responses(self) -> Responses:
        return Responses(self.rows)


def tangential_rows(part: Part, symbols: Sequence[KernelSpectrum]) -> Rows:
    """Of the spectra xx, yy and xy between the amplitudes of both components."""
    xx, yy, xy = (symbol.quarter for symbol in symbols)
    return rows_of_pair(part, xx, yy, xy)


def rows_of_pair(part: Part, xx: Field, yy: Field, xy: Field) -> Rows:
    """The same of spectra at the wavenumbers from 0 to the largest."""
    x, y = part.vector
    across = between(xy, x, y)
    return [[between(xx, x, x), across], [across, between(yy, y, y)]]
