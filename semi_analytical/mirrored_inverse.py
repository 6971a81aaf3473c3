"""Roughly the tractions that cause displacements, on a part of the window with mirror planes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semi_analytical.amplitudes import DOUBLE, Periods, Precision, between, filtered
from semi_analytical.grades import STIFFNESSES
from semi_analytical.mirrored_coupling import MirroredPressureOperator
from semi_analytical.mirrored_shear import MirroredTangentialOperator, rows_of_pair
from semi_analytical.operator import inverse_2x2
from semi_analytical.part import Part

Field = NDArray[np.float64]


class MirroredPeriodicInverse:
    """What `PeriodicInverse` gives of the fields with their images."""

    def __init__(
        self,
        tangential: MirroredTangentialOperator,
        self_compliance: float,
        normal: MirroredPressureOperator | None = None,
        precision: Precision = DOUBLE,
    ) -> None:
        """normal     None where there is no pressure
        precision  of the transforms
        """
        xx, yy, xy = (symbol.quarter[::2, ::2] for symbol in tangential.symbols)
        mean = np.abs(0.5 * (xx + yy))
        pressed = [] if normal is None else [normal.inverse]
        turning = [1 / (mean + self_compliance * d) for d in STIFFNESSES]
        self._lay_out(
            tangential.part,
            tangential.periods,
            inverse_2x2(xx, yy, xy),
            pressed + turning,
            precision,
        )

    def _lay_out(
        self,
        part: Part,
        periods: Periods,
        pair: Sequence[Field],
        alone: Sequence[Field],
        precision: Precision,
    ) -> None:
        """pair   spectra of xx, yy and xy at the wavenumbers from 0 to the largest
        alone  those of the components that nothing else acts on
        """
        self._part, self._periods, self._precision = part, periods, precision
        self._spectra, self._alone = pair, alone
        scalars = [part.scalar] * (len(alone) - len(STIFFNESSES))
        parities = [*part.vector, *scalars, *[part.turning] * len(STIFFNESSES)]
        self._sides = periods.sides(parities, periods.unpadded, precision)
        # Keeps single precision within its range.
        self._unit = 1 / max(float(np.max(np.abs(one))) for one in (*pair, *alone))
        (xx, xy), (_, yy) = rows_of_pair(part, *pair)
        symbols = [between(one, p, p) for one, p in zip(alone, parities[2:], strict=True)]
        self._symbols = [(self._unit * one).astype(precision) for one in (xx, yy, xy, *symbols)]

    def __call__(self, displacements: NDArray[Any]) -> NDArray[Any]:
        """Tractions (2 or 3 + grades, nx, ny) of displacements of that shape, neither tiny nor
        huge."""
        values: NDArray[Any] = np.asarray(displacements, dtype=self._precision)
        tractions = filtered(values, self._sides[: len(values)], self._multiplied)
        tractions *= 1 / self._unit
        return tractions

    def _multiplied(self, amplitudes: Sequence[Field], columns: slice) -> Sequence[Field]:
        """In the memory of the amplitudes."""
        x, y = amplitudes[:2]
        xx, yy, xy = (symbol[columns] for symbol in self._symbols[:3])
        across = xy * x
        x *= xx
        x += xy * y
        y *= yy
        y += across
        for one, symbol in zip(amplitudes[2:], self._symbols[3:], strict=False):
            one *= symbol[columns]
        return amplitudes

    def yielding(self, compliance: float) -> MirroredPeriodicInverse:
        """The same for cells that yield to their own tractions by as much more, and grades that
        count by the self-compliance which that makes."""
        xx, yy, xy = self._spectra
        # (F + ρ)⁻¹ = F⁻¹ (1 + ρ F⁻¹)⁻¹, from F⁻¹ alone.
        both = compliance * (xx * yy - xy * xy)
        whole = 1 + compliance * (xx + yy + both)
        more = np.full(len(self._alone), compliance)
        more[-len(STIFFNESSES) :] *= 1 + STIFFNESSES
        found = MirroredPeriodicInverse.__new__(MirroredPeriodicInverse)
        found._lay_out(
            self._part,
            self._periods,
            ((xx + both) / whole, (yy + both) / whole, xy / whole),
            [one / (1 + c * one) for one, c in zip(self._alone, more, strict=True)],
            self._precision,
        )
        return found
