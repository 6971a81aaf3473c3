"""Shear to tangential displacements, and roughly back, on a quarter of the window.

Pushed along one axis, bodies that do not couple have tractions and displacements along it that are
even about x = 0 and y = 0, and across it such that are odd about both.
"""

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len

from semi_analytical.grades import STIFFNESSES
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.kernel_spectrum import even_transform, odd_transform
from semi_analytical.mirrored_transform import BLOCK, Cosines
from semi_analytical.operator import inverse_2x2
from semi_analytical.padded_transform import Convolutions
from semi_analytical.sines import MOST_BY_MATRIX, Sines, at_sines, cosines

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Side = Cosines | Sines
# Amplitudes (columns, mx) of every component at some wavenumbers along y, and which.
Multiply = Callable[[Sequence[Field], slice], Sequence[Field]]


class MirroredTangentialOperator:
    """(u_x, u_y) by shear (q_x, q_y) on the quarter x > 0, y > 0, each (2, nx, ny); one call is two
    convolutions.

    What `TangentialOperator` gives of the whole fields, twice as long along each side.

    along    component that is even about both planes; the other is odd about both
    symbols  spectra of the xx, yy and xy coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        along: int,
        counter: Convolutions,
    ) -> None:
        self.shape, self.along, self._counter = shape, along, counter
        m_x, m_y = (2 * int(next_fast_len(n)) for n in shape)
        reach = slice(m_x + 1), slice(m_y + 1)
        self.symbols = (
            even_transform(coefficients.xx[reach]),
            even_transform(coefficients.yy[reach]),
            odd_transform(coefficients.xy[reach]),
        )
        even = cosines(shape[0], m_x), cosines(shape[1], m_y)
        odd = Sines(shape[0], m_x), Sines(shape[1], m_y)
        self._sides = _in_order(even, odd, along)

    def __call__(self, shear: VectorField) -> VectorField:
        """Tangential displacement caused by a shear traction."""
        self._counter.count += 2
        return filtered(shear, self._sides, self._multiplied)

    @cached_property
    def _kernel(self) -> "PairOfSpectra":
        xx, yy, xy = (symbol.quarter for symbol in self.symbols)
        return PairOfSpectra(xx, yy, xy, self.along)

    def _multiplied(self, amplitudes: Sequence[Field], columns: slice) -> Sequence[Field]:
        return self._kernel.times(amplitudes, columns)


class PairOfSpectra:
    """A symmetric matrix at every wavenumber, times amplitudes of a vector whose component `along`
    is even about both planes, the other odd about both."""

    def __init__(self, xx: Field, yy: Field, xy: Field, along: int) -> None:
        """Each at the wavenumbers 0 … my and 0 … mx."""
        of_even = np.ascontiguousarray((xx, yy)[along][:-1, :-1])
        of_odd = at_sines((yy, xx)[along])
        self._xx, self._yy = (of_even, of_odd)[:: 1 - 2 * along]
        # The spectrum of what is odd about both planes is -1 times its sines.
        self._across = np.ascontiguousarray(-xy[:-1, :-1])

    def times(self, amplitudes: Sequence[Field], columns: slice) -> Sequence[Field]:
        """In the memory of the amplitudes (columns, mx) of both components."""
        x, y = amplitudes
        across = self._across[columns]
        beside = across * x
        x *= self._xx[columns]
        x += across * y
        y *= self._yy[columns]
        y += beside
        return amplitudes


class MirroredPeriodicInverse:
    """What `PeriodicInverse` gives of the whole fields, on a quarter: shear by tangential
    displacement, and behind it shears of one component, odd about both planes, that are held back
    by the stiffnesses of the grades besides."""

    def __init__(self, tangential: MirroredTangentialOperator, self_compliance: float) -> None:
        xx, yy, xy = (symbol.quarter[::2, ::2] for symbol in tangential.symbols)
        mean = np.abs(0.5 * (xx + yy))
        self._turning = [at_sines(1 / (mean + self_compliance * d)) for d in STIFFNESSES]
        self._pair = PairOfSpectra(*inverse_2x2(xx, yy, xy), tangential.along)
        nx, ny = tangential.shape
        my, mx = self._turning[0].shape
        even, odd = (cosines(nx, mx), cosines(ny, my)), (Sines(nx, mx), Sines(ny, my))
        self._sides = _in_order(even, odd, tangential.along)
        self._turned = [odd] * len(STIFFNESSES)

    def __call__(self, displacements: Field) -> Field:
        """Tractions (2 + grades, nx, ny) of displacements of that shape."""
        sides = [*self._sides, *self._turned[: len(displacements) - 2]]
        return filtered(displacements, sides, self._multiplied)

    def _multiplied(self, amplitudes: Sequence[Field], columns: slice) -> Sequence[Field]:
        self._pair.times(amplitudes[:2], columns)
        for one, symbol in zip(amplitudes[2:], self._turning, strict=False):
            one *= symbol[columns]
        return amplitudes


def _in_order(
    even: tuple[Side, Side], odd: tuple[Side, Side], along: int
) -> list[tuple[Side, Side]]:
    """Of the components x and y, where that along is even."""
    return [even, odd] if along == 0 else [odd, even]


def filtered(
    values: VectorField, sides: Sequence[tuple[Side, Side]], multiply: Multiply
) -> VectorField:
    """Fields (components, nx, ny) with their amplitudes multiplied.

    sides  along x and y, of every component
    """
    result, m = np.empty_like(values), sides[0][0].m
    if max(values.shape[1:]) <= MOST_BY_MATRIX:  # a product takes the other order as it is
        block = [x.forward(y.forward(one).T) for one, (x, y) in zip(values, sides, strict=True)]
        block = list(multiply(block, slice(None)))
        for into, one, (x, y) in zip(result, block, sides, strict=True):
            into[...] = y.back(x.back(one).T)
        return result
    lines = [y.forward(one) for one, (_, y) in zip(values, sides, strict=True)]
    width = max(1, BLOCK // m)
    for first in range(0, sides[0][1].m, width):
        columns = slice(first, min(first + width, sides[0][1].m))
        block = [x.forward(a[:, columns].T) for a, (x, _) in zip(lines, sides, strict=True)]
        for a, b, (x, _) in zip(lines, multiply(block, columns), sides, strict=True):
            a[:, columns] = x.back(b).T
    for into, a, (_, y) in zip(result, lines, sides, strict=True):
        into[...] = y.back(a)
    return result
