"""The end of the studied step on one level of refinement, as a row, whoever solved it.

parameters  level, in words; size h: side of a cell [length], or dimensionless what is refined
measures    scalars by the names of `summary.json`, components with x or y, the undefined left out;
            the largest residual
counters    increments, and work by what is counted
fields      tractions, by PRESSURE and SHEAR
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from verification.convergence.stored_field import StoredField
from verification.quantities import largest_residual, named_values, unit_of
from verification.running.row import CaseRecord, Row, Value
from verification.running.rules import RESIDUAL

INCREMENTS = "increments"


class SolvedLevel(Protocol):
    """What was asked of a level."""

    @property
    def size(self) -> float: ...

    @property
    def level(self) -> str: ...

    @property
    def increments(self) -> tuple[int, ...]: ...


def level_row(
    level: SolvedLevel,
    result: Any,
    fields: Mapping[str, StoredField],
    work: Mapping[str, int],
) -> CaseRecord:
    """What is kept of a result."""
    values = named_values(result.steps[-1])
    parameters: dict[str, Value] = {"level": level.level, "size": level.size}
    return CaseRecord(
        parameters=parameters,
        measures={**values, RESIDUAL: largest_residual(result)},
        units={name: unit_of(name) for name in values},
        counters={INCREMENTS: sum(level.increments), **work},
        fields=dict(fields),
    )


def values_of(row: Row) -> dict[str, float]:
    """Scalars of the solution."""
    return {n: v for n, v in row.measures.items() if n != RESIDUAL and v is not None}


def work_of(row: Row) -> dict[str, int]:
    """Counted work."""
    return {name: count for name, count in row.counters.items() if name != INCREMENTS}


def size_of(row: Row) -> float:
    """What the level refines."""
    size = row.parameters["size"]
    assert isinstance(size, float)
    return size
