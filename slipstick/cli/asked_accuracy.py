"""An accuracy that is asked for, on the command line or in the scene, and the way to it."""

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from slipstick.cli.optional import optional

if TYPE_CHECKING:
    from contact_errors.climb import Climb
    from contact_results.directory.checkpoint import Checkpoint
    from contact_scene import SceneFile
    from contact_scene.accuracy import AccuracyRequest
    from slipstick.solvers.solver import Progress, Solver

AccuracyOption: TypeAlias = Annotated[
    str | None,
    optional(
        "--accuracy",
        metavar="SHARES",
        help='Refine until errors are this small: "0.1%", or by name: "peak_pressure 0.1%, '
        'dissipated_energy 1%". Absent: what the table [accuracy] of the scene asks, if it has '
        "one.",
    ),
]


def asked_accuracy(contents: "SceneFile", option: str | None) -> "AccuracyRequest | None":
    """What the option asks for, or else the scene file."""
    if option is None:
        return contents.accuracy
    from contact_scene.scene_file import read_accuracy

    return read_accuracy(option, "--accuracy")


def climb_to(
    request: "AccuracyRequest",
    solver: "Solver",
    contents: "SceneFile",
    output: Path,
    surface_stress: bool,
    most_seconds: float | None,
) -> "Climb[Any]":
    """The scene solved ever finer until a request is met; every round leaves its own checkpoint
    beside the results if it is killed."""
    from contact_errors.climb import climb
    from contact_results.directory.checkpoint import checkpointed
    from contact_results.directory.code_digest import solve_identity
    from slipstick.cli.progress import solve_progress, tell_round
    from slipstick.cli.terminal import tell

    rounds = count(1)

    @contextmanager
    def keeping(fineness: Any) -> "Iterator[Checkpoint]":
        identity = solve_identity(contents.scene, fineness, vars(solver))
        with checkpointed(output, identity, tell, f"checkpoint-{next(rounds)}") as keeper:
            yield keeper

    @contextmanager
    def watching(fineness: Any) -> "Iterator[Progress]":
        with solve_progress(fineness.increments) as observe:
            yield observe

    fineness = solver.fineness(contents)
    ladder = solver.ladder(contents.scene, fineness, surface_stress, keeping, watching)
    return climb(ladder, request, most_seconds, tell_round)
