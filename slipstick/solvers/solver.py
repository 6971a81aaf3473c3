"""Common interface of the solvers for the commands and for scripts, and texts of time estimates."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from contact_scene.disk_cache import without_cache
from contact_scene.solver_errors import ContactNotResolved, SolverError

if TYPE_CHECKING:
    from contact_errors.adaptive_refinement import Levels
    from contact_errors.coarse_solves import DiscretisedSolver
    from contact_results.surface import Result
    from contact_scene import (
        FiniteElementDiscretisation,
        RadialDiscretisation,
        Scene,
        SceneFile,
        SurfaceDiscretisation,
    )
    from contact_scene.quantities.increment import ReportedIncrement
    from contact_scene.quantities.stated_error import StatedErrors
    from contact_scene.stepping.checkpoint import CheckpointStore

    Discretisation: TypeAlias = (
        SurfaceDiscretisation | FiniteElementDiscretisation | RadialDiscretisation
    )

Progress: TypeAlias = Callable[["ReportedIncrement"], None]
Pairs: TypeAlias = Iterator[tuple[str, str]]

MAX_STEPS_SHOWN = 12


class Solver(ABC):
    """Interface of a solver for the commands and for scripts.

    The plans of all solvers have the attributes `effects` and `increments`.

    table           name of the solver's table in a scene file
    discretisation  class of the settings in this table
    """

    table: str
    discretisation: type[Discretisation]

    @property
    @abstractmethod
    def refinable(self) -> type[DiscretisedSolver]:
        """Class of the same solver with variable discretisation, imported on access."""

    def fineness(self, contents: SceneFile) -> Any:
        """Return the discretisation settings for this solver in a scene file."""
        return getattr(contents, self.table)

    @abstractmethod
    def plan(self, scene: Scene, fineness: Any) -> Any:
        """Return the plan of a solve: modelled effects, and increments of each load step.

        Raises UnsupportedScene if the solver cannot solve the scene.

        fineness  discretisation settings
        """

    @abstractmethod
    def solve(
        self,
        scene: Scene,
        fineness: Any,
        plan: Any,
        progress: Progress | None = None,
        store: CheckpointStore | None = None,
    ) -> Result:
        """Solve a scene with a plan, and return the result; raises a SolverError.

        fineness  discretisation settings
        progress  function that is called after every increment, or None
        store     checkpoint store, or None
        """

    def errors(self, result: Any) -> StatedErrors:
        """Estimate the errors of all scalars of a result by coarse solves."""
        return self.refinable.stated_errors(result)

    @abstractmethod
    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> DiscretisedSolver:
        """Return this solver for one scene with variable discretisation, for refinement.

        fineness  discretisation settings of the scene file
        stress    true if a requested accuracy applies to a stress in the body
        """

    def levels(
        self, scene: Scene, fineness: Any, stress: bool, *hooks: Any, step: int | None = None
    ) -> Levels:
        """Return the sequence of refinement levels of a scene, for a requested accuracy.

        stress  true if the accuracy applies to the largest tensile stress in the body
        hooks   further arguments of `Levels`: contexts for progress and checkpoints of each solve
        step    load step at whose end this stress is computed, from 1; None for the last
        """
        from contact_errors.adaptive_refinement import Levels

        stress_at = (step or len(scene.loading)) if stress else None
        return Levels(self.refined(scene, fineness, stress), stress_at, *hooks)

    def time(self, scene: Scene, fineness: Any) -> tuple[str, str]:
        """Estimate the CPU time of a run with its error estimate by a trial solve.

        Returns the word "time" and the text of the estimate, or the reason why there is none.
        Raises ContactNotResolved if no coarse discretisation resolves the contact.

        fineness  discretisation settings
        """
        from contact_errors.trial_solve import estimate_seconds

        solver = self.refined(scene, fineness)
        try:
            with without_cache():
                seconds = estimate_seconds(solver, solver.of_run())
        except ContactNotResolved:
            raise
        except SolverError as error:
            return "time", f"not estimated, since a trial solve failed: {error}"
        return "time", f"{time_text(seconds)} of one core, error estimates included"

    @abstractmethod
    def work(self, scene: Scene, fineness: Any, plan: Any) -> Pairs:
        """Yield names and texts of discretisation, time and memory of a planned solve."""

    def reasons(self, plan: Any) -> Sequence[tuple[str, str, str]]:
        """Return load step, number of increments and reason of this number, as texts for a table.

        The sequence is empty if the solver states no reasons.
        """
        return ()

    @abstractmethod
    def layout(self, result: Any) -> Pairs:
        """Yield names and texts of the discretisation of a result."""


def increments_text(counts: tuple[int, ...]) -> str:
    """Return the text of the numbers of increments, such as "30 = 10 + 20 in 2 steps".

    counts  number of increments of each load step
    """
    if len(counts) == 1:
        return str(counts[0])
    shown = " + ".join(map(str, counts[:MAX_STEPS_SHOWN]))
    more = " + …" if len(counts) > MAX_STEPS_SHOWN else ""
    return f"{sum(counts)} = {shown}{more} in {len(counts)} steps"


def time_text(seconds: float) -> str:
    """Return the text of a time in seconds, minutes or hours."""
    if seconds < 1:
        return "less than 1 s"
    if seconds < 120:
        return f"about {float(f'{seconds:.2g}'):g} s"
    if seconds < 7200:
        return f"about {seconds / 60:.2g} min"
    return f"about {seconds / 3600:.2g} h"
