"""Stored records of studies and of the full report, with their age and their cost."""

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
EARLIER = "earlier"  # of a directory: the files before, until the new ones are whole


@dataclass(frozen=True)
class StoredRecord:
    """A record in the repository.

    arguments  of `slipstick`, which make it again
    """

    path: Path
    provenance: Provenance
    arguments: tuple[str, ...]

    @property
    def name(self) -> str:
        """Name of its folder."""
        return self.path.parent.name

    @property
    def seconds(self) -> float:
        """Wall seconds of its cases, of all workers together."""
        return sum(self.provenance.seconds.values())

    def pack(self) -> None:
        """Replace a report by its packed form, if the record is packed."""
        if self.path.suffix == PACKED_SUFFIX:
            plain = self.path.with_suffix("")
            self.path.write_bytes(lzma.compress(plain.read_bytes(), preset=9 | lzma.PRESET_EXTREME))
            plain.unlink()


def stored_records(folder: Path = REPORTS) -> list[StoredRecord]:
    """Return the records of a folder, the cheapest first; raises ValueError for a damaged one."""
    return sorted(_records(folder), key=lambda record: record.seconds)


def _records(folder: Path) -> Iterator[StoredRecord]:
    """Yield all records, also those that a killed regeneration has set aside."""
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
