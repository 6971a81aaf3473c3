"""Functions to plan, solve and save a scene from Python, by any of the solvers."""

from __future__ import annotations

import warnings
from contextlib import nullcontext
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

from contact_results.solvers import SolverName, solver_of
from contact_scene import Scene, SceneFile
from contact_scene.solver_errors import AccuracyOutOfReach

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical
    from contact_results.surface import Result
    from contact_scene import (
        FiniteElementDiscretisation,
        RadialDiscretisation,
        SurfaceDiscretisation,
    )
    from contact_scene.accuracy import AccuracyRequest
    from contact_scene.discretised import Discretisation, DiscretisedSolver, Progress
    from contact_scene.quantities.stated_error import StatedErrors

Cells: TypeAlias = Literal["semi-analytical"]
Elements: TypeAlias = Literal["fem", "fem-complementarity"]
Radii: TypeAlias = Literal["radial"]


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


@overload
def plan(
    scene: Scene | SceneFile,
    solver: Radii,
    discretisation: RadialDiscretisation | None = None,
) -> radial.Plan: ...


def plan(
    scene: Scene | SceneFile,
    solver: str = "semi-analytical",
    discretisation: Discretisation | None = None,
) -> Any:
    """Return the plan of a solve: modelled effects with reasons, and increments of each load step.

    Parameters
    ----------
    scene : Scene or SceneFile
        Scene to solve. A SceneFile contains a discretisation as well.
    solver : str
        "semi-analytical"; "fem", finite elements with a penalty; "fem-complementarity", finite
        elements without a penalty; or "radial", for bodies of revolution.
    discretisation : SurfaceDiscretisation, FiniteElementDiscretisation or RadialDiscretisation
        Replaces that of the scene file.

    Raises
    ------
    UnsupportedScene
        The solver does not support the scene.
    """
    return check_arguments(scene, solver, discretisation).run_plan


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


@overload
def solve(
    scene: Scene | SceneFile,
    solver: Radii,
    discretisation: RadialDiscretisation | None = None,
    *,
    progress: Progress | None = None,
) -> radial.Result: ...


def solve(
    scene: Scene | SceneFile,
    solver: str = "semi-analytical",
    discretisation: Discretisation | None = None,
    *,
    progress: Progress | None = None,
) -> Any:
    """Solve a scene for every increment of its load history.

    Parameters
    ----------
    scene : Scene or SceneFile
        A SceneFile, from `contact_scene.read_scene_file`, contains a discretisation as well. If it
        requests an accuracy, the discretisation is refined until the stated errors meet it.
    solver : str
        "semi-analytical"; "fem", finite elements with a penalty; "fem-complementarity", finite
        elements without a penalty; or "radial", for bodies of revolution.
    discretisation : SurfaceDiscretisation, FiniteElementDiscretisation or RadialDiscretisation
        Replaces that of the scene file. Values that are not given are chosen by the solver.
    progress : callable
        Called with each converged increment.

    Returns
    -------
    semi_analytical.Result, fem_reference.Result or radial.Result

    Raises
    ------
    TypeError
        `scene` is not a scene, or `progress` cannot be called.
    ValueError
        The solver is unknown, or the discretisation belongs to another solver.
    SolverError
        UnsupportedScene, NotConverged, GrossSliding, ResourceRefused and others of
        `contact_scene.solver_errors`; AccuracyOutOfReach if the requested accuracy is not met.
    """
    chosen = check_arguments(scene, solver, discretisation)
    if not (progress is None or callable(progress)):
        kind = type(progress).__name__
        raise TypeError(f"progress is a {kind}, expected a function of an increment, or None")
    if isinstance(scene, SceneFile) and scene.accuracy is not None:
        return _solve_to_accuracy(scene.accuracy, chosen, progress)
    return chosen.run(progress)


def stated_errors(result: Result) -> StatedErrors:
    """Estimate the errors of the scalars of a result by coarse solves.

    Returns
    -------
    StatedErrors
        `steps` maps, for each load step, the name of a scalar to its error in the unit of the
        scalar, with the parts of the error and its status. `coarse_solves` lists the coarse
        solves. If a coarse solve fails, the errors that need it are unknown.
    """
    from contact_errors.coarse_solves import stated_errors

    return stated_errors(result)


def save(
    result: Result,
    directory: str | PathLike[str],
    *,
    figures: Literal["none", "overview", "all"] = "overview",
    errors: StatedErrors | None = None,
    all_fields: bool = False,
) -> None:
    """Write the files of `slipstick run`: summary, tables, fields, figures and page.

    The directory is written atomically; an earlier run in it is replaced. A part that cannot be
    computed from the result is omitted with a Python warning.

    Parameters
    ----------
    figures : {"none", "overview", "all"}
        No figures and no page, the overview and the page, or all figures and the page.
    errors : StatedErrors
        Result of `stated_errors`. Without it, the files have no errors.
    all_fields : bool
        Store the fields of all increments, not only of the last one of each load step.

    Raises
    ------
    OutputRefused
        The directory cannot be written, is in use, or contains files of other programs.
    TypeError
        `result` is not a result, or `errors` is not a StatedErrors.
    """
    from contact_results.directory.run_directory import run_directory
    from contact_results.result_files import write_result
    from contact_scene.quantities.stated_error import StatedErrors

    solver_of(result)
    if not isinstance(errors, StatedErrors | None):
        kind = type(errors).__name__
        raise TypeError(
            f"errors is a {kind}, expected what slipstick.stated_errors returns, or None"
        )
    with run_directory(Path(directory)) as staging:
        omitted = write_result(
            result,
            staging,
            figures=figures,
            errors=errors,
            all_fields=all_fields,
        )
    for text in omitted.warnings:
        warnings.warn(text, stacklevel=2)


def _solve_to_accuracy(
    request: AccuracyRequest, chosen: DiscretisedSolver, progress: Progress | None
) -> Any:
    """Solve a scene with refined discretisations until its errors meet an accuracy request.

    Returns the result of the last level. Raises AccuracyOutOfReach if the request is not met.
    """
    from contact_errors.adaptive_refinement import Levels, refine

    stress = request.binds_stress
    levels = Levels.of_request(chosen, stress, lambda _: nullcontext(progress))
    made = refine(levels, request)
    if not made.accuracy.met:
        raise AccuracyOutOfReach(f"the accuracy was not reached: {made.accuracy.stopped}")
    return made.level.result


def check_arguments(
    scene: Scene | SceneFile, solver: str, discretisation: Discretisation | None
) -> DiscretisedSolver:
    """Check the arguments of `plan` and `solve`; return the solver of the scene.

    A given discretisation replaces that of a scene file. Raises TypeError or ValueError.
    """
    if not isinstance(scene, Scene | SceneFile):
        raise TypeError(
            f"got a {type(scene).__name__}, expected a Scene; load_scene reads one from a file"
        )
    names = [name.value for name in SolverName]
    if solver not in names:
        raise ValueError(f"there is no solver {solver!r}; expected one of {', '.join(names)}")
    chosen = SolverName(solver).solver
    own = (
        chosen.of_file(scene) if isinstance(scene, SceneFile) else chosen(scene, chosen.settings())
    )
    if discretisation is None:
        return own
    if type(discretisation) is not chosen.settings:
        raise ValueError(
            f"{solver} takes a {chosen.settings.__name__}, got {type(discretisation).__name__}"
        )
    return replace(own, discretisation=discretisation)
