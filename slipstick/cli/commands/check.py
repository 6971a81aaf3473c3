"""Command `slipstick check`: validate and describe a scene file."""

import json
from dataclasses import asdict
from typing import Annotated

import typer

from slipstick.cli.errors import ExitCode
from slipstick.cli.options import SceneArgument, SetOption, input_warnings


def check(
    scene: SceneArgument,
    overrides: SetOption = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the outcome as JSON, for editors and scripts.")
    ] = False,
) -> None:
    """Validate a scene file and describe it.

    Every mistake is listed with file, line and key. For a valid scene, every implausible number is
    listed. Nothing is solved. Exit code 0 if the scene is valid, 2 if it is not.
    """
    from contact_scene import SceneError, read_scene_file

    try:
        contents = read_scene_file(scene, overrides or ())
    except SceneError as error:
        if not as_json:
            raise
        problems = [{"key": p.key, **_remove_path(asdict(p))} for p in error.problems]
        typer.echo(json.dumps({"valid": False, "problems": problems}, indent=2))
        raise typer.Exit(ExitCode.INVALID) from None
    warnings = input_warnings(contents)
    if as_json:
        typer.echo(json.dumps({"valid": True, "problems": [], "warnings": warnings}, indent=2))
        return

    from contact_scene.quantities.per_length import shown_name
    from contact_scene.reading.scene_text import describe
    from slipstick.cli.terminal import print_message, print_pairs

    typer.echo(f"{scene}: valid")
    print_pairs(describe(contents.scene, contents.semi_analytical, contents.fem_reference))
    if contents.accuracy is not None:
        line = contents.indenter.is_line
        shares = ", ".join(
            f"{shown_name(name, line=line)} {100 * share:.3g} %"
            for name, share in contents.accuracy.shares().items()
        )
        print_pairs([("accuracy", shares)])
    for warning in warnings:
        print_message(f"warning: {warning}")


def _remove_path(problem: dict[str, object]) -> dict[str, object]:
    """Return the data of a mistake in a scene file without the key "path", for JSON output."""
    return {name: value for name, value in problem.items() if name != "path"}
