"""Tables of reference numbers with uncertainties, as functions of dimensionless parameters."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from contact_results.directory.machine import program_version
from contact_scene.checks.axisymmetric import ELSEWHERE
from contact_scene.solver_errors import UnsupportedScene

ROUND_OFF = 1e-13
TIMES = 2.0
UNCERTAINTY = (
    "2 times the change of a number for 2 times the orders and points, plus the relative error of "
    f"the load, plus {ROUND_OFF:g} of the number for round-off"
)
FARTHEST = 1e12  # default bound of a parameter


@dataclass(frozen=True)
class Axis:
    """Dimensionless parameter of a table of reference numbers.

    meaning  description of the parameter
    values   default values at which rows are computed
    least    lower bound, exclusive
    most     upper bound, inclusive
    """

    meaning: str
    values: tuple[float, ...]
    least: float = 1 / FARTHEST
    most: float = FARTHEST


@dataclass(frozen=True)
class RowValues:
    """Computed quantities of one row of a table of reference numbers, with their errors.

    values  quantities in the order of the table
    missed  relative difference of the computed normal force from the prescribed force
    left    additional absolute uncertainty of each quantity; empty for none
    """

    values: tuple[float, ...]
    missed: float = 0.0
    left: tuple[float, ...] = ()


@dataclass(frozen=True)
class Dataset:
    """Computed rows of a table, with meanings of the columns and provenance.

    about    name, problem, method, source and uncertainty of the table
    columns  meaning of each column by name
    rows     values by column name
    """

    about: Mapping[str, str]
    columns: Mapping[str, str]
    rows: Sequence[Mapping[str, Any]]

    def csv(self) -> str:
        """Return the rows as CSV text.

        The first lines begin with '#' and state provenance and meanings of the columns.
        """
        head = [f"# {key}: {text}" for key, text in {**self.about, **self.columns}.items()]
        lines = [
            ",".join(_format_value(key, row[key]) for key in self.columns) for row in self.rows
        ]
        return "\n".join([*head, ",".join(self.columns), *lines, ""])

    def json(self) -> str:
        """Return rows, provenance and meanings as JSON text."""
        document = {**self.about, "columns": self.columns, "rows": self.rows}
        return json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False) + "\n"


@dataclass(frozen=True)
class Table:
    """Definition of a table of reference numbers for one contact problem.

    axes         parameters by name; the first varies slowest
    quantities   meanings of the computed quantities by name
    problem      description of the contact
    source       reference of the equations
    at           function that computes the quantities of a row, from the values of the parameters
                 and a factor of the discretisation: of orders and points, or of rings and
                 increments
    uncertainty  description of the uncertainty
    """

    name: str
    axes: Mapping[str, Axis]
    quantities: Mapping[str, str]
    problem: str
    source: str
    at: Callable[[Sequence[float], int], RowValues]
    uncertainty: str = UNCERTAINTY

    @property
    def columns(self) -> dict[str, str]:
        """Meanings of all columns by name: parameters, quantities and their uncertainties."""
        parameters = {name: axis.meaning for name, axis in self.axes.items()}
        uncertain = {f"{name}_uncertainty": f"of {name}, absolute" for name in self.quantities}
        return {**parameters, **self.quantities, **uncertain}

    def rows(self, chosen: Mapping[str, Sequence[float]]) -> Iterator[dict[str, float]]:
        """Yield one row for every combination of parameter values, with values by column name.

        The uncertainty of a quantity is twice its change for the doubled discretisation. The error
        of the normal force, round-off and additional uncertainties are added.

        chosen  values by parameter name, which replace the default values

        Raises UnsupportedScene for values at which the radial solver refuses the contact.
        """
        for place in product(*(chosen.get(name, axis.values) for name, axis in self.axes.items())):
            try:
                found, finer = self.at(place, 1), self.at(place, 2)
            except UnsupportedScene as refused:
                given = ", ".join(f"{n}={v:g}" for n, v in zip(self.axes, place, strict=True))
                reason = str(refused).partition(f"; {ELSEWHERE}")[0]
                raise UnsupportedScene(
                    f"{given}: {reason}. Choose other values with --over"
                ) from None
            left = found.left or (0.0,) * len(found.values)
            uncertainties = (
                TIMES * abs(value - other) + (found.missed + ROUND_OFF) * abs(value) + more
                for value, other, more in zip(found.values, finer.values, left, strict=True)
            )
            yield dict(zip(self.columns, (*place, *found.values, *uncertainties), strict=True))

    def dataset(self, chosen: Mapping[str, Sequence[float]]) -> Dataset:
        """Compute all rows of the table, and return them with their provenance.

        chosen  values by parameter name, which replace the default values
        """
        about = {
            "table": self.name,
            "made_by": f"slipstick {program_version()}, radial solver",
            "problem": self.problem,
            "source": self.source,
            "uncertainty": self.uncertainty,
        }
        return Dataset(about, self.columns, list(self.rows(chosen)))


def _format_value(column: str, value: Any) -> str:
    """Format uncertainties with 2 digits, other floats with 15 digits."""
    if not isinstance(value, float):
        return str(value)
    return f"{value:.1e}" if column.endswith("uncertainty") else f"{value:.15g}"
