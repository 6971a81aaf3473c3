"""`report.json`: all that a report shows. Only `provenance` differs between two equal runs."""

import json
from pathlib import Path
from typing import Any

from contact_scene.description import Description
from verification.cases.outcome import CaseOutcome, Status, Verdict
from verification.report.provenance_record import Benchmark, Provenance
from verification.studies.running.record import StudyRecord

__all__ = ["Benchmark", "Provenance", "Report"]

REPORT_VERSION = 1


class Report(Description):
    """A verification report."""

    schema_version: int = REPORT_VERSION
    level: str
    counts: dict[Status, int]
    """How many verdicts ended how."""

    cases: tuple[CaseOutcome, ...]
    omissions: tuple[str, ...]
    """What is not verified, and known limits."""

    provenance: Provenance
    studies: tuple[StudyRecord, ...] = ()
    """Records of studies, each made by its own command."""

    @property
    def status(self) -> Status:
        """Fail if anything failed; inconclusive only if nothing did."""
        if self.counts[Status.FAIL]:
            return Status.FAIL
        return Status.INCONCLUSIVE if not self.counts[Status.PASS] else Status.PASS

    @property
    def failures(self) -> tuple[tuple[CaseOutcome, Verdict], ...]:
        """Every failed verdict with its case."""
        return tuple(
            (case, verdict)
            for case in self.cases
            for verdict in case.verdicts
            if verdict.status is Status.FAIL
        )


def count(cases: tuple[CaseOutcome, ...]) -> dict[Status, int]:
    """Verdicts of all cases by status, every status present."""
    return {status: sum(case.count(status) for case in cases) for status in Status}


def dump_report(report: Report) -> str:
    """The report as JSON text, every key present."""
    record = report.model_dump(mode="json")
    return json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def load_report(path: Path) -> Report:
    """The report back from its file; ValueError for anything else, OSError if unreadable."""
    return Report.model_validate_json(path.read_text(encoding="utf-8"))


def report_schema() -> dict[str, Any]:
    """JSON Schema of `report.json`."""
    schema = Report.model_json_schema(mode="serialization")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
