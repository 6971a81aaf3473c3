"""What every command that reads a scene takes."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from slipstick.cli.optional import optional

if TYPE_CHECKING:
    from contact_scene import SceneFile

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


def odd_numbers(contents: "SceneFile") -> tuple[str, ...]:
    """Remarks on what is hardly meant in a scene file."""
    from contact_scene.plausibility import implausible

    fineness = {name: getattr(contents, name) for name in ("semi_analytical", "fem_reference")}
    return implausible(contents.scene, **fineness)


def warn_of_odd_numbers(contents: "SceneFile") -> tuple[str, ...]:
    """Tell them, before anything is solved; returns what was told."""
    from slipstick.cli.terminal import tell

    remarks = odd_numbers(contents)
    for remark in remarks:
        tell(f"warning: {remark}")
    return remarks
