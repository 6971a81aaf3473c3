"""What the harness says of a case of the catalogue under a defect, and of a healthy contact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from verification.cases.catalogue import CaseToJudge, JudgedCase, case_of, choose, lost
from verification.defects.defect import planted
from verification.defects.healthy_contacts import FAMILIES
from verification.defects.registry import DEFECTS
from verification.judging.case import Case, Derived, Level
from verification.judging.judgement import judge
from verification.judging.outcome import (
    IMBALANCE,
    RESIDUAL,
    SOLVED,
    VIOLATION,
    CaseOutcome,
    Status,
    Verdict,
)
from verification.judging.run import AnyRun
from verification.judging.verdicts import expanded_uncertainty
from verification.running.case_pool import CaseStore
from verification.running.study import CaseRecord, TypedRow, parameters_of

HEALTHY = ""
GATE = 1e-2
LAWS = {RESIDUAL: "residual", VIOLATION: "law", IMBALANCE: "law"}
SEED = 20
ERROR = "largest_error"


class Caught(TypedRow):
    """A verdict that failed."""

    PARAMETERS = ("quantity", "run")

    quantity: str
    run: str
    how: str
    """By what it was judged."""

    clearance: float | None
    """Error over what is allowed; null where there is no number."""

    reason: str = ""
    """Why a case or a run has no result."""

    @property
    def by_law(self) -> bool:
        """Return True if a law sees it that every result obeys, and no reference."""
        return self.how in LAWS.values()


class Sample(TypedRow):
    """A quantity beside its reference; errors relative to the quantity's scale."""

    PARAMETERS = ("quantity",)

    quantity: str
    error: float | None
    allowed: float | None
    uncertainty: float | None
    """Expanded, U = 2u, before it is capped; null where the tolerance is not derived."""


def caught(record: CaseRecord) -> tuple[Caught, ...]:
    """Return the verdicts that failed."""
    return tuple(Caught.of(row) for row in record.parts if "how" in row.words)


def samples(record: CaseRecord) -> tuple[Sample, ...]:
    """The quantities beside their references, of a healthy contact."""
    return tuple(Sample.of(row) for row in record.parts if "uncertainty" in row.measures)


@dataclass(frozen=True)
class DefectRun:
    """A case of the quick catalogue under a defect by its name, or healthy."""

    defect: str
    case: str

    @property
    def name(self) -> str:
        """For files."""
        return f"{self.defect or 'healthy'}--{self.case.replace('_', '-')}"

    def compute(self) -> CaseRecord:
        """Plant the defect, let the case be judged, and take the defect out again."""
        _all_imported()
        if self.defect == HEALTHY:
            outcome = judged(self.case)
        else:
            with planted(DEFECTS[self.defect]):
                outcome = judged(self.case)
        return record_of(self, outcome)


@dataclass(frozen=True)
class HealthyRun:
    """A contact of a family by the number of its draw, solved on all its grids."""

    family: str
    draw: int

    @property
    def name(self) -> str:
        """For files."""
        return f"{self.family.replace('_', '-')}-{self.draw:03d}"

    def compute(self) -> CaseRecord:
        """Solve and judge it."""
        number = list(FAMILIES).index(self.family)
        case = FAMILIES[self.family](np.random.default_rng((SEED, number, self.draw)))
        results: dict[str, Any] = {}

        def solve(run: AnyRun) -> Any:
            results[run.label] = run.solve()
            return results[run.label]

        outcome = judge(case, solve)
        return record_of(self, outcome, tuple(_samples(case, outcome, results)))


@cache
def _all_imported() -> None:
    """What modules compute when they are imported, they compute healthy."""
    choose(Level.QUICK)


def record_of(
    run: DefectRun | HealthyRun,
    outcome: CaseOutcome,
    measured: Sequence[Sample] = (),
) -> CaseRecord:
    """Counts of the verdicts, those that failed, and the samples.

    largest_error  of the quantities, relative to their scales: what a fixed gate would look at;
                   None where one of them has none
    """
    failed = tuple(_caught(outcome))
    return CaseRecord(
        parameters=parameters_of(run),
        measures={ERROR: _largest_error(outcome)},
        counters={
            "verdicts": len(outcome.verdicts),
            "failed": len(failed),
            "inconclusive": outcome.count(Status.INCONCLUSIVE),
        },
        parts=tuple(one.row() for one in (*failed, *measured)),
    )


def judged(name: str) -> CaseOutcome:
    """The outcome of a case after its way through a file, or why there is none."""
    case = CaseToJudge(name, Level.QUICK.name)
    try:
        with TemporaryDirectory() as directory:
            store = CaseStore(Path(directory), JudgedCase)
            store.save(case, case.compute())
            record = store.load(case)
    except Exception as error:  # whatever it is, it must be named: so does the pool of `verify`
        return lost(case_of(name, Level.QUICK), f"{type(error).__name__}: {error}")
    assert isinstance(record, JudgedCase)
    return record.outcome


def _caught(outcome: CaseOutcome) -> Iterator[Caught]:
    for verdict in outcome.verdicts:
        if verdict.status is Status.FAIL:
            yield Caught(
                quantity=verdict.name,
                run=verdict.run,
                how=_how(verdict),
                clearance=verdict.clearance,
                reason=verdict.meaning if verdict.name == SOLVED else "",
            )


def _how(verdict: Verdict) -> str:
    if verdict.name == SOLVED:
        return "named error"
    if verdict.name in LAWS:
        return LAWS[verdict.name]
    if verdict.tolerance_kind == "order":
        return "order"
    return f"{verdict.reference_kind}, {verdict.tolerance_kind} tolerance"


def _largest_error(outcome: CaseOutcome) -> float | None:
    errors = [
        verdict.error
        for verdict in outcome.verdicts
        if verdict.tolerance_kind != "order" and verdict.name not in LAWS
    ]
    if not errors or any(error is None for error in errors):
        return None
    return max(error for error in errors if error is not None)


def _samples(case: Case, outcome: CaseOutcome, results: Mapping[str, Any]) -> Iterator[Sample]:
    verdicts = {verdict.name: verdict for verdict in outcome.verdicts}
    for quantity in case.quantities:
        verdict = verdicts.get(quantity.name)
        if verdict is None:
            continue
        uncertainty = None
        if isinstance(quantity.tolerance, Derived):
            whole = expanded_uncertainty(quantity, quantity.tolerance, case, results)
            uncertainty = whole / verdict.scale
        yield Sample(
            quantity=quantity.name,
            error=verdict.error,
            allowed=verdict.allowed,
            uncertainty=uncertainty,
        )
