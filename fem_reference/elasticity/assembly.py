"""Matrices of elements, gathered into the one of the section."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from fem_reference.elasticity.numbering import Numbering

Field = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Elements:
    """Matrices over displacements, component by component, and over pressures.

    matrix    (e, 9 c + q, 9 c + q)
    nodes     (e, 9)
    pressure  (e, q) their unknowns
    """

    matrix: Field
    nodes: Indices
    pressure: Indices

    def unknowns(self, numbering: Numbering) -> tuple[Indices, Field]:
        """(e, 9 c + q) unknowns, and their factors."""
        one = np.ones(self.pressure.shape)
        column = np.concatenate([self._local(numbering.column), self.pressure], axis=1)
        return column, np.concatenate([self._local(numbering.factor), one], axis=1)

    def values(self, field: Field) -> Field:
        """(e, 9 c + q) values of a displacement (c, n) without pressure."""
        return np.concatenate([self._local(field), np.zeros(self.pressure.shape)], axis=1)

    def _local(self, field: NDArray[Any]) -> NDArray[Any]:
        count = len(field) * self.nodes.shape[1]
        return field[:, self.nodes].transpose(1, 0, 2).reshape(len(self.nodes), count)


def with_pressure(expansion: Field, compliance: Field) -> Field:
    """(e, 9 c + 3, 9 c + 3) volume strain = p / lambda, beside the forces of the pressure."""
    count = expansion.shape[2]
    matrix = np.zeros((len(expansion), count + 3, count + 3))
    matrix[:, count:, :count] = expansion
    matrix[:, :count, count:] = expansion.transpose(0, 2, 1)
    matrix[:, count:, count:] = -compliance[:, None, None] * np.eye(3)
    return matrix


def assembled(blocks: Iterable[Elements], numbering: Numbering) -> csc_array:
    """The sparse matrix over all unknowns; explicit zeros stay, for they will be filled."""
    rows, columns, values = [], [], []
    for block in blocks:
        column, factor = block.unknowns(numbering)
        matrix = block.matrix * factor[:, :, None] * factor[:, None, :]
        row = np.broadcast_to(column[:, :, None], matrix.shape)
        kept = (row >= 0) & (row.transpose(0, 2, 1) >= 0)
        rows.append(row[kept])
        columns.append(row.transpose(0, 2, 1)[kept])
        values.append(matrix[kept])
    place = (np.concatenate(rows), np.concatenate(columns))
    return csc_array((np.concatenate(values), place), shape=(numbering.size, numbering.size))
