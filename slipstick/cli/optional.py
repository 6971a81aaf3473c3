"""Options that nobody has to give, and what several commands take in the same words."""

from pathlib import Path
from typing import Annotated, Any, TypeAlias

import typer
from typer.models import OptionInfo


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
