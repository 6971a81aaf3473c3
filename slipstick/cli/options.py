"""Arguments and options of the command line that several commands share."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer
from typer.models import OptionInfo

from contact_results.solvers import SolverName

if TYPE_CHECKING:
    from contact_scene import SceneFile
    from verification.running.case_pool import Workers


def optional(*flags: str, help: str, **more: Any) -> OptionInfo:
    """Return a typer option whose help text states the default.

    flags  names of the option
    help   help text
    more   further arguments of `typer.Option`
    """
    return typer.Option(*flags, show_default=False, help=help, **more)


def directory(help: str) -> OptionInfo:
    """Return the option `--output` for a directory; the help text states its default, if any."""
    return optional("--output", "-o", metavar="DIR", parser=_directory_path, help=help)


def _directory_path(given: str) -> Path:
    """Return the path of an output directory; an empty name (an unset variable) is refused."""
    if not given or "\0" in given:
        raise typer.BadParameter(f"{given!r} names no directory; '.' is the current one")
    return Path(given)


OutputOption: TypeAlias = Annotated[
    Path, directory("Directory of the results; created if missing.")
]


SceneArgument: TypeAlias = Annotated[
    Path, typer.Argument(metavar="SCENE", help="Scene file (TOML).", show_default=False)
]

SetOption: TypeAlias = Annotated[
    list[str] | None,
    optional(
        "--set",
        metavar="KEY=VALUE",
        help="Override a key of the scene, for example indenter.radius=9mm, or "
        "loading[2].increments=40 (second step). The option may be repeated.",
    ),
]


def input_warnings(contents: SceneFile) -> tuple[str, ...]:
    """Return warnings about implausible numbers in a scene file, such as a radius of 18 m."""
    from contact_scene.checks.plausibility import implausible_input

    fineness = {name: getattr(contents, name) for name in ("semi_analytical", "fem_reference")}
    return implausible_input(contents.scene, **fineness)


def print_input_warnings(contents: SceneFile) -> tuple[str, ...]:
    """Print warnings about implausible numbers in a scene file to stderr, and return them."""
    from slipstick.cli.terminal import print_message

    warnings = input_warnings(contents)
    for warning in warnings:
        print_message(f"warning: {warning}")
    return warnings


_OPTION = typer.Option(
    "--solver",
    metavar="NAME",
    help="'semi-analytical'; 'fem', finite elements with a penalty; 'fem-complementarity', without "
    "a penalty; or 'radial', for bodies of revolution: nearly exact, in milliseconds without "
    "friction and seconds with friction. Each reads its own table of the scene: semi_analytical, "
    "fem_reference or radial.",
    show_default=SolverName.SEMI_ANALYTICAL.value,
)

SolverOption: TypeAlias = Annotated[SolverName, _OPTION]
# The option without a default, for commands that distinguish an absent option.
OptionalSolver: TypeAlias = Annotated[SolverName | None, _OPTION]


SchedulerOption: TypeAlias = Annotated[
    str | None,
    optional(
        "--scheduler",
        metavar="ADDRESS",
        help="Compute on the workers of the dask cluster at tcp://host:port or tls://host:port, "
        "instead of --workers.",
    ),
]


def workers_at(scheduler: str | None, processes: int) -> int | Workers:
    """Return the workers of a dask cluster, or the number of processes on this machine.

    Raises BadParameter if the cluster cannot be reached.

    scheduler  address of the cluster; None for this machine
    processes  number of processes without a cluster
    """
    if scheduler is None:
        return processes
    from verification.running.case_pool import ClusterUnavailable, ClusterWorkers

    try:
        return ClusterWorkers(scheduler)
    except ClusterUnavailable as error:
        raise typer.BadParameter(f"--scheduler: {error}") from None


class LevelName(StrEnum):
    """Level of a verification or a study: number and fineness of its cases."""

    QUICK = "quick"
    STANDARD = "standard"
    FULL = "full"


def refuse_if(refusals: Iterable[tuple[object, str]]) -> None:
    """Raise BadParameter with the message of the first condition that is true.

    refusals  pairs of a condition and a message
    """
    for condition, message in refusals:
        if condition:
            raise typer.BadParameter(message)


SIMILAR = 0.5  # least similarity of a suggested name, from 0 to 1


def refuse_unknown(
    kind: str,
    given: Iterable[str],
    known: Collection[str],
    listing: str,
    renamed: Mapping[str, str] | None = None,
) -> None:
    """Raise BadParameter if any name does not exist, with the most similar names.

    kind          noun for a name, such as "case"
    given, known  names to check, and all existing names
    listing       command that lists all names
    renamed       present names by names that are known elsewhere
    """
    messages = []
    for name in given:
        if name not in known:
            own = (renamed or {}).get(name)
            near = [own] if own else get_close_matches(name[:100].lower(), known, 1, SIMILAR)
            meant = f", did you mean {near[0]}?" if near else ""
            messages.append(f"no {kind} is called '{name}'{meant}")
    if messages:
        raise typer.BadParameter("; ".join([*messages, f"'{listing}' lists all"]))


def refuse_with_run(given: dict[str, object]) -> None:
    """Refuse options of a solve when a command is given the output directory of a run.

    Raises BadParameter for the first option that has a value.

    given  values of the options by name
    """
    text = "applies to a scene, got the output of a run: omit it, or give the scene file"
    refuse_if((value, f"{option} {text}") for option, value in given.items())
