"""What is recorded of a case: plain values, one file per case, one recording per level."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, model_validator

from contact_scene.reading.description import Description
from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    Count,
    FindingRecord,
    RunRecord,
    Status,
    Verdict,
)

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.running.report_record import Provenance

BASELINE_VERSION = 1
COUNTERS = ("increments", "iterations", "convolutions", "factorizations")

Key = tuple[str, ...]


class RecordedQuantity(Description):
    """A judged quantity. `allowed` and `reference` are in the unit of the value."""

    name: str
    run: str
    tolerance_kind: str
    unit: str
    value: float | None
    reference: float
    allowed: Annotated[float, Field(ge=0)]
    status: Status
    covered: bool | None = None
    """Whether the stated error covered the difference from the reference."""

    @model_validator(mode="after")
    def _has_an_error(self) -> RecordedQuantity:
        if self.error is not None and not math.isfinite(self.error / (self.allowed or 1.0)):
            raise ValueError(
                f"{self.name} [{self.run}]: value {self.value}, reference {self.reference} and "
                f"allowed {self.allowed} make no finite error"
            )
        return self

    @property
    def error(self) -> float | None:
        """|value - reference|; None for a value that is not finite."""
        return None if self.value is None else abs(self.value - self.reference)

    @property
    def key(self) -> Key:
        """What it is found by within its case."""
        return key_of(self)


class RecordedFinding(Description):
    """A number that is reported and not judged."""

    name: str
    run: str
    unit: str
    value: float | None

    @property
    def key(self) -> Key:
        """What it is found by within its case."""
        return key_of(self)


class RecordedRun(Description):
    """Deterministic counts of a solve."""

    label: str
    increments: Count
    iterations: Count
    convolutions: Count
    factorizations: Count


class RecordedBy(Description):
    """Who made the numbers, from what, and why they were accepted."""

    reason: str
    command: str
    date: str
    commit: str | None
    changed: bool
    program_version: str
    processor: str | None
    """Whose instructions computed; see `machine.arithmetic`."""

    python: str | None
    libraries: dict[str, str | None]


class Recording(Description):
    """A case as it came out at one level."""

    by: RecordedBy
    status: Status
    quantities: tuple[RecordedQuantity, ...]
    findings: tuple[RecordedFinding, ...]
    runs: tuple[RecordedRun, ...]

    @model_validator(mode="before")
    @classmethod
    def _without_time(cls, values: dict[str, object]) -> dict[str, object]:
        """Drop the CPU time of older recordings."""
        return {name: value for name, value in values.items() if name != "loops"}


class Baseline(Description):
    """The content of a file: a case at each level at which it was recorded."""

    schema_version: int = BASELINE_VERSION
    case: str
    levels: dict[str, Recording]


def key_of(number: Verdict | FindingRecord | RecordedQuantity | RecordedFinding) -> Key:
    """What a number is found by within its case."""
    run = "" if number.name in FOUND_IN_A_RUN else number.run
    if isinstance(number, Verdict | RecordedQuantity):
        return ("quantity", number.name, run, number.tolerance_kind)
    return ("finding", number.name, run)


def keys_of(recorded: Recording | None) -> set[str]:
    """Return the keys of the recorded numbers, in words."""
    if recorded is None:
        return set()
    keys = (*(one.key for one in recorded.quantities), *(one.key for one in recorded.findings))
    return {f"{name} [{run}]" for _, name, run, *_ in keys}


def recording(case: CaseOutcome, provenance: Provenance, reason: str) -> Recording:
    """What came out of a case, as it is recorded."""
    return Recording(
        by=recorded_by(provenance, reason),
        status=case.status,
        quantities=tuple(_quantity(verdict) for verdict in case.verdicts),
        findings=tuple(
            RecordedFinding(name=f.name, run=f.run, unit=f.unit, value=f.value)
            for f in case.findings
        ),
        runs=tuple(_run(run) for run in case.runs),
    )


def recorded_by(provenance: Provenance, reason: str) -> RecordedBy:
    """The part of a report's provenance that explains its numbers."""
    machine = provenance.machine
    processor, python = machine.get("arithmetic", machine.get("processor")), machine.get("python")
    return RecordedBy(
        reason=reason,
        command=provenance.command,
        date=provenance.date,
        commit=provenance.commit,
        changed=provenance.changed,
        program_version=provenance.program_version,
        processor=None if processor is None else str(processor),
        python=None if python is None else str(python),
        libraries=provenance.libraries,
    )


def _quantity(verdict: Verdict) -> RecordedQuantity:
    return RecordedQuantity(
        name=verdict.name,
        run=verdict.run,
        tolerance_kind=verdict.tolerance_kind,
        unit=verdict.unit,
        value=verdict.value,
        reference=verdict.reference,
        allowed=verdict.most_allowed,
        status=verdict.status,
        covered=verdict.covered,
    )


def _run(run: RunRecord) -> RecordedRun:
    return RecordedRun(label=run.label, **{name: getattr(run, name) for name in COUNTERS})
