"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from difflib import get_close_matches
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer
from typer.models import OptionInfo

from slipstick.solvers.names import SolverName

if TYPE_CHECKING:
    from contact_scene import SceneFile
    from verification.running.case_pool import Workers


def optional(*flags: str, help: str, **more: Any) -> OptionInfo:
    """Return an option whose help text states the default.

    more  arguments of `typer.Option`
    """
    return typer.Option(*flags, show_default=False, help=help, **more)


def directory(help: str) -> OptionInfo:
    """Return the option for the output directory; the help text states the default."""
    return optional("--output", "-o", metavar="DIR", help=help)


OutputOption: TypeAlias = Annotated[
    Path,
    typer.Option(
        "--output", "-o", metavar="DIR", help="Directory of the results; created if missing."
    ),
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


def odd_numbers(contents: SceneFile) -> tuple[str, ...]:
    """Return warnings about implausible numbers in a scene file."""
    from contact_scene.checks.plausibility import implausible

    fineness = {name: getattr(contents, name) for name in ("semi_analytical", "fem_reference")}
    return implausible(contents.scene, **fineness)


def warn_of_odd_numbers(contents: SceneFile) -> tuple[str, ...]:
    """Print the warnings of `odd_numbers` and return them."""
    from slipstick.cli.terminal import tell

    warnings = odd_numbers(contents)
    for warning in warnings:
        tell(f"warning: {warning}")
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
AskedSolver: TypeAlias = Annotated[SolverName | None, _OPTION]


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
    """Return the workers of a cluster, or the number of processes on this machine."""
    if scheduler is None:
        return processes
    from verification.running.cluster import ClusterUnavailable, ClusterWorkers

    try:
        return ClusterWorkers(scheduler)
    except ClusterUnavailable as error:
        raise typer.BadParameter(f"--scheduler: {error}") from None


class LevelName(StrEnum):
    """Level of a verification or a study."""

    QUICK = "quick"
    STANDARD = "standard"
    FULL = "full"


ALMOST, ALIKE = 0.85, 0.5  # similarity of two names, from 0 to 1


def unknown_names(kind: str, given: Iterable[str], known: Collection[str], listing: str) -> str:
    """Return a message about unknown names with suggestions; empty if all names are known.

    kind     noun for a name, such as "case"
    listing  command that lists all names
    """
    messages = [_unknown_name(kind, name, known) for name in given if name not in known]
    return "; ".join([*messages, f"'{listing}' lists all"] if messages else [])


def _unknown_name(kind: str, name: str, known: Collection[str]) -> str:
    near = _near(name[:100].lower(), known)
    meant = f", did you mean {' or '.join(near)}?" if near else ""
    return f"no {kind} is called '{name}'{meant}"


def _near(name: str, known: Collection[str]) -> list[str]:
    """Return the known name with the highest similarity; else up to three similar names."""
    spelt = {one.replace("-", "_"): one for one in known}
    name = name.replace("-", "_")
    found = get_close_matches(name, spelt, 1, ALMOST) or get_close_matches(name, spelt, 3, ALIKE)
    return [spelt[one] for one in found]


def refuse_with_run(given: dict[str, object]) -> None:
    """Refuse options of a solve beside the directory of a run."""
    for option, value in given.items():
        if value:
            raise typer.BadParameter(
                f"{option} applies to a scene, got the output of a run: omit it, or give the scene "
                "file"
            )
