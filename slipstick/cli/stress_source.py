"""What loads the bodies whose stress is asked for: of a run, or of a scene that is solved first."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from slipstick.cli.asked_accuracy import climbed_to, refuse_without_error
from slipstick.solvers.names import SolverName

if TYPE_CHECKING:
    from contact_results.stress.loaded_bodies import LoadedBodies
    from contact_results.surface import Result
    from contact_scene import SceneFile
    from contact_scene.accuracy import AccuracyRequest
    from contact_scene.accuracy_reached import AccuracyReached
    from contact_scene.stated_error import StatedErrors


def state_of_run_directory(directory: Path, step: int | None) -> LoadedBodies:
    """At the end of a loading step of a run, None for the last."""
    from contact_results.stress.loaded_bodies import NoSuchState, state_of_run

    try:
        return state_of_run(directory, step)
    except NoSuchState as error:
        raise typer.BadParameter(str(error)) from None


def state_of_scene(
    contents: SceneFile,
    step: int | None,
    solver: SolverName,
    *,
    error: bool,
    request: AccuracyRequest | None,
    most_seconds: float | None,
    output: Path,
    until_written: ExitStack,
) -> tuple[LoadedBodies, AccuracyReached | None]:
    """The same of a scene, solved as finely as it says or as a request needs; and how well that
    was met.

    until_written  keeps where a climb stands until it is closed
    """
    from contact_results.stress.loaded_bodies import state_of_result

    if step is not None and step > len(contents.scene.loading):
        raise typer.BadParameter(
            f"there is no step {step}; the scene has steps 1 to {len(contents.scene.loading)}"
        )
    stated: StatedErrors | None
    if request is None:
        result, stated = _solved(contents, solver, error)
        reached = None
    else:
        refuse_without_error(error)
        output.parent.mkdir(parents=True, exist_ok=True)
        climbed = until_written.enter_context(
            climbed_to(request, solver.solver, contents, output, most_seconds, step=step)
        )
        result, stated = climbed.rung.result, climbed.rung.stated
        reached = climbed.accuracy
    return state_of_result(result, step, stated), reached


def _solved(
    contents: SceneFile, name: SolverName, error: bool
) -> tuple[Result, StatedErrors | None]:
    from slipstick.cli.progress import companion_progress, solve_progress

    chosen = name.solver
    fineness = chosen.fineness(contents)
    decided: Any = chosen.plan(contents.scene, fineness)
    if name is SolverName.RADIAL:
        from contact_results.stress.radial_body import refuse_infinite, refuse_turned
        from radial.circle import Circle
        from radial.largest_contact import expected_radius

        if decided.sheared:
            refuse_infinite(contents.scene.indenter, expected_radius(contents.scene))
        if decided.circle is Circle.WHOLE:
            refuse_turned()
    with solve_progress(decided.increments) as observe:
        result = chosen.solve(contents.scene, fineness, decided, observe)
    if not error:
        return result, None
    with companion_progress() as observe:
        return result, chosen.errors(result, progress=observe)
