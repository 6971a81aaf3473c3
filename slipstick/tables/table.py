"""A table over dimensionless parameters, and how uncertain its numbers are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

ROUND_OFF = 1e-13
TIMES = 2.0
UNCERTAINTY = (
    "twice the change of a number by twice as many orders and points, what is left of the load, "
    f"and {ROUND_OFF:g} of the number for round-off"
)


# Of parameters that have no bounds of their own: farther from one nothing is a contact.
FARTHEST = 1e12


@dataclass(frozen=True)
class Axis:
    """A parameter.

    meaning  in words
    values   that are tabulated unless somebody names others
    least    values are larger than this
    most     and at most this
    """

    meaning: str
    values: tuple[float, ...]
    least: float = 1 / FARTHEST
    most: float = FARTHEST


@dataclass(frozen=True)
class Found:
    """Quantities at one point, in the order of the table.

    missed  by what part of itself the load was
    left    what each is uncertain by beside that and what doubling tells, absolute; none if absent
    """

    values: tuple[float, ...]
    missed: float = 0.0
    left: tuple[float, ...] = ()


@dataclass(frozen=True)
class Table:
    """What is tabulated.

    axes        parameters by name, the first varies slowest
    quantities  meanings by name
    problem     what is solved
    source      of the equations
    at          quantities at parameters, in the order of the axes, with so many times as many
                orders and points, or rings and increments, as it takes
    uncertainty  how it is found
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
        """Meanings by name: parameters, quantities, and the uncertainty of each of these."""
        parameters = {name: axis.meaning for name, axis in self.axes.items()}
        uncertain = {f"{name}_uncertainty": f"of {name}, absolute" for name in self.quantities}
        return {**parameters, **self.quantities, **uncertain}

    def rows(self, chosen: Mapping[str, Sequence[float]]) -> Iterator[dict[str, float]]:
        """A row by column for all combinations, of chosen values or those of the axes."""
        for place in product(*(chosen.get(name, axis.values) for name, axis in self.axes.items())):
            found, finer = self.at(place, 1), self.at(place, 2)
            left = found.left or (0.0,) * len(found.values)
            uncertainties = (
                TIMES * abs(value - other) + (found.missed + ROUND_OFF) * abs(value) + more
                for value, other, more in zip(found.values, finer.values, left, strict=True)
            )
            yield dict(zip(self.columns, (*place, *found.values, *uncertainties), strict=True))
