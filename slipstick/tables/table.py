"""Table of numbers with uncertainties over dimensionless parameters."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from contact_results.directory.machine import program_version

ROUND_OFF = 1e-13
TIMES = 2.0
UNCERTAINTY = (
    "2 times the change of a number for 2 times the orders and points, plus the relative error of "
    f"the load, plus {ROUND_OFF:g} of the number for round-off"
)
FARTHEST = 1e12  # default bound of a parameter


@dataclass(frozen=True)
class Axis:
    """Parameter of a table.

    values  default values
    least   lower bound, exclusive
    most    upper bound, inclusive
    """

    meaning: str
    values: tuple[float, ...]
    least: float = 1 / FARTHEST
    most: float = FARTHEST


@dataclass(frozen=True)
class Found:
    """Quantities at one point, in the order of the table.

    missed  relative error of the load
    left    additional absolute uncertainty of each quantity; empty for none
    """

    values: tuple[float, ...]
    missed: float = 0.0
    left: tuple[float, ...] = ()


@dataclass(frozen=True)
class Dataset:
    """Rows of a table with their meaning and provenance.

    about    name, problem, method, source and uncertainty
    columns  meanings by name
    rows     values by column
    """

    about: Mapping[str, str]
    columns: Mapping[str, str]
    rows: Sequence[Mapping[str, Any]]

    def csv(self) -> str:
        """Return CSV text. Its first lines begin with '#' and state provenance and meanings."""
        head = [f"# {key}: {text}" for key, text in {**self.about, **self.columns}.items()]
        lines = [",".join(_digits(key, row[key]) for key in self.columns) for row in self.rows]
        return "\n".join([*head, ",".join(self.columns), *lines, ""])

    def json(self) -> str:
        """Return JSON text."""
        document = {**self.about, "columns": self.columns, "rows": self.rows}
        return json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False) + "\n"


@dataclass(frozen=True)
class Table:
    """Definition of a table.

    axes        parameters by name; the first varies slowest
    quantities  meanings by name
    problem     description of the contact
    source      reference of the equations
    at          function of the parameters and a factor of the discretisation: orders and points, or
                rings and increments
    uncertainty  description of the uncertainty
    """

    name: str
    axes: Mapping[str, Axis]
    quantities: Mapping[str, str]
    problem: str
    source: str
    at: Callable[[Sequence[float], int], Found]
    uncertainty: str = UNCERTAINTY

    @property
    def columns(self) -> dict[str, str]:
        """Meanings by name: parameters, quantities, and uncertainties of the quantities."""
        parameters = {name: axis.meaning for name, axis in self.axes.items()}
        uncertain = {f"{name}_uncertainty": f"of {name}, absolute" for name in self.quantities}
        return {**parameters, **self.quantities, **uncertain}

    def rows(self, chosen: Mapping[str, Sequence[float]]) -> Iterator[dict[str, float]]:
        """Yield one row, by column, for every combination of the chosen or default values."""
        for place in product(*(chosen.get(name, axis.values) for name, axis in self.axes.items())):
            found, finer = self.at(place, 1), self.at(place, 2)
            left = found.left or (0.0,) * len(found.values)
            uncertainties = (
                TIMES * abs(value - other) + (found.missed + ROUND_OFF) * abs(value) + more
                for value, other, more in zip(found.values, finer.values, left, strict=True)
            )
            yield dict(zip(self.columns, (*place, *found.values, *uncertainties), strict=True))

    def dataset(self, chosen: Mapping[str, Sequence[float]]) -> Dataset:
        """Compute the rows at the chosen or default values."""
        about = {
            "table": self.name,
            "made_by": f"slipstick {program_version()}, radial solver",
            "problem": self.problem,
            "source": self.source,
            "uncertainty": self.uncertainty,
        }
        return Dataset(about, self.columns, list(self.rows(chosen)))


def _digits(column: str, value: Any) -> str:
    if not isinstance(value, float):
        return str(value)
    return f"{value:.1e}" if column.endswith("uncertainty") else f"{value:.15g}"
