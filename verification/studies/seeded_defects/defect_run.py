"""One case of the catalogue under one defect, judged as `slipstick verify` judges it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, ClassVar

from contact_scene.description import Description
from verification.cases.catalogue import case_of, choose
from verification.cases.judged_case import CaseToJudge, JudgedCase, lost
from verification.defects.defect import planted
from verification.defects.registry import DEFECTS
from verification.judging.case import Level
from verification.judging.outcome import (
    IMBALANCE,
    RESIDUAL,
    SOLVED,
    VIOLATION,
    CaseOutcome,
    Status,
    Verdict,
)
from verification.running.case_store import CaseStore

if TYPE_CHECKING:
    from collections.abc import Iterator

HEALTHY = ""
GATE = 1e-2
LAWS = {RESIDUAL: "residual", VIOLATION: "law", IMBALANCE: "law"}


class Caught(Description):
    """A verdict that failed."""

    quantity: str
    run: str
    how: str
    """What it was judged by."""

    clearance: float | None
    """Error over what is allowed; null where there is no number."""

    reason: str = ""
    """Why a case or a run has no result."""

    @property
    def by_law(self) -> bool:
        """Whether a law sees it that every result obeys, and no reference."""
        return self.how in LAWS.values()


class DefectRecord(Description):
    """What the verification says of a case under a defect."""

    caught: tuple[Caught, ...]
    verdicts: int
    inconclusive: int
    largest_error: float | None
    """Of the quantities, relative to their scales: what a fixed gate would look at. Null where
    one of them has none."""


@dataclass(frozen=True)
class DefectRun:
    """A case of the quick catalogue under a defect by its name, or healthy."""

    record_type: ClassVar[type[Description]] = DefectRecord
    defect: str
    case: str

    @property
    def name(self) -> str:
        """For files."""
        return f"{self.defect or 'healthy'}--{self.case.replace('_', '-')}"

    def compute(self) -> DefectRecord:
        """Plant the defect, let the case be judged, and take the defect out again."""
        choose(Level.QUICK)  # what modules compute when they are imported, they compute healthy
        if self.defect == HEALTHY:
            outcome = judged(self.case)
        else:
            with planted(DEFECTS[self.defect]):
                outcome = judged(self.case)
        return DefectRecord(
            caught=tuple(_caught(outcome)),
            verdicts=len(outcome.verdicts),
            inconclusive=outcome.count(Status.INCONCLUSIVE),
            largest_error=_largest_error(outcome),
        )


def judged(name: str) -> CaseOutcome:
    """The outcome of a case after its way through a file, or why there is none."""
    case = CaseToJudge(name, Level.QUICK.name)
    try:
        with TemporaryDirectory() as directory:
            store = CaseStore(Path(directory))
            store.save(case, case.compute())
            record = store.load(case)
    except Exception as error:  # whatever it is, it must be named: so does the pool of `verify`
        return lost(case_of(name, Level.QUICK), f"{type(error).__name__}: {error}")
    assert isinstance(record, JudgedCase)
    return record.outcome


def _caught(outcome: CaseOutcome) -> Iterator[Caught]:
    for verdict in outcome.verdicts:
        if verdict.status is Status.FAIL:
            solved = verdict.name == SOLVED
            yield Caught(
                quantity=verdict.name,
                run=verdict.run,
                how=_how(verdict),
                clearance=verdict.clearance,
                reason=verdict.meaning if solved else "",
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
