"""Record `report.json` of a verification report: all data that the report shows.

Only `provenance` differs between two runs of the same code. `stored_records` lists the records of
the studies and of the full report in the repository.
"""

from __future__ import annotations

import lzma
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError, model_validator

from contact_results.directory.json_record import first_mistake
from contact_scene.reading.description import Description
from verification.judging.case import Level
from verification.judging.outcome import (
    LEAST_SHARE,
    CaseOutcome,
    GoneCase,
    Status,
    Verdict,
    share_covered,
)
from verification.running.provenance import Provenance, is_current
from verification.running.study import RECORD, StudyRecord, json_text, stored_studies

REPORT_VERSION = 1
PACKED_SUFFIX = ".xz"
LARGEST_RECORD = 100_000_000  # bytes, unpacked; a full report has a few million


class Report(Description):
    """Verification report: outcomes of all cases, records of the studies, and provenance."""

    schema_version: int = REPORT_VERSION
    level: str
    counts: dict[Status, int]
    """Number of verdicts by status."""

    cases: tuple[CaseOutcome, ...]
    omissions: tuple[str, ...]
    """Features that are not verified, and known limits."""

    provenance: Provenance
    studies: tuple[StudyRecord, ...] = ()
    """Records of studies, each made by its own command."""

    chosen: bool = False
    """True if only cases chosen by the user ran; otherwise all cases of the level ran."""

    gone: tuple[GoneCase, ...] = ()
    """Cases with recorded results that a report of all cases lacks."""

    unmet: tuple[str, ...] = ()
    """Requirements that no passing case of a report of all cases shows."""

    @model_validator(mode="after")
    def _counts_what_it_lists(self) -> Report:
        if self.schema_version != REPORT_VERSION:
            raise ValueError(f"it is of version {self.schema_version}, not {REPORT_VERSION}")
        levels = [level.name.lower() for level in Level]
        if self.level not in levels:
            raise ValueError(f"its level is {self.level!r}, not {', '.join(levels)}")
        names = [case.name for case in self.cases]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"it has a case twice: {', '.join(twice)}")
        if self.counts != (counted := count(self.cases)):
            raise ValueError(
                f"it counts {_counts_text(self.counts)}, but lists {_counts_text(counted)}"
            )
        return self

    @property
    def status(self) -> Status:
        """Overall status of a verification report: FAIL if a verdict, a requirement, a study or
        the stated errors failed.

        Stated errors fail if too few of them cover the true difference. Otherwise the status is
        PASS if any verdict passed, and INCONCLUSIVE if none passed.
        """
        failed = self.counts[Status.FAIL] or self.unmet or self.failed_studies
        if failed or self.errors_too_small:
            return Status.FAIL
        return Status.INCONCLUSIVE if not self.counts[Status.PASS] else Status.PASS

    @property
    def errors_too_small(self) -> bool:
        """Return True if too few stated errors cover the difference between result and reference.

        Only reports of all cases at the full level are judged.
        """
        whole = self.level == Level.FULL.name.lower() and not self.chosen
        return whole and share_covered(self.cases) < LEAST_SHARE

    @property
    def failures(self) -> tuple[tuple[CaseOutcome, Verdict], ...]:
        """Failed verdicts of the report, as pairs of a verification case and its verdict."""
        return tuple(
            (case, verdict)
            for case in self.cases
            for verdict in case.verdicts
            if verdict.status is Status.FAIL
        )

    @property
    def failed_studies(self) -> tuple[StudyRecord, ...]:
        """Failed studies of the report whose records were computed by the present source code."""
        return tuple(
            study
            for study in self.studies
            if study.status is Status.FAIL and is_current(study.provenance)
        )


def count(cases: tuple[CaseOutcome, ...]) -> dict[Status, int]:
    """Count the verdicts of all verification cases by status; every status is a key, even with
    count 0."""
    return {status: sum(case.count(status) for case in cases) for status in Status}


def _counts_text(counts: dict[Status, int]) -> str:
    return ", ".join(f"{counts.get(status, 0)} {status}" for status in Status)


def dump_report(report: Report) -> str:
    """Convert a verification report to JSON text with all keys, including those with default
    values."""
    return json_text(report.model_dump(mode="json"))


def load_report(path: Path) -> Report:
    """Read a verification report from its JSON file, which may be compressed by xz.

    Raises ValueError with a message of one line if the file is damaged, inconsistent or of another
    version, and OSError if the file cannot be read.
    """
    content = _unpacked(path) if path.suffix == PACKED_SUFFIX else path.read_bytes()
    try:
        return Report.model_validate_json(content)
    except ValidationError as error:
        raise ValueError(first_mistake(error)) from None


def _unpacked(path: Path) -> bytes:
    """Decompress an xz file of a verification report and return its content.

    Raises ValueError for a damaged file, or if the content is larger than 100 MB.
    """
    try:
        with lzma.open(path) as packed:
            content = packed.read(LARGEST_RECORD + 1)
    except (lzma.LZMAError, EOFError) as error:
        raise ValueError(f"it cannot be unpacked: {error}") from None
    if len(content) > LARGEST_RECORD:
        raise ValueError(f"it is larger than any report: more than {LARGEST_RECORD} bytes")
    return content


def report_schema() -> dict[str, Any]:
    """Return the JSON Schema of `report.json`, the record of a verification report."""
    schema = Report.model_json_schema(mode="serialization")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


REPORTS = Path("reports")
FULL = "full"
REPORT = "report.json"
EARLIER = "earlier"  # folder with the previous files until the new ones are complete


@dataclass(frozen=True)
class StoredRecord:
    """Stored record of a study or of the full verification report in the repository.

    path        file of the record
    provenance  version, date and times of the run that made the record
    arguments   arguments of the command `slipstick` that makes the record again
    """

    path: Path
    provenance: Provenance
    arguments: tuple[str, ...]

    @property
    def name(self) -> str:
        """Name of the folder of the record: the name of the study, or "full" for the report."""
        return self.path.parent.name

    @property
    def seconds(self) -> float:
        """Computing time of the record: sum of the wall seconds of all its cases, over all
        workers."""
        return sum(self.provenance.seconds.values())

    def pack(self) -> None:
        """Compress the record of a newly made report by xz and delete the uncompressed file.

        Nothing is done for the record of a study, which is stored uncompressed.
        """
        if self.path.suffix == PACKED_SUFFIX:
            plain = self.path.with_suffix("")
            self.path.write_bytes(lzma.compress(plain.read_bytes(), preset=9 | lzma.PRESET_EXTREME))
            plain.unlink()


def stored_records(folder: Path = REPORTS) -> list[StoredRecord]:
    """Return the stored records of all studies and of the full report, the cheapest to compute
    first.

    Raises ValueError for a damaged record.

    folder  folder of the reports in the repository
    """
    return sorted(_records(folder), key=lambda record: record.seconds)


def _records(folder: Path) -> Iterator[StoredRecord]:
    """Yield the stored records of all studies and of the full verification report, unsorted.

    Records that an interrupted regeneration has moved aside are included.

    folder  folder of the reports in the repository
    """
    studies = folder / "studies"
    for place in (studies, *sorted(studies.glob("*"))):
        for record in stored_studies(place):
            path = studies / record.name / RECORD
            words = ("study", record.name, "--level", record.level, "--output", str(path.parent))
            yield StoredRecord(path, record.provenance, ("maintain", *words))
    report = folder / FULL / f"{REPORT}{PACKED_SUFFIX}"
    for path in (report, report.parent / EARLIER / report.name):
        if path.is_file():
            verify = ("verify", "--level", FULL, "--output", str(report.parent))
            yield StoredRecord(report, load_report(path).provenance, verify)
