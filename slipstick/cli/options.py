"""Arguments and options that several commands take in the same words."""

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
    """An option whose help says what its absence means; `more` as `typer.Option` takes it."""
    return typer.Option(*flags, show_default=False, help=help, **more)


def directory(help: str) -> OptionInfo:
    """Where a command writes, if not at the place that the help names."""
    return optional("--output", "-o", metavar="DIR", help=help)


OutputOption: TypeAlias = Annotated[
    Path,
    typer.Option("--output", "-o", metavar="DIR", help="Where the results go; made if absent."),
]


SceneArgument: TypeAlias = Annotated[
    Path, typer.Argument(metavar="SCENE", help="Scene file (TOML).", show_default=False)
]

SetOption: TypeAlias = Annotated[
    list[str] | None,
    optional(
        "--set",
        metavar="KEY=VALUE",
        help="Override a key of the scene, such as indenter.radius=9mm or "
        "loading[2].increments=40 (the second step); any number of times.",
    ),
]


def odd_numbers(contents: SceneFile) -> tuple[str, ...]:
    """Return warnings about implausible numbers in a scene file."""
    from contact_scene.checks.plausibility import implausible

    fineness = {name: getattr(contents, name) for name in ("semi_analytical", "fem_reference")}
    return implausible(contents.scene, **fineness)


def warn_of_odd_numbers(contents: SceneFile) -> tuple[str, ...]:
    """Tell them, before anything is solved; returns what was told."""
    from slipstick.cli.terminal import tell

    warnings = odd_numbers(contents)
    for warning in warnings:
        tell(f"warning: {warning}")
    return warnings


_OPTION = typer.Option(
    "--solver",
    metavar="NAME",
    help="'semi-analytical', or finite elements, 'fem' with a penalty and "
    "'fem-complementarity' without one; these read the table fem_reference and ignore "
    "semi_analytical; or 'radial', for bodies of revolution that are pressed: nearly exact, in "
    "milliseconds; with friction, pushed, turned or twisted, in seconds.",
    show_default=SolverName.SEMI_ANALYTICAL.value,
)

SolverOption: TypeAlias = Annotated[SolverName, _OPTION]
# Where it matters whether one was named.
AskedSolver: TypeAlias = Annotated[SolverName | None, _OPTION]


SchedulerOption: TypeAlias = Annotated[
    str | None,
    optional(
        "--scheduler",
        metavar="ADDRESS",
        help="Compute on the workers of the dask cluster at tcp://host:port or tls://host:port, "
        "whatever --workers says.",
    ),
]


def workers_at(scheduler: str | None, processes: int) -> int | Workers:
    """The workers of a cluster, or so many processes of this machine."""
    if scheduler is None:
        return processes
    from verification.running.cluster import ClusterUnavailable, ClusterWorkers

    try:
        return ClusterWorkers(scheduler)
    except ClusterUnavailable as error:
        raise typer.BadParameter(f"--scheduler: {error}") from None


class LevelName(StrEnum):
    """How much is computed."""

    QUICK = "quick"
    STANDARD = "standard"
    FULL = "full"


ALMOST, ALIKE = 0.85, 0.5  # similarity of two names, from 0 to 1


def unknown_names(kind: str, given: Iterable[str], known: Collection[str], listing: str) -> str:
    """What to say of the names that are not known, each with those it is near to; else "".

    kind     what the names are of
    listing  the command that names all
    """
    told = [_unknown_name(kind, name, known) for name in given if name not in known]
    return "; ".join([*told, f"'{listing}' names all"] if told else [])


def _unknown_name(kind: str, name: str, known: Collection[str]) -> str:
    near = _near(name[:100].lower(), known)
    meant = f", did you mean {' or '.join(near)}?" if near else ""
    return f"no {kind} is called '{name}'{meant}"


def _near(name: str, known: Collection[str]) -> list[str]:
    """The name that differs by a letter or two; failing that, those that resemble it."""
    spelt = {one.replace("-", "_"): one for one in known}
    name = name.replace("-", "_")
    found = get_close_matches(name, spelt, 1, ALMOST) or get_close_matches(name, spelt, 3, ALIKE)
    return [spelt[one] for one in found]
