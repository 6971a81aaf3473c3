"""The study of the penalty: how stiff, how fine, how many increments, how large a section."""

from __future__ import annotations

from verification.exhibits.table import Table, table_of
from verification.running.row import found, rows_of
from verification.running.row_views import Text, number
from verification.running.rules import RESIDUAL
from verification.running.study import Conclusion, Records, Settings, Study
from verification.studies.penalty.case import FRICTIONAL, PenaltyCase
from verification.studies.penalty.charts import NAMES, charts
from verification.studies.penalty.families import (
    DEFAULT,
    ELEMENTS,
    Found,
    all_cases,
    of_friction,
    of_meshes,
)
from verification.studies.penalty.verdicts import statements

REMARKS = (
    "ε = c E*/h with E* the contact modulus of the outermost materials and h the length of a "
    "contact edge, the same along the normal and along the surface; three Gauss points per edge.",
    "The edge of Hertz's contact lies in the middle of an element, where the ripple is largest.",
    "Errors of tractions under friction are the largest from 0.1 to about 0.9 of the radius.",
)


def cases(settings: Settings) -> tuple[PenaltyCase, ...]:
    """All that has to be solved."""
    return all_cases(settings.level)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Statements, tables and figures."""
    level, known = settings.level, found(cases(settings), records)
    return Conclusion(
        statements=statements(level, known),
        answer=f"c = {DEFAULT:g} with one augmentation: ten times stiffer springs cost more and "
        "ripple, softer ones leave more to augment.",
        tables=(_with_friction(settings, known), _meshes(settings, known)),
        charts=charts(level, known) if known else (),
        remarks=REMARKS,
    )


def _with_friction(settings: Settings, known: Found) -> Table:
    rows = rows_of(
        (
            case
            for contact in FRICTIONAL
            for updates in (0, 1)
            for case in of_friction(settings.level, contact, updates)
        ),
        known,
    )
    columns: dict[str, Text] = {
        "contact": lambda r: (
            f"{NAMES[str(r.parameters['contact'])]}, c = {r.parameters['factor']:g}"
        ),
        "augmentations": number("augmentations"),
        "approach": number("approach"),
        "p / p_H": number("pressure"),
        "q / µp_H": number("shear"),
        "overlap / approach": number("overlap"),
        "systems per increment": lambda r: f"{r.measures['systems_per_increment']:.1f}",
        "by springs": lambda r: f"{r.counters['by_springs']} of {r.counters['increments']}",
        "largest residual": number(RESIDUAL),
    }
    return table_of(
        f"Pressing with friction, {ELEMENTS[settings.level]} elements per radius",
        columns,
        rows,
        "Errors of approach and tractions against the integral equations.",
    )


def _meshes(settings: Settings, known: Found) -> Table:
    cases = (case for updates in (0, 1) for case in of_meshes(settings.level, updates))
    columns: dict[str, Text] = {
        "mesh": lambda r: f"{r.parameters['elements']} elements per radius",
        "augmentations": number("augmentations"),
        "approach": number("approach"),
        "p₀": number("peak"),
        "p / p_H": number("pressure"),
        "overlap / approach": number("overlap"),
    }
    return table_of(
        f"Hertz at c = {DEFAULT:g} on three meshes",
        columns,
        rows_of(cases, known),
        "The stiffness follows the mesh, so that the penalty's error falls with it.",
    )


STUDY = Study(
    name="penalty",
    title="What a penalty costs: stiffness, mesh, increments, section",
    question="Springs between the surfaces are the usual way to have contact and friction in a "
    "finite-element model. How stiff have they to be, what do they cost, and what is left of their "
    "error after an augmentation?",
    cases=cases,
    conclude=conclude,
)
