"""Command `slipstick plan`: print effects, grid, time and memory of a solve."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated

from contact_results.radial_method import radial_method
from contact_results.solvers import SolverName
from contact_scene import read_scene_file
from contact_scene.accuracy import AccuracyRequest
from contact_scene.disk_cache import without_cache
from contact_scene.reading.scene_file import read_accuracy
from contact_scene.reading.scene_text import increments_text
from contact_scene.solver_errors import AccuracyOutOfReach
from slipstick.cli.options import (
    SceneArgument,
    SetOption,
    SolverOption,
    optional,
    print_input_warnings,
)
from slipstick.cli.terminal import print_pairs, print_table
from slipstick.cli.time_estimate import estimated_time, time_text

if TYPE_CHECKING:
    from contact_errors.adaptive_refinement import Levels
    from contact_scene.discretised import DiscretisedSolver, Fineness, Pairs

HEADINGS = ("accuracy", "cells, elements, rings", "increments", "time", "memory")


def plan(
    scene: SceneArgument,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    accuracy: Annotated[
        list[str] | None,
        optional(
            "--accuracy",
            metavar="SHARES",
            help="Print the cost of an accuracy, written as for 'run'. The option may be repeated. "
            "Default: no cost.",
        ),
    ] = None,
) -> None:
    """Print the effects of a scene with reasons, and grid or mesh, time and memory of a run.

    The time is accurate within a factor of 2. It is estimated by a trial solve of the first load
    steps in two increments each, on 24 cells along the shorter side, 8 elements over the contact
    radius, or half the rings. A scene that the solver does not support is refused as by 'run'. With
    --accuracy, the cost of each accuracy is estimated by a coarse solve with all increments.
    """
    contents = read_scene_file(scene, overrides or ())
    requests = {
        item: read_accuracy(item, "--accuracy", contents.indenter) for item in accuracy or ()
    }
    print_input_warnings(contents)
    chosen = solver.solver.of_file(contents)
    effects = chosen.run_plan.effects
    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in effects)
    print_table(("effect", "", "why"), rows)
    print_pairs(_work(chosen))
    if reasons := chosen.increment_reasons():
        print_table(("step", "increments", "why"), reasons)
    if solver is not SolverName.RADIAL and (how := radial_method(contents.scene)):
        print_pairs([("radial", f"--solver radial can solve this: {how}")])
    if requests:
        _print_prices(requests, chosen)


def _work(solver: "DiscretisedSolver") -> "Pairs":
    yield from solver.describe_run()
    yield "time", estimated_time(solver)
    yield "memory", f"about {solver.run_memory() / 2**20:.0f} MiB"


def _print_prices(requests: Mapping[str, AccuracyRequest], solver: "DiscretisedSolver") -> None:
    """Print the estimated cost of each requested accuracy, or the reason why no grid can meet it.

    requests  requested accuracy by argument of `--accuracy`
    """
    from contact_errors.adaptive_refinement import Levels, targets_of

    stress = any(request.binds_stress for request in requests.values())
    levels = Levels.of_request(solver, stress)
    with without_cache():
        first = levels.solve_first_level()
    rows, refused = [], []
    for item, request in requests.items():
        try:
            *_, last = targets_of(request, first, levels)
            seconds = first.processor_seconds
            if last != first.fineness:
                seconds += levels.estimated_seconds(first, levels.solver.work(last))
            rows.append((item, *_price_texts(levels, last, seconds)))
        except AccuracyOutOfReach as error:
            refused.append((item, str(error)))
    if rows:
        print_table(HEADINGS, rows)
    if refused:
        print_pairs(refused)


def _price_texts(levels: "Levels", last: "Fineness", seconds: float) -> tuple[str, ...]:
    """Return the texts of cells, increments, time and memory for a table.
    `seconds` is the CPU time of the first and the last level, with their coarse solves."""
    settings = levels.settings(last)
    cells, rings = settings.cells, settings.ring_factor
    fineness = f"{rings:.2g} times the rings" if rings else ""
    width = "half width" if levels.solver.scene.indenter.is_line else "radius"
    fineness = fineness or f"{settings.elements_per_radius} per {width}"
    return (
        (f"{cells[0]} x {cells[1]}" if cells else fineness)
        + (", above the limit" if levels.beyond_limit(last) else ""),
        increments_text(settings.increments),
        time_text(seconds),
        f"about {levels.memory(last) / 2**20:.0f} MiB",
    )
