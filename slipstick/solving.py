"""Plan, solve and save a scene from Python, by any solver."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

from contact_scene import Scene, SceneFile
from slipstick.solvers.names import SolverName, solver_of

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical
    from contact_results.surface import Result
    from contact_scene import FiniteElementDiscretisation, SurfaceDiscretisation
    from contact_scene.stated_error import StatedErrors
    from slipstick.solvers.solver import Discretisation, Progress, Solver

Cells: TypeAlias = Literal["semi-analytical"]
Elements: TypeAlias = Literal["fem", "fem-complementarity"]


@overload
def plan(
    scene: Scene | SceneFile,
    solver: Cells = "semi-analytical",
    discretisation: SurfaceDiscretisation | None = None,
) -> semi_analytical.Plan: ...


@overload
def plan(
    scene: Scene | SceneFile,
    solver: Elements,
    discretisation: FiniteElementDiscretisation | None = None,
) -> fem_reference.Plan: ...


def plan(
    scene: Scene | SceneFile,
    solver: str = "semi-analytical",
    discretisation: Discretisation | None = None,
) -> Any:
    """Which effects a solver would compute for a scene, why, and in how many increments.

    Parameters are those of `solve`. Raises UnsupportedScene.
    """
    chosen, solved, fineness = _asked(scene, solver, discretisation)
    return chosen.plan(solved, fineness)


@overload
def solve(
    scene: Scene | SceneFile,
    solver: Cells = "semi-analytical",
    discretisation: SurfaceDiscretisation | None = None,
    *,
    progress: Progress | None = None,
) -> semi_analytical.Result: ...


@overload
def solve(
    scene: Scene | SceneFile,
    solver: Elements,
    discretisation: FiniteElementDiscretisation | None = None,
    *,
    progress: Progress | None = None,
) -> fem_reference.Result: ...


def solve(
    scene: Scene | SceneFile,
    solver: str = "semi-analytical",
    discretisation: Discretisation | None = None,
    *,
    progress: Progress | None = None,
) -> Any:
    """Contact of a scene, every increment of its load history.

    Parameters
    ----------
    scene
        What is solved; of a scene file that was read whole also how finely.
    solver
        "semi-analytical", or finite elements with a penalty, "fem", or without one,
        "fem-complementarity".
    discretisation
        How finely: SurfaceDiscretisation or FiniteElementDiscretisation. What it leaves open is
        chosen.
    progress
        Called with each increment once it has converged.

    Raises
    ------
    TypeError
        It is no scene.
    ValueError
        There is no such solver, or the discretisation is of another; or the scene file asks for an
        accuracy, which takes more than one solve.
    SolverError
        As the solver says: UnsupportedScene, NotConverged, GrossSliding, ResourceRefused and others
        in `contact_scene.solver_errors`.
    """
    if isinstance(scene, SceneFile) and scene.accuracy is not None:
        raise ValueError(
            "the scene file asks for an accuracy, by its table [accuracy]: use 'slipstick run', or "
            "solve(contents.scene) for one solve as fine as the discretisation says"
        )
    chosen, solved, fineness = _asked(scene, solver, discretisation)
    return chosen.solve(solved, fineness, chosen.plan(solved, fineness), progress)


def stated_errors(result: Result) -> StatedErrors:
    """How far off the numbers of a result may be, by coarser solves beside it.

    `steps` has of every loading step a table from the name of a scalar to its error, in the unit of
    the scalar, with its parts and whether it has converged; `companions` says what was solved. A
    companion that has no answer leaves its errors unknown.
    """
    return solver_of(result).errors(result)


def save(
    result: Result,
    directory: str | PathLike[str],
    *,
    figures: bool = True,
    errors: StatedErrors | None = None,
) -> None:
    """Write the files that `slipstick run` writes: summary, tables, fields and figures.

    The directory appears whole or not at all; an earlier run in it is replaced. Raises
    OutputRefused where other files are in the way.

    errors  of the result, from `stated_errors`; they are left out if absent
    """
    from contact_results.directory.run_directory import run_directory
    from contact_results.result_files import write_result

    with run_directory(Path(directory)) as staging:
        write_result(result, staging, with_figures=figures, errors=errors)


def _asked(
    scene: Scene | SceneFile, solver: str, discretisation: Discretisation | None
) -> tuple[Solver, Scene, Discretisation]:
    if not isinstance(scene, Scene | SceneFile):
        raise TypeError(
            f"got a {type(scene).__name__}, expected a Scene; load_scene reads one from a file"
        )
    names = [name.value for name in SolverName]
    if solver not in names:
        raise ValueError(f"there is no solver {solver!r}; expected one of {', '.join(names)}")
    chosen = SolverName(solver).solver
    fineness = chosen.fineness(scene) if isinstance(scene, SceneFile) else chosen.default()
    if discretisation is not None:
        if type(discretisation) is not type(fineness):
            raise ValueError(
                f"{solver} takes a {type(fineness).__name__}, got {type(discretisation).__name__}"
            )
        fineness = discretisation
    return chosen, scene.scene if isinstance(scene, SceneFile) else scene, fineness
