"""The study of the penalty: how stiff, how fine, how many increments, how large a section."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.running.study import Conclusion, Records, Settings, Study
from verification.studies.penalty.case import FRICTIONAL, PenaltyCase, PenaltyRecord
from verification.studies.penalty.charts import NAMES, charts
from verification.studies.penalty.families import (
    DEFAULT,
    ELEMENTS,
    all_cases,
    of_friction,
    of_meshes,
)
from verification.studies.penalty.verdicts import Found, statements

REMARKS = (
    "ε = c E*/h with E* the contact modulus of the outermost materials and h the length of a "
    "contact edge, the same along the normal and along the surface; three Gauss points per edge.",
    "The edge of Hertz's contact lies in the middle of an element, where the ripple is largest.",
    "Errors of tractions under friction are the largest from 0.1 to about 0.9 of the radius.",
)
FIELDS = tuple(PenaltyRecord.model_fields)


def cases(settings: Settings) -> tuple[PenaltyCase, ...]:
    """All that has to be solved."""
    return all_cases(settings.level)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Statements, tables and figures."""
    level, found = settings.level, _found(settings, records)
    return Conclusion(
        statements=statements(level, found),
        answer=f"c = {DEFAULT:g} with one augmentation: ten times stiffer springs cost more and "
        "ripple, softer ones leave more to augment.",
        tables=(_with_friction(settings, found), _meshes(settings, found)),
        charts=charts(level, found) if found else (),
        remarks=REMARKS,
    )


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`errors.csv`: one line for every run."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(("run", *FIELDS))
    for case, record in _found(settings, records).items():
        table.writerow((case.name, *(getattr(record, field) for field in FIELDS)))
    return {"errors.csv": text.getvalue()}


def _found(settings: Settings, records: Records) -> Found:
    found = {case: records.get(case.name) for case in all_cases(settings.level)}
    return {case: r for case, r in found.items() if isinstance(r, PenaltyRecord)}


def _with_friction(settings: Settings, found: Found) -> Table:
    rows = []
    for contact in FRICTIONAL:
        for updates in (0, 1):
            for case in of_friction(settings.level, contact, updates):
                if case not in found:
                    continue
                record = found[case]
                rows.append((
                    f"{NAMES[contact]}, c = {case.factor:g}",
                    str(updates),
                    plain(record.approach, 2),
                    plain(record.pressure, 2),
                    plain(record.shear, 2),
                    plain(record.overlap, 2),
                    f"{record.systems / record.increments:.1f}",
                    f"{record.by_springs} of {record.increments}",
                    plain(record.largest_residual, 2),
                ))  # fmt: skip
    return Table(
        title=f"Pressing with friction, {ELEMENTS[settings.level]} elements per radius",
        columns=(
            "contact", "augmentations", "approach", "p / p_H", "q / µp_H", "overlap / approach",
            "systems per increment", "by springs", "largest residual",
        ),
        rows=tuple(rows),
        note="Errors of approach and tractions against the integral equations.",
    )  # fmt: skip


def _meshes(settings: Settings, found: Found) -> Table:
    rows = [
        (
            f"{case.elements} elements per radius",
            str(updates),
            plain(found[case].approach, 2),
            plain(found[case].peak, 2),
            plain(found[case].pressure, 2),
            plain(found[case].overlap, 2),
        )
        for updates in (0, 1)
        for case in of_meshes(settings.level, updates)
        if case in found
    ]
    return Table(
        title=f"Hertz at c = {DEFAULT:g} on three meshes",
        columns=("mesh", "augmentations", "approach", "p₀", "p / p_H", "overlap / approach"),
        rows=tuple(rows),
        note="The stiffness follows the mesh, so that the penalty's error falls with it.",
    )


STUDY = Study(
    name="penalty",
    title="What a penalty costs: stiffness, mesh, increments, section",
    question="Springs between the surfaces are the usual way to have contact and friction in a "
    "finite-element model. How stiff have they to be, what do they cost, and what is left of their "
    "error after an augmentation?",
    cases=cases,
    conclude=conclude,
    exports=exports,
)
