"""Command `slipstick example`: print an example scene."""

from importlib.resources import files
from typing import Annotated

import typer

from slipstick.cli.options import refuse_unknown


def example(
    name: Annotated[
        str | None,
        typer.Argument(
            help="Name of the scene. Without a name, the names are listed.", show_default=False
        ),
    ] = None,
) -> None:
    """Print an example scene, as in `slipstick example coated_ball > scene.toml`."""
    scenes = {
        file.name.removesuffix(".toml"): file.read_text(encoding="utf-8")
        for file in sorted((files("slipstick") / "scenes").iterdir(), key=lambda file: file.name)
    }
    if name is None:
        for each, text in scenes.items():
            title = text.splitlines()[0].partition("=")[2].strip(' "')
            typer.echo(f"{each:15} {title}")
        return
    refuse_unknown("example", [name], scenes, "slipstick example")
    typer.echo(scenes[name], nl=False)
