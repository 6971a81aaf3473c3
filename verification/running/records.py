"""Stored records of the studies and of the full verification report in the repository.

Used to list and to regenerate all records.
"""

from __future__ import annotations

import lzma
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from verification.running.provenance import Provenance
from verification.running.report_record import PACKED_SUFFIX, load_report
from verification.running.study import RECORD, stored_studies

REPORTS = Path("reports")
FULL, REPORT = "full", "report.json"
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
