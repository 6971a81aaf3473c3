"""Fields on a part of the window by amplitudes along both axes: cosines and sines where the axis
has a mirror plane, waves where it has none.

Responses to tractions are real numbers between the amplitudes of fields, a symmetric matrix at
every pair of wavenumbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from semi_analytical.mirrored_transform import BLOCK
from semi_analytical.padded_transform import offsets_for
from semi_analytical.part import Pair, Parity, Part
from semi_analytical.sines import MOST_BY_MATRIX, Sines, cosines
from semi_analytical.waves import Waves

Field = NDArray[np.float64]
Precision = np.dtype[np.floating[Any]]
DOUBLE: Precision = np.dtype(np.float64)
# Amplitudes (columns, along x) of every component at some of those along y, and which.
Multiply = Callable[[Sequence[Field], slice], Sequence[Field]]


class Side(Protocol):
    """Values along the last axis to their amplitudes, and back; see `Cosines`, `Sines`, `Waves`."""

    @property
    def count(self) -> int:
        """Of the amplitudes."""

    def forward(self, values: Field) -> Field:
        """To the amplitudes."""

    def back(self, amplitudes: Field) -> Field:
        """To the values."""


Sides = tuple[Side, Side]


@dataclass(frozen=True)
class Periods:
    """After how many cells fields on `shape` cells of a part repeat, with their images.

    padded    twice the shape with its images or more: as long as convolutions ask for
    unpadded  half of that
    """

    shape: Pair
    part: Part

    @property
    def unpadded(self) -> Pair:
        """Along x and y."""
        x, y = offsets_for(self.part.window(self.shape))
        return x - 1, y - 1

    @property
    def padded(self) -> Pair:
        """Along x and y."""
        x, y = self.unpadded
        return 2 * x, 2 * y

    @property
    def reach(self) -> tuple[slice, slice]:
        """Offsets of influence coefficients that are needed."""
        x, y = self.unpadded
        return slice(x + 1), slice(y + 1)

    def sides(
        self, parities: Sequence[Parity], periods: Pair, precision: Precision = DOUBLE
    ) -> list[Sides]:
        """Along x and y, of fields of these parities."""
        return [
            (
                _side(parity.signs[0], parity.turned, self.shape[0], periods[0], precision),
                _side(parity.signs[1], parity.turned, self.shape[1], periods[1], precision),
            )
            for parity in parities
        ]


@lru_cache(maxsize=64)
def _side(sign: int, turned: bool, cells: int, period: int, precision: Precision) -> Side:
    if sign == 0:
        return Waves(cells, period, turned=turned)
    m = period // 2
    return cosines(cells, m, precision) if sign > 0 else Sines(cells, m, precision)


class Responses:
    """What some components of a field answer to others, at every pair of wavenumbers."""

    def __init__(self, rows: Sequence[Sequence[Field]]) -> None:
        self._rows = rows

    def times(self, amplitudes: Sequence[Field], columns: slice) -> Sequence[Field]:
        """Those of the answers (columns, along x)."""
        return [_sum(row, amplitudes, columns) for row in self._rows]


def _sum(row: Sequence[Field], amplitudes: Sequence[Field], columns: slice) -> Field:
    total = row[0][columns] * amplitudes[0]
    for entry, one in zip(row[1:], amplitudes[1:], strict=True):
        total += entry[columns] * one
    return total


def between(spectrum: Field, one: Parity, other: Parity, factor: complex = 1.0) -> Field:
    """Between the amplitudes of fields of two parities, of a response with this spectrum, times a
    factor.

    spectrum  (along y, along x) at the wavenumbers from 0 to the largest; that of fields of which
              one is even and one odd vanishes at the first and the last
    """
    sign = (one.phase.conjugate() * factor * other.phase).real
    for axis, (a, b) in enumerate(zip(one.signs[::-1], other.signs[::-1], strict=True)):
        spectrum = np.moveaxis(_in_order(np.moveaxis(spectrum, axis, 0), a, b), 0, axis)
    return np.ascontiguousarray(round(sign) * spectrum)


def _in_order(spectrum: Field, one: int, other: int) -> Field:
    """Lines in the order of the amplitudes: waves have two each, and sines have the largest
    wavenumber in the place of 0."""
    if one == 0:
        return np.repeat(spectrum, 2, axis=0)
    if one == other == -1:
        return np.concatenate([spectrum[-1:], spectrum[1:-1]])
    return spectrum[:-1]


def filtered(
    values: Field,
    sides: Sequence[Sides],
    multiply: Multiply,
    answers: Sequence[Sides] | None = None,
) -> Field:
    """Fields (components, nx, ny) with their amplitudes multiplied.

    sides    along x and y, of every component
    answers  those of the components that come out; the same if absent
    """
    answers = sides if answers is None else answers
    _, nx, ny = values.shape
    result = np.empty((len(answers), nx, ny), dtype=values.dtype)
    if max(nx, ny) <= MOST_BY_MATRIX:  # a product takes the other order as it is
        block = [x.forward(y.forward(one).T) for one, (x, y) in zip(values, sides, strict=True)]
        block = list(multiply(block, slice(None)))
        for into, one, (x, y) in zip(result, block, answers, strict=True):
            into[...] = y.back(x.back(one).T)
        return result
    lines = [y.forward(one) for one, (_, y) in zip(values, sides, strict=True)]
    lines += [np.empty_like(lines[0]) for _ in range(len(lines), len(answers))]
    x, y = sides[0]
    width = max(1, BLOCK // x.count)
    for first in range(0, y.count, width):
        columns = slice(first, min(first + width, y.count))
        block = [x.forward(a[:, columns].T) for a, (x, _) in zip(lines, sides, strict=False)]
        for a, b, (x, _) in zip(lines, multiply(block, columns), answers, strict=False):
            a[:, columns] = x.back(b).T
    for into, a, (_, y) in zip(result, lines, answers, strict=False):
        into[...] = y.back(a)
    return result
