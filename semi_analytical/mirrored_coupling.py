"""All three displacements by all three tractions on a part of the window with mirror planes."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semi_analytical.amplitudes import Periods, Responses, between, filtered
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.mirrored_shear import MirroredTangentialOperator
from semi_analytical.operator import coupling_spectra, normal_spectra, positive_inverse
from semi_analytical.padded_transform import Convolutions
from semi_analytical.part import Part

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Tractions = NDArray[np.float64]


class MirroredPressureOperator:
    """u_z by pressure, both (nx, ny); one call is one convolution.

    What `NormalOperator` gives of the fields with their images.

    symbols  spectrum of the zz coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        part: Part,
        counter: Convolutions,
    ) -> None:
        self._part, self._periods, self._counter = part, Periods(shape, part), counter
        self.symbols = normal_spectra(coefficients, self._periods.reach)
        self.sides = self._periods.sides([part.scalar], self._periods.padded)

    @cached_property
    def response(self) -> Field:
        """Between the amplitudes of both."""
        return between(self.symbols[0].quarter, self._part.scalar, self._part.scalar)

    def __call__(self, pressure: Field) -> Field:
        """Normal displacement caused by a pressure."""
        self._counter.count += 1
        return filtered(pressure[None], self.sides, Responses([[self.response]]).times)[0]

    @cached_property
    def inverse(self) -> Field:
        """Roughly the spectrum of the inverse, with the unpadded period."""
        return positive_inverse(self.symbols[0].quarter[::2, ::2])

    @cached_property
    def _divided(self) -> Responses:
        return Responses([[between(self.inverse, self._part.scalar, self._part.scalar)]])

    def precondition(self, displacement: Field) -> Field:
        """Roughly the pressure that causes a displacement, as `NormalOperator.precondition`."""
        sides = self._periods.sides([self._part.scalar], self._periods.unpadded)
        return filtered(displacement[None], sides, self._divided.times)[0]


class MirroredCouplingOperator:
    """u_z by shear and (u_x, u_y) by pressure; 1.5 convolutions each.

    What `CouplingOperator` gives of the fields with their images.

    symbols  S of the spectra -i S of the zx and zy coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        part: Part,
        counter: Convolutions,
    ) -> None:
        self._part, self._counter = part, counter
        periods = Periods(shape, part)
        self.symbols = coupling_spectra(coefficients, periods.reach)
        self._scalar = periods.sides([part.scalar], periods.padded)
        self._vector = periods.sides(part.vector, periods.padded)

    @cached_property
    def responses(self) -> list[Field]:
        """Of u_x and u_y to the pressure, between their amplitudes; of u_z to q_x and q_y, too."""
        pairs = zip(self.symbols, self._part.vector, strict=True)
        return [between(one.quarter, parity, self._part.scalar, 1j) for one, parity in pairs]

    def normal_by_shear(self, shear: VectorField) -> Field:
        """u_z (nx, ny) caused by a shear (2, nx, ny)."""
        self._counter.count += 1.5
        multiply = Responses([self.responses]).times
        return filtered(shear, self._vector, multiply, self._scalar)[0]

    def tangential_by_pressure(self, pressure: Field) -> VectorField:
        """(u_x, u_y), shape (2, nx, ny), caused by a pressure (nx, ny)."""
        self._counter.count += 1.5
        multiply = Responses([[one] for one in self.responses]).times
        return filtered(pressure[None], self._scalar, multiply, self._vector)


class MirroredCoupledOperator:
    """(u_x, u_y, u_z) by (q_x, q_y, p), each (3, nx, ny); one call is three convolutions.

    What `CoupledOperator` gives of the fields with their images.
    """

    def __init__(self, tangential: MirroredTangentialOperator) -> None:
        """tangential  of the same box"""
        given = tangential.given
        self.normal, self.coupling = (
            MirroredPressureOperator(*given),
            MirroredCouplingOperator(*given),
        )
        self.tangential = tangential
        part, periods = tangential.part, tangential.periods
        self._sides = periods.sides([*part.vector, part.scalar], periods.padded)

    def __call__(self, tractions: Tractions) -> Field:
        """Displacements caused by tractions."""
        self.tangential.counter.count += 3
        return filtered(tractions, self._sides, self._responses.times)

    @cached_property
    def _responses(self) -> Responses:
        (xx, xy), (_, yy) = self.tangential.rows
        zx, zy = self.coupling.responses
        return Responses([[xx, xy, zx], [xy, yy, zy], [zx, zy, self.normal.response]])
