"""Options for a requested accuracy, and the refinement of a solve that meets it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from contact_results.directory.checkpoint import CheckpointDirectory, provide_checkpoints
from contact_results.directory.code_digest import solve_identity
from contact_scene import SceneFile
from contact_scene.accuracy import AccuracyRequest
from contact_scene.quantities.stated_error import AccuracyReached
from contact_scene.reading.scene_file import read_accuracy
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional, refuse_if
from slipstick.cli.progress import print_level, solve_progress
from slipstick.cli.terminal import print_message

if TYPE_CHECKING:
    from contact_errors.adaptive_refinement import Refined
    from contact_scene.discretised import DiscretisedSolver, Progress

AccuracyOption: TypeAlias = Annotated[
    str | None,
    optional(
        "--accuracy",
        metavar="SHARES",
        help='Refine until the stated errors are at most these: "0.1%", or by name: '
        '"peak_pressure 0.1%, dissipated_energy 1%". Default: the table [accuracy] of the scene.',
    ),
]

MostSecondsOption: TypeAlias = Annotated[
    float | None,
    optional(
        "--most-seconds",
        metavar="S",
        min=0,
        help="With an accuracy: start no finer solve that would exceed this total time. The best "
        "result is written, with exit code 4. Default: no limit.",
    ),
]

# Start of the names of the checkpoints of refinement levels, which are next to the results.
OF_LEVEL = "checkpoint-"


def read_requested_accuracy(
    contents: SceneFile, option: str | None, most_seconds: float | None, *, error: bool
) -> AccuracyRequest | None:
    """Return the accuracy request of the option `--accuracy`, or else of the scene file.

    The result is None without a request. Raises BadParameter for `--most-seconds` without a
    request, and for a request with `--no-error`.

    option        text of `--accuracy`, or None
    most_seconds  value of `--most-seconds` [s], or None
    error         false for `--no-error`
    """
    request = contents.accuracy
    if option is not None:
        request = read_accuracy(option, "--accuracy", contents.indenter)
    refuse_if(
        (
            (
                most_seconds is not None and request is None,
                "--most-seconds needs an accuracy; add --accuracy or omit --most-seconds",
            ),
            (
                request is not None and not error,
                "--no-error excludes an accuracy; omit --no-error, or omit --accuracy and the "
                "table [accuracy]",
            ),
        )
    )
    return request


def exit_unless_met(accuracy: AccuracyReached | None) -> None:
    """Exit with code 4 if a requested accuracy was not reached.

    accuracy  outcome of the refinement; None for a run without a requested accuracy
    """
    if accuracy is not None and not accuracy.met:
        print_message(
            f"error: the accuracy was not reached: {accuracy.stopped}; the best result is stored"
        )
        raise typer.Exit(ExitCode.RESOURCES_REFUSED)


def remove_level_checkpoints(output: Path) -> None:
    """Remove the checkpoints of refinement levels next to an output directory.

    A run with a requested accuracy leaves such checkpoints if it is killed.
    """
    target = output.resolve()
    of_levels = f".{target.name}.{OF_LEVEL}*"
    left = [path for place in (target, target.parent) for path in place.glob(of_levels)]
    for path in left:
        with provide_checkpoints(
            output, "", print_message, path.name.removeprefix(f".{target.name}.")
        ):
            pass


@contextmanager
def solve_to_accuracy(
    request: AccuracyRequest,
    solver: DiscretisedSolver,
    output: Path,
    most_seconds: float | None,
    *,
    step: int | None = None,
) -> Iterator[Refined]:
    """Solve a scene with refined discretisations, and yield the outcome of the refinement.

    Checkpoints of the current solve are stored next to the output directory. They are removed after
    the block of the `with` statement, which writes the results. A run that is resumed after it was
    killed solves the levels before the current one again; they take a small fraction of the time.
    Raises the errors of `contact_errors.adaptive_refinement.refine`.

    request       requested relative errors
    solver        solver of the scene
    output        output directory
    most_seconds  limit of the total time [s]; None for no limit
    step          load step at whose end the stress is required, from 1; None for the last
    """
    from contact_errors.adaptive_refinement import Levels, refine

    tried = 0

    @contextmanager
    def store_level(fineness: Any) -> Iterator[CheckpointDirectory]:
        """Yield the checkpoint store of the solve of one level.

        The store of the previous level is closed, which removes its checkpoint.
        """
        nonlocal tried
        tried += 1
        of_level.close()
        identity = solve_identity(fineness, solver)
        yield of_level.enter_context(
            provide_checkpoints(output, identity, print_message, f"{OF_LEVEL}{tried}")
        )

    @contextmanager
    def show_level(fineness: Any) -> Iterator[Progress]:
        """Yield a function that shows the progress of the solve of one level."""
        with solve_progress(fineness.increments) as observe:
            yield observe

    most = inf if most_seconds is None else most_seconds
    levels = Levels.of_request(solver, request.binds_stress, show_level, store_level, step=step)
    with ExitStack() as of_level:
        yield refine(levels, request, most, print_level)
