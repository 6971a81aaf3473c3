"""Command `slipstick maintain schema`: print the JSON Schema of a file format."""

import json
from enum import StrEnum
from typing import Annotated, Any

import typer


class SchemaOf(StrEnum):
    """File format whose JSON Schema `slipstick maintain schema` prints."""

    SCENE = "scene"
    SUMMARY = "summary"
    REPORT = "report"


def schema(
    of: Annotated[
        SchemaOf,
        typer.Argument(
            help="A scene file, the summary.json of a run, or the report.json of a verification."
        ),
    ] = SchemaOf.SCENE,
) -> None:
    """Print the JSON Schema of a scene file, a summary or a report."""
    typer.echo(json.dumps(_schema_document(of), indent=2))


def _schema_document(of: SchemaOf) -> dict[str, Any]:
    """Return the JSON Schema of a file format of slipstick."""
    if of is SchemaOf.SCENE:
        from contact_scene import scene_schema

        return scene_schema()
    if of is SchemaOf.SUMMARY:
        from contact_scene.quantities.summary import summary_schema

        return summary_schema()
    from verification.running.report_record import report_schema

    return report_schema()
