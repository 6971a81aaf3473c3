"""`slipstick schema`: the JSON Schema of what is read and of what is written."""

import json
from enum import StrEnum
from typing import Annotated

import typer


class SchemaOf(StrEnum):
    """The documents that have a schema."""

    SCENE = "scene"
    SUMMARY = "summary"


def schema(
    of: Annotated[
        SchemaOf, typer.Argument(help="A scene file, or the summary.json of a run.")
    ] = SchemaOf.SCENE,
) -> None:
    """Print the JSON Schema of a scene file or of a run's summary."""
    from contact_scene import scene_schema
    from contact_scene.summary import summary_schema

    document = scene_schema() if of is SchemaOf.SCENE else summary_schema()
    typer.echo(json.dumps(document, indent=2))
