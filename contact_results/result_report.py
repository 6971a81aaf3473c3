"""Result of a solver together with what its files share: surface, load cycles, stated errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from contact_results.cycles import FrettingCycle, fretting_cycles
from contact_results.surface import Surface, surface_of

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result
    from contact_scene import Scene
    from contact_scene.quantities.stated_error import AccuracyReached, StatedError, StatedErrors


@dataclass(frozen=True, eq=False)
class ResultReport:
    """Result of any solver with the quantities that summary, tables, figures and page share.

    surface    surface grid that carries the fields
    cycles     closed load cycles; empty before `with_cycles`
    errors     stated errors; None if they were not computed
    accuracy   requested and reached accuracy; None if none was requested
    by_inputs  table of the uncertainty by inputs, as columns by heading; None without
    """

    result: Result
    surface: Surface
    cycles: tuple[FrettingCycle, ...] = ()
    errors: StatedErrors | None = None
    accuracy: AccuracyReached | None = None
    by_inputs: Mapping[str, Sequence[str]] | None = None

    @classmethod
    def of(cls, result: Result, errors: StatedErrors | None = None) -> ResultReport:
        """Create the report of a result, without load cycles.

        errors  stated errors; None if they were not computed
        """
        return cls(result, surface_of(result), errors=errors)

    def with_cycles(self) -> ResultReport:
        """Return the report with the closed load cycles of the result."""
        return replace(self, cycles=fretting_cycles(self.result))

    @property
    def scene(self) -> Scene:
        """Scene of the result."""
        return self.result.scene

    @property
    def increments(self) -> Sequence[Increment]:
        """All increments of the load history."""
        return self.result.increments

    @property
    def steps(self) -> Sequence[Increment]:
        """Last increment of each load step."""
        return self.result.steps

    @property
    def step_errors(self) -> Sequence[Mapping[str, StatedError]] | None:
        """Stated errors of the scalars of every load step, by name; None if not computed."""
        return None if self.errors is None else self.errors.steps

    def errors_of(self, cycle: FrettingCycle) -> Mapping[str, StatedError]:
        """Return the stated errors of a load cycle by name; empty if not computed."""
        return {} if self.errors is None else self.errors.steps[cycle.cycle.end - 1]

    @property
    def end_errors(self) -> Mapping[str, StatedError] | None:
        """Stated errors of the scalars of the last load step, by name; None if not computed."""
        return None if self.errors is None else self.errors.steps[-1]
