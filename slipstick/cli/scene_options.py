"""What every command that reads a scene takes."""

from pathlib import Path
from typing import Annotated, TypeAlias

import typer

from slipstick.cli.optional import optional

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
