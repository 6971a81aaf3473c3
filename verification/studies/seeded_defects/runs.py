"""Runs of the seeded-defect study: verdicts on a case under a defect, and on a healthy contact."""

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
    """A verdict that failed: the judged quantity, the run and the reason."""

    PARAMETERS = ("quantity", "run")

    quantity: str
    run: str
    how: str
    """Kind of check that failed, such as "residual", "law", "order" or a kind of reference."""

    clearance: float | None
    """Error divided by the allowed error; null if there is no number."""

    reason: str = ""
    """Reason why a case or a run has no result."""

    @property
    def by_law(self) -> bool:
        """Determine if the failed verdict checks a law of every result, such as the energy balance.

        Such a verdict needs no reference solution.
        """
        return self.how in LAWS.values()


class Sample(TypedRow):
    """Error of one computed quantity against its reference, relative to the scale of the quantity.

    allowed      error that the verdict allows
    uncertainty  expanded uncertainty U = 2u before its cap; null if the tolerance is not derived
    """

    PARAMETERS = ("quantity",)

    quantity: str
    error: float | None
    allowed: float | None
    uncertainty: float | None
    """Expanded uncertainty U = 2u before it is capped; null if the tolerance is not derived."""


def caught(record: CaseRecord) -> tuple[Caught, ...]:
    """Return the failed verdicts in the record of a verification case."""
    return tuple(Caught.of(row) for row in record.parts if "how" in row.words)


def samples(record: CaseRecord) -> tuple[Sample, ...]:
    """Return the errors of all quantities with a reference from the record of a random healthy
    contact.
    """
    return tuple(Sample.of(row) for row in record.parts if "uncertainty" in row.measures)


@dataclass(frozen=True)
class DefectRun:
    """Represent a case of the quick catalogue, solved under a seeded defect or without a defect.

    defect  name of the defect; empty for a healthy run
    case    name of the case
    """

    defect: str
    case: str

    @property
    def name(self) -> str:
        """File name of the record: the defect ("healthy" without one) and the case."""
        return f"{self.defect or 'healthy'}--{self.case.replace('_', '-')}"

    def compute(self) -> CaseRecord:
        """Plant the defect in the solvers, solve and judge the verification case, and remove the
        defect.
        """
        _all_imported()
        if self.defect == HEALTHY:
            outcome = judged(self.case)
        else:
            with planted(DEFECTS[self.defect]):
                outcome = judged(self.case)
        return record_of(self, outcome)


@dataclass(frozen=True)
class HealthyRun:
    """Represent a random contact without defect, solved on all grids of its case.

    family  name of the family of contacts
    draw    number of the random draw in the family
    """

    family: str
    draw: int

    @property
    def name(self) -> str:
        """File name of the record of the random contact: its family and the number of the draw."""
        return f"{self.family.replace('_', '-')}-{self.draw:03d}"

    def compute(self) -> CaseRecord:
        """Draw the contact, solve it on all grids, judge the results, and record the errors."""
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
    """Import all modules of the quick verification cases before a defect is planted in the solvers.

    Constants that modules compute at import are then free of the defect.
    """
    choose(Level.QUICK)


def record_of(
    run: DefectRun | HealthyRun,
    outcome: CaseOutcome,
    measured: Sequence[Sample] = (),
) -> CaseRecord:
    """Record the counts of the verdicts of a case, the failed verdicts and the errors of its
    quantities.

    The measure `largest_error` is the largest error of the quantities relative to their scales,
    which a fixed gate would compare. It is None if a quantity has no error.
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
    """Solve and judge a verification case, with its record written to a file and read back.

    An exception becomes an outcome without results that names the exception.

    name  name of the case in the quick catalogue
    """
    case = CaseToJudge(name, Level.QUICK.name)
    try:
        with TemporaryDirectory() as directory:
            store = CaseStore(Path(directory), JudgedCase)
            store.save(case, case.compute())
            record = store.load(case)
    except Exception as error:  # reported by name, as in the pool of `verify`
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
