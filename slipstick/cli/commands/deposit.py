"""Command `slipstick maintain deposit`: write the reference tables as an RO-Crate."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from datetime import date, datetime
from pathlib import Path
from typing import Annotated, Any

import typer

from contact_results.directory.machine import program_version
from contact_results.directory.run_directory import refuse_files_above
from slipstick.tables.catalogue import TABLES
from slipstick.tables.table import Dataset, Table
from verification.challenge.cases import challenges
from verification.references import load_reference
from verification.running.provenance import source_digest

LICENCE = "https://creativecommons.org/licenses/by/4.0/"
TITLE = "Reference numbers for the frictional contact of coated bodies"
CONTENT = (
    "Reference numbers of punches and balls on coated bodies, with friction and torsion, and of "
    "paths of changing loads. Each row has uncertainties, method, command and digest."
)
TRACE = {
    "method": "solver of the value",
    "command": "command that prints the row",
    "digest": "digest of the sources that computed the row",
}


def deposit(
    output: Annotated[Path, typer.Option("--output", "-o", help="New directory of the crate.")],
    published: Annotated[
        datetime,
        typer.Option(
            "--date", formats=["%Y-%m-%d"], help="Date of publication, stored in the metadata."
        ),
    ],
) -> None:
    """Write all reference tables as CSV and JSON in an RO-Crate (CC-BY; 3 min)."""
    refuse_files_above(output)
    if output.exists():
        raise typer.BadParameter(f"'{output}' exists; give a new directory")
    try:
        write_crate(output, datasets(), published.date())
    except ModuleNotFoundError as error:
        raise typer.BadParameter(f"{error}; install it with pip install '.[deposit]'") from error
    typer.echo(f"{output}: {len(list(output.iterdir()))} files")


def datasets() -> Iterator[Dataset]:
    """Yield all tables of reference numbers for the deposit, computed or read from stored files."""
    digest = source_digest("radial")
    for table in TABLES.values():
        yield _add_provenance(table.dataset({}), "radial solver", _row_command(table), digest)
    yield from stored_datasets()


def _row_command(table: Table) -> Callable[[Mapping[str, Any]], str]:
    return lambda row: " ".join(
        [f"slipstick table {table.name}", *(f"--over {name}={row[name]!r}" for name in table.axes)]
    )


def _add_provenance(
    found: Dataset, method: str, command: Callable[[Mapping[str, Any]], str], digest: str
) -> Dataset:
    rows = [
        {**row, "method": method, "command": command(row), "digest": digest} for row in found.rows
    ]
    return replace(found, columns={**found.columns, **TRACE}, rows=rows)


def stored_datasets() -> Iterator[Dataset]:
    """Yield two reference tables of stored numbers, which are not computed again.

    The tables are the onset of gross slip, and the paths of changing loads.
    """
    onset = load_reference("gross_slip_onset")
    about = onset["about"]
    yield _add_provenance(
        Dataset(about, onset["columns"], onset["rows"]),
        "limits of the semi-analytical and the radial solver",
        lambda _: str(about["command"]),
        about["digest"],
    )
    rows = [
        {
            "case": name,
            "step": value.step,
            "quantity": value.quantity,
            "value": value.value,
            "value_uncertainty": value.uncertainty * value.scale,
            "unit": value.unit,
        }
        for name, challenge in challenges().items()
        if name.startswith("changing_loads/")
        for value in challenge.values
    ]
    about = {
        "table": "changing_loads",
        "problem": "A ball under changing normal and tangential loads and a torque, in five steps.",
        "made_by": f"slipstick {program_version()}, radial solver, limit of fine increments",
        "uncertainty": "the cells agree with the ring solver within it",
    }
    columns = {
        "case": "challenge; its scene has loads and materials",
        "step": "load step, from 1",
        "quantity": "name as in the results of a run",
        "value": "value at the end of the step",
        "value_uncertainty": "standard uncertainty of the value, absolute",
        "unit": "SI unit of value and uncertainty",
    }
    yield _add_provenance(
        Dataset(about, columns, rows),
        "radial solver in the limit of fine increments",
        lambda row: f"slipstick challenge export {row['case']} --output path",
        source_digest("verification.challenge.cases"),
    )


def write_crate(folder: Path, found: Iterable[Dataset], published: date) -> None:
    """Write tables as CSV and JSON with the metadata of an RO-Crate.

    Raises ImportError without the library rocrate.

    folder     new folder of the crate
    published  date of publication
    """
    from rocrate.model.contextentity import ContextEntity
    from rocrate.rocrate import ROCrate

    crate = ROCrate()
    crate.name, crate.description = TITLE, CONTENT
    crate.datePublished = published.isoformat()
    authors = {"@type": "Organization", "name": "slipstick contributors"}
    crate.add(ContextEntity(crate, "#authors", authors))
    licence = {
        "@type": "CreativeWork",
        "name": "CC BY 4.0",
        "description": "Share and adapt with attribution.",
    }
    crate.add(ContextEntity(crate, LICENCE, licence))
    crate.root_dataset["author"] = {"@id": "#authors"}
    crate.root_dataset["license"] = {"@id": LICENCE}
    folder.mkdir(parents=True)
    for dataset in found:
        for kind, text in (("csv", dataset.csv()), ("json", dataset.json())):
            path = folder / f"{dataset.about['table']}.{kind}"
            path.write_text(text, encoding="utf-8")
            crate.add_file(
                path,
                properties={
                    "name": f"{dataset.about['table']}, {kind}",
                    "description": dataset.about["problem"],
                    "encodingFormat": f"{'text' if kind == 'csv' else 'application'}/{kind}",
                    "contentSize": str(len(text.encode())),
                    "measurementTechnique": dataset.about["made_by"],
                },
            )
    crate.metadata.write(folder)
