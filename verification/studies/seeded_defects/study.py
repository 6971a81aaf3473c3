"""The study of the harness: what it misses, what it cries out at, how good its error bars are."""

from __future__ import annotations

from verification.defects.registry import DEFECTS
from verification.running.study import (
    Conclusion,
    Records,
    Settings,
    Study,
    StudyCase,
)
from verification.studies.seeded_defects.findings import defect_runs, healthy_runs, seen
from verification.studies.seeded_defects.statements import statements
from verification.studies.seeded_defects.tables import charts, tables

REMARKS = (
    "A defect counts as caught by a verdict that fails under it and passes without it. No verdict "
    "here rests on a recorded baseline: reference, order, residual or a named error caught it.",
    "At the quick level each defect meets the cases that ought to see it; above, the whole quick "
    "catalogue.",
    "Defects are planted by replacing functions of the solvers in the worker process; nothing in "
    "the solvers knows of them.",
    "Healthy contacts differ in materials, radii, loads, friction, thickness, window and in where "
    "the axis falls in a cell, on every grid anew.",
    "Four verdicts are what they are because a defect would pass otherwise: the slip in "
    "cattaneo_mindlin, the case coated_unlike_ratios, consistent_tangent in "
    "fem_penalty_indentation, and the tolerance of the approach in fem_penalty_hertz. Each "
    "judges a law, none looks for a defect.",
)


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """All that has to be judged."""
    return (*defect_runs(settings), *healthy_runs())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Statements, tables and a figure."""
    all_seen = [seen(settings, records, defect) for defect in DEFECTS.values()]
    caught = sum(bool(one.sightings) for one in all_seen)
    return Conclusion(
        answer=f"The cases of the catalogue catch {caught} of {len(all_seen)} defects.",
        statements=statements(settings, records, all_seen),
        tables=tables(records, all_seen),
        charts=charts(records),
        remarks=REMARKS,
    )


STUDY = Study(
    name="seeded-defects",
    title="The harness tested: seeded defects, healthy contacts, error bars",
    question="A verification that cannot fail shows nothing. Which defects of the solvers does "
    "this one see, does it cry out where nothing is wrong, and do its error bars hold?",
    cases=cases,
    conclude=conclude,
)
