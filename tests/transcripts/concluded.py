"""Conclude the studies from made-up records: good or bad ones, without every fifth one, or none."""

from itertools import count, cycle
from pathlib import Path

import numpy as np

from contact_scene.quantities.stated_error import ErrorStatus, StatedError
from verification.judging.case import Level
from verification.problems.drawn.drawing import Truth
from verification.running.study import CaseRecord, Row, Settings, parameters_of
from verification.studies import coated_tractions, error_coverage, seeded_defects, work_precision
from verification.studies.catalogue import STUDIES
from verification.studies.stability.contacts import CellRecord, Refusal, StabilityCell, Verdict

QUICK = Settings(Level.QUICK)
FINE = {
    (ratio, solver): (run.fineness, run.share)
    for (ratio, solver, kind), run in coated_tractions.runs(QUICK).items()
    if kind == "fine"
}
NUMBER = count(1)


def between(least: float, most: float) -> float:
    """The next number of a sequence that is dense between two limits, on a scale of logarithms."""
    return least * (most / least) ** (0.6180339887 * next(NUMBER) % 1)


def of_precision(case: work_precision.PrecisionCase, off: float) -> CaseRecord:
    """Errors of the second order that scatter, and a time."""
    names = work_precision.CONTACTS[case.contact].errors
    return CaseRecord(
        parameters=parameters_of(case),
        measures={name: between(1, 9) / case.fineness**2 + off for name in names},
        words={"setting": case.text},
        seconds=between(1, 3) * 1e-5 * case.fineness**2,
    )


def of_tractions(case: coated_tractions.TractionRun, off: float) -> CaseRecord:
    """Tractions whose coarse solves are 1e-3 off, on cells off by a part and with a resultant."""
    of_cells = case.solver == coated_tractions.CELLS
    factor = (1.001 if (case.fineness, case.share) != FINE[case.ratio, case.solver] else 1.0) * (
        1 + off * of_cells
    )
    p = np.maximum(1 - coated_tractions.SHOWN**2, 0)
    parts = [
        Row(
            parameters={"T_over_muW": force, "x_over_aH": x},
            measures={"p": factor * p_, "q": factor * (x * p_ + off)},
        )
        for force in coated_tractions.FORCES
        for x, p_ in zip(coated_tractions.SHOWN.tolist(), p.tolist(), strict=True)
    ]
    measures = {"largest_residual": between(1e-12, 1e-8), "stick_fraction": between(0.01, 0.1)}
    return CaseRecord(measures=measures, parts=tuple(parts))


def of_scene(
    case: error_coverage.CoverageCase | error_coverage.RequestCase, off: float
) -> CaseRecord:
    """True errors below, near and above the stated ones, some of which are marked."""
    if isinstance(case, error_coverage.RequestCase):
        names = (error_coverage.ASKED, error_coverage.TRUE)
        measures = {name: between(1e-3, 1e-2) for name in names}
        return CaseRecord(measures=measures, words={"outcome": "met"})
    rows, states = [], cycle([*ErrorStatus, ErrorStatus.ESTIMATED, ErrorStatus.ESTIMATED])
    for quantity in ("approach", "contact_radius", "peak_pressure", "tangential_shift") * 6:
        uncertainty = between(1e-9, 1e-4)
        parts = {"cells": 1.0} if next(NUMBER) % 3 else {"quadrature": 1.0}
        error = between(1e-5, 3e-2)
        stated = StatedError(error=error, parts=parts, status=next(states))
        truth = Truth(1, quantity, 2.0, uncertainty)
        rows.append(error_coverage.coverage_row(truth, 2.0 + off + error * between(0.1, 1), stated))
    return CaseRecord(parameters={"family": case.family}, parts=tuple(rows))


def of_contact(case: StabilityCell, off: float) -> CaseRecord:
    """Contacts that converge, are refused, fail or violate the equations."""
    verdict = Verdict.CONVERGED
    if off:
        verdict = [*Verdict, *[Verdict.CONVERGED] * 9][next(NUMBER) % 13]
    elif case.push > 1 or not case.posable:
        verdict = Verdict.REFUSED
    refused_for = Refusal.FORCE if case.posable else Refusal.POSE
    return CellRecord(
        verdict=verdict,
        refused_for=Refusal.NONE if verdict is not Verdict.REFUSED else refused_for,
        reason="" if verdict is Verdict.CONVERGED else "SolverError: why",
        tolerance=1e-8,
        residual=between(1e-11, 1e-8),
        observed=between(1e-10, 1e-6) if verdict is Verdict.SILENT else between(1e-12, 1e-8),
        increments=next(NUMBER) % 7 + 1,
        iterations=int(between(9, 9000)),
        convolutions=int(between(9, 9000)),
    ).of_cell(case)


def of_defect(case: seeded_defects.DefectRun, off: float) -> CaseRecord:
    """Verdicts that fail with a defect; if bad, with most defects and also without one."""
    number = next(NUMBER) % 4 if off else 2 * (case.defect != seeded_defects.HEALTHY)
    failed = [
        seeded_defects.FailedVerdict(
            quantity=f"q{k}", run="fine", how="order", clearance=between(1, 99)
        ).row()
        for k in range(number)
    ]
    counters = {"verdicts": 5, "failed": len(failed), "inconclusive": 0}
    return CaseRecord(counters=counters, parts=tuple(failed))


MADE = {
    "work-precision": of_precision,
    "coated-tractions": of_tractions,
    "error-coverage": of_scene,
    "stability": of_contact,
    "seeded-defects": of_defect,
}
for name, made in MADE.items():
    study = STUDIES[name]
    for kind, off, kept in (("good", 0.0, 0), ("bad", 0.1, 0), ("lost", 0.0, 5), ("none", 0, 1)):
        cases = [case for n, case in enumerate(study.cases(QUICK), 1) if not kept or n % kept]
        concluded = study.conclude(QUICK, {case.name: made(case, off) for case in cases})
        text = concluded.model_dump_json(exclude_defaults=True)
        Path(f"{name}-{kind}.json").write_text(text, encoding="utf-8")
