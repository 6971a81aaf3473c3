"""`slipstick maintain schema`: the JSON Schema of what is read and of what is written."""

import json
from enum import StrEnum
from typing import Annotated, Any

import typer


class SchemaOf(StrEnum):
    """The documents that have a schema."""

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
    """Print the JSON Schema of a scene file, of a run's summary or of a report."""
    typer.echo(json.dumps(_document(of), indent=2))


def _document(of: SchemaOf) -> dict[str, Any]:
    if of is SchemaOf.SCENE:
        from contact_scene import scene_schema

        return scene_schema()
    if of is SchemaOf.SUMMARY:
        from contact_scene.quantities.summary import summary_schema

        return summary_schema()
    from verification.running.report_record import report_schema

    return report_schema()
