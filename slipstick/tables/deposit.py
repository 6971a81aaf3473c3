"""Reference numbers as an RO-Crate: tables, onset of gross slip, paths of changing loads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from datetime import date
from pathlib import Path

from contact_results.directory.machine import program_version
from slipstick.tables.catalogue import TABLES
from slipstick.tables.table import Dataset
from verification.references import load_reference
from verification.running.sources import source_digest

LICENCE = "https://creativecommons.org/licenses/by/4.0/"
TITLE = "Reference numbers for the frictional contact of coated bodies"
CONTENT = (
    "Reference numbers of punches and balls on coated bodies, with friction, and of paths of "
    "changing loads. Each number has an uncertainty. Each table states method and command."
)


def datasets() -> Iterator[Dataset]:
    """Compute or read all tables of the deposit."""
    digest = source_digest("radial")
    for table in TABLES.values():
        made = table.dataset({})
        about = {**made.about, "command": f"slipstick table {table.name}", "digest": digest}
        yield replace(made, about=about)
    yield _onset()
    yield _paths()


def _onset() -> Dataset:
    found = load_reference("gross_slip_onset")
    return Dataset(found["about"], found["columns"], found["rows"])


def _paths() -> Dataset:
    from verification.challenge.cases import challenges

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
        "command": "slipstick challenge export changing_loads/nu=0.3 --output path",
        "digest": source_digest("verification.challenge.cases"),
    }
    columns = {
        "case": "challenge; its scene has loads and materials",
        "step": "load step, from 1",
        "quantity": "name as in the results of a run",
        "value": "value at the end of the step",
        "value_uncertainty": "standard uncertainty of the value, absolute",
        "unit": "SI unit of value and uncertainty",
    }
    return Dataset(about, columns, rows)


def write(folder: Path, found: Iterable[Dataset], published: date) -> None:
    """Write the crate: CSV and JSON of each table and `ro-crate-metadata.json`.

    Raises ImportError without the library rocrate.
    """
    from rocrate.model.contextentity import ContextEntity
    from rocrate.rocrate import ROCrate

    crate = ROCrate()
    crate.name, crate.description = TITLE, CONTENT
    crate.datePublished = published.isoformat()
    authors = {"@type": "Organization", "name": "slipstick contributors"}
    crate.add(ContextEntity(crate, "#authors", authors))
    crate.add(ContextEntity(crate, LICENCE, {"@type": "CreativeWork", "name": "CC BY 4.0"}))
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
                    "license": {"@id": LICENCE},
                    "contentSize": str(len(text.encode())),
                    "measurementTechnique": dataset.about["made_by"],
                },
            )
    crate.metadata.write(folder)
