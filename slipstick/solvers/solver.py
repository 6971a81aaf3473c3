"""Interface of the solvers for commands and scripts."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from contact_errors.cost_estimate import T, Work, cpu_seconds, estimated_run_seconds
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
    """Interface of a solver. The plans of all solvers have `effects` and `increments`.

    table           name of its table in a scene file
    discretisation  class of this table
    refinable       class of the solver with a refinable discretisation, for error estimates
    """

    table: str
    discretisation: type[Discretisation]
    refinable: type[DiscretisedSolver]

    def fineness(self, contents: SceneFile) -> Any:
        """Return the discretisation that a scene file contains for this solver."""
        return getattr(contents, self.table)

    @abstractmethod
    def plan(self, scene: Scene, fineness: Any) -> Any:
        """Return the plan of a solve; raise UnsupportedScene."""

    @abstractmethod
    def solve(
        self,
        scene: Scene,
        fineness: Any,
        plan: Any,
        progress: Progress | None = None,
        store: CheckpointStore | None = None,
    ) -> Result:
        """Return the result of a plan; raise a SolverError."""

    def errors(self, result: Any) -> StatedErrors:
        """Estimate the errors of a result by coarse solves."""
        return self.refinable.stated_errors(result)

    @abstractmethod
    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> DiscretisedSolver:
        """Return the solver of a scene with a refinable discretisation.

        stress  true if a stress in the body is required
        """

    def levels(
        self, scene: Scene, fineness: Any, stress: bool, *hooks: Any, step: int | None = None
    ) -> Levels:
        """Return the refinement levels of a scene.

        stress  true if the stress at the end of a load step is required, of the last by default
        hooks   arguments of `Levels`: progress and checkpoints of its solves
        """
        from contact_errors.adaptive_refinement import Levels

        stress_at = (step or len(scene.loading)) if stress else None
        return Levels(self.refined(scene, fineness, stress), stress_at, *hooks)

    @abstractmethod
    def work(self, scene: Scene, fineness: Any, plan: Any) -> Pairs:
        """Yield names and texts of the discretisation, time and memory of a solve."""

    def reasons(self, plan: Any) -> Sequence[tuple[str, str, str]]:
        """Return number, increments and reason of load steps; empty if none has a reason."""
        return ()

    @abstractmethod
    def layout(self, result: Any) -> Pairs:
        """Yield names and texts of the discretisation of a result."""


def increments_text(counts: tuple[int, ...]) -> str:
    """Return the text of the number of increments: total and, for the first steps, by step."""
    if len(counts) == 1:
        return str(counts[0])
    shown = " + ".join(map(str, counts[:MAX_STEPS_SHOWN]))
    more = " + …" if len(counts) > MAX_STEPS_SHOWN else ""
    return f"{sum(counts)} = {shown}{more} in {len(counts)} steps"


def time_of_run(
    solve: Callable[[], T], judge: Callable[[T], object], coarse: Work, run: Work
) -> tuple[str, str]:
    """Estimate the CPU time of a run from those of a coarse solve and of its error estimate.

    Raises ContactNotResolved if the coarse solve has too few cells.
    """
    try:
        result, solved = cpu_seconds(solve)
        _, judged = cpu_seconds(lambda: judge(result))
    except ContactNotResolved:
        raise
    except SolverError as error:
        return "time", f"not estimated, since a coarse solve failed: {error}"
    seconds = estimated_run_seconds(solved, judged, coarse, run)
    return "time", f"{time_text(seconds)} of one core, error estimates included"


def time_text(seconds: float) -> str:
    """Write seconds, minutes or hours."""
    if seconds < 1:
        return "less than 1 s"
    if seconds < 120:
        return f"about {seconds:.2g} s"
    if seconds < 7200:
        return f"about {seconds / 60:.2g} min"
    return f"about {seconds / 3600:.2g} h"
