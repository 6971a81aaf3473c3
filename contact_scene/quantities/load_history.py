"""Load history as a result of any solver: increments, ends of the load steps, table and text."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.quantities.increment import SCALARS, ReportedIncrement, components, numbers
from contact_scene.quantities.per_length import shown_mark, shown_name
from contact_scene.quantities.round_off import ROUND_OFF, natural_size
from contact_scene.reading.engineering_units import quantity

if TYPE_CHECKING:
    from contact_scene.scene import Scene

I_co = TypeVar("I_co", bound=ReportedIncrement, covariant=True)


class LoadHistory(ABC, Generic[I_co]):
    """Base class of the results of all solvers.

    scene       solved scene
    increments  converged states at the ends of all increments of the load history, in order
    """

    scene: Scene
    increments: tuple[I_co, ...]

    @property
    @abstractmethod
    def solver(self) -> str:
        """Name of the solver, with the contact method of finite elements."""

    @property
    def steps(self) -> tuple[I_co, ...]:
        """Converged states at the ends of the load steps: their last increments, in order."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)

    def table(self) -> dict[str, NDArray[np.float64] | NDArray[np.int64]]:
        """Return the scalars of all increments as columns, in SI units.

        The names are those of `increments.csv`: step, increment, and scalars with _x and _y for
        the components of vectors. Undefined values are NaN; scalars that no increment has are left
        out. `pandas.DataFrame(result.table())` is a table.

        Returns arrays (n,) by name, for n increments.
        """
        line = self.scene.indenter.is_line
        rows = [numbers(each) for each in self.increments]
        columns: dict[str, NDArray[np.float64] | NDArray[np.int64]] = {
            "step": np.array([each.step for each in self.increments]),
            "increment": np.array([each.index for each in self.increments]),
        }
        for part in (part for name in SCALARS for part in components(name)):
            values = np.array([row[part] for row in rows], dtype=np.float64)
            if not np.all(np.isnan(values)):
                columns[shown_name(part, line=line)] = values
        return columns

    def __repr__(self) -> str:
        """Return a text of three lines: solver and title, increments, numbers at the end.

        Numbers below round-off and below the residual of the last increment are left out.
        """
        line, end = self.scene.indenter.is_line, self.increments[-1]
        values = numbers(end)
        negligible = max(ROUND_OFF, end.residuals.worst)
        texts = []
        for name, mark in SCALARS.items():
            if mark.key:
                known = {part: values[part] or 0.0 for part in components(name)}
                size = max(natural_size(self.steps, mark.unit or ""), *map(abs, known.values()))
                unit = shown_mark(name, mark, line=line).unit or ""
                texts += [
                    f"{shown_name(part, line=line).replace('_', ' ')} {quantity(value, unit)}"
                    for part, value in known.items()
                    if abs(value) > negligible * size
                ]
        return (
            f"{self.scene.title or 'contact'}, solved by {self.solver}\n"
            f"load steps: {len(self.steps)}, increments: {len(self.increments)}\n"
            f"at the end: {', '.join(texts)}"
        )
