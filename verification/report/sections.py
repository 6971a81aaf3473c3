"""Sections that a study makes: its record, or the command that makes one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from verification.running.record import StudyRecord
from verification.running.report_record import Report
from verification.running.sources import is_current

# By the name of its study. A study gets its place on the page in `templates/page.html`.
TITLES = {
    "coated-tractions": "Coated contacts: the paper's figures 3 and 4",
    "work-precision": "What accuracy costs",
    "error-coverage": "Coverage of stated errors",
    "stability": "The stability map",
    "seeded-defects": "Seeded defects",
    "mutants": "What the tests of kernels notice",
    "scoreboard": "Other codes on the same problems",
}
LEVELS = ("quick", "standard", "full")
PLACES = (Path("reports/studies"), Path("out"))  # where records are looked for


@dataclass(frozen=True)
class StudySection:
    """A place of the page.

    record   what a study found; None if no record of it was at hand
    command  makes the record
    """

    name: str
    title: str
    record: StudyRecord | None
    command: str


def study_section(report: Report, name: str) -> StudySection:
    """The section of a study of this name; KeyError if the page has no place for it."""
    command = f"slipstick maintain study {name} --level {report.level}"
    return StudySection(name, TITLES[name], study_of(report, name), command)


def study_of(report: Report, name: str) -> StudyRecord | None:
    """The record of a study; None without one."""
    return next((record for record in report.studies if record.name == name), None)


def stored_records(
    places: Iterable[Path] = PLACES, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """Of every study that the page has a place for the record that tells most about these sources;
    by name. One that they have made goes before those of others, whatever their level; then the
    higher level, and of two such the later. What was computed on cells of somebody's choice is no
    level of a study.

    left_out  is told of a record that is broken or of another version; without it that raises
              ValueError, naming the file
    """
    from verification.running.stored_studies import stored_studies

    best: dict[str, StudyRecord] = {}
    for place in places:
        for record in stored_studies(place, left_out):
            if record.own_cells or record.name not in TITLES:
                continue
            if _rank(record) >= _rank(best.get(record.name)):
                best[record.name] = record
    return tuple(best[name] for name in sorted(best))


def _rank(record: StudyRecord | None) -> tuple[bool, int, str]:
    if record is None:
        return False, -2, ""
    level = LEVELS.index(record.level) if record.level in LEVELS else -1
    return is_current(record.provenance), level, record.provenance.date
