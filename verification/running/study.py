"""Data model of a study: its cases, their records, statements, conclusion and stored files.

A study measures one property of the program on many cases, such as cost or stability.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any, Protocol, Self, TypeVar

from pydantic import Field, model_validator

from contact_scene.reading.description import Description
from verification.exhibits.chart import Chart, Table
from verification.judging.case import Level
from verification.judging.outcome import Status, commit_text
from verification.running.provenance import Provenance, age_text

Value = str | bool | int | float | None


class Row(Description):
    """Values of one observation in a study, such as one solve or one profile point, by name.

    They are grouped into parameters (inputs), measures, counters and texts.
    """

    parameters: dict[str, Value] = Field(default_factory=dict)
    """Inputs of the observation."""

    measures: dict[str, float | None] = Field(default_factory=dict)
    """Measured values; null if not finite or not known."""

    units: dict[str, str] = Field(default_factory=dict)
    """Units of the measures that have one."""

    counters: dict[str, int] = Field(default_factory=dict)
    """Counts, which are equal in every run."""

    words: dict[str, str] = Field(default_factory=dict)
    """Texts, such as kinds of outcomes and reasons."""


def value_of(row: Row, name: str) -> float:
    """Return a measured value of a study row by name, where the value must be known.

    Raises KeyError if the row has no such value, and ValueError if the value is null.
    """
    value = row.measures[name]
    if value is None:
        raise ValueError(f"{name} is not known of {row.parameters}")
    return value


class CaseRecord(Row):
    """Stored result of one case of a study: values of the case, rows of its parts, and times."""

    parts: tuple[Row, ...] = ()
    """Rows of the parts of the case, such as profile points or judged quantities."""

    seconds: float = 0.0
    """CPU time [s]: as measured by the case, or of the worker's whole work on it. Apart from
    `repeats`, only this value differs between equal runs.
    """

    repeats: int = 1
    """Number of solves whose median time is `seconds`."""


class TypedRow(Description):
    """Base class of study rows with declared names and types of their values.

    A study stores such an object as a `Row`: texts and enumeration members become `words`, integers
    and booleans become `counters`, other numbers become `measures`.
    """

    def row(self) -> Row:
        """Convert the object with typed values to a `Row`, the form in which a study stores its
        rows."""
        values = self.model_dump(mode="json")
        words = {name: value for name, value in values.items() if isinstance(value, str)}
        counters = {name: int(value) for name, value in values.items() if isinstance(value, int)}
        return Row(
            measures={n: v for n, v in values.items() if n not in words and n not in counters},
            counters=counters,
            words=words,
        )

    @classmethod
    def of(cls, row: Row) -> Self:
        """Create the object with typed values from the `Row` in which a study has stored the
        values."""
        known: dict[str, Any] = {**row.parameters, **row.measures, **row.counters, **row.words}
        return cls.model_validate({name: known[name] for name in cls.model_fields if name in known})


class StudyCase(Protocol):
    """Interface of one case of a study: a frozen dataclass of plain values, which can be sent to a
    worker process.
    """

    @property
    def name(self) -> str:
        """Name of the case, unique in its study, of letters, digits and hyphens; used for files."""

    def compute(self) -> Description:
        """Compute the case and return its record, which is a `CaseRecord` in studies.

        Raises the errors of solvers.
        """


C = TypeVar("C", bound=StudyCase)


def found(cases: Iterable[C], records: Mapping[str, CaseRecord]) -> dict[C, CaseRecord]:
    """Return the records of those cases of a study that have one, by case, in the order of the
    cases.

    records  available records by name of the case
    """
    return {case: records[case.name] for case in cases if case.name in records}


def parameters_of(case: Any) -> dict[str, Value]:
    """Return the fields of a case (a dataclass) as plain values by name, with nested dataclasses
    flattened.

    Enumeration members become their values; tuples become texts joined by " x ". Used for the
    columns of the stored tables.
    """
    values: dict[str, Value] = {}
    for field in fields(case):
        value = getattr(case, field.name)
        if is_dataclass(value):
            values |= parameters_of(value)
        elif isinstance(value, Enum):
            values[field.name] = value.value
        elif isinstance(value, tuple):
            values[field.name] = " x ".join(map(str, value))
        else:
            values[field.name] = value
    return values


ROWS = "rows.csv"
PARTS = "parts.csv"
FINDINGS = "findings.csv"
SECONDS = "seconds.csv"

CASE = "case name"  # a column that no parameter can have: fields of cases have no space

Cells = Mapping[str, object]


def row_files(records: Mapping[str, CaseRecord], findings: Sequence[Row] = ()) -> dict[str, str]:
    """Return the texts of the CSV files of a study by file name, without empty files.

    `rows.csv` has one line per case, `parts.csv` one per part of a case, `findings.csv` one per row
    of the conclusion, `seconds.csv` the CPU times.

    records   records by name of the case
    findings  rows of the conclusion
    """
    files: dict[str, Sequence[Cells]] = {
        ROWS: _rows_by_case(records.items()),
        PARTS: _rows_by_case(
            (name, part) for name, record in records.items() for part in record.parts
        ),
        FINDINGS: [_csv_line(row) for row in findings],
        SECONDS: [
            {CASE: name, "seconds": record.seconds, "repeats": record.repeats}
            for name, record in records.items()
        ],
    }
    return {name: csv_text(lines) for name, lines in files.items() if lines}


def _rows_by_case(rows: Iterable[tuple[str, Row]]) -> list[Cells]:
    """Convert rows of a study to lines of a CSV file, where the first column names the case.

    rows  pairs of the name of a case and one of its rows
    """
    return [{CASE: name, **_csv_line(row)} for name, row in rows]


def _csv_line(row: Row) -> Cells:
    """Convert a row of a study to a line of a CSV file: cells by column name.

    The columns have the names of parameters and words, "name [unit]" for measures and "name
    [count]" for counters.
    """
    return {
        **row.parameters,
        **{f"{name} [{row.units.get(name, '1')}]": v for name, v in row.measures.items()},
        **{f"{name} [count]": count for name, count in row.counters.items()},
        **row.words,
    }


def csv_text(lines: Iterable[Cells]) -> str:
    """Write the lines of a table as CSV text, with a column for every name in any line.

    lines  cells of each line by column name
    """
    lines = tuple(lines)
    text = io.StringIO()
    head = dict.fromkeys(name for line in lines for name in line)
    table = csv.DictWriter(text, head, lineterminator="\n")
    table.writeheader()
    table.writerows(lines)
    return text.getvalue()


STUDY_VERSION = 1


@dataclass(frozen=True)
class Settings:
    """Extent of a study, as chosen on the command line.

    level   quick, standard or full; determines all values that are None
    cells   cells per side of the finest grid; None for the value of the level
    """

    level: Level
    cells: int | None = None


class Statement(Description):
    """Claim of a study with its outcome and the measured numbers as text."""

    claim: str
    outcome: Status | None
    """None for a finding: a number that is reported and not judged."""

    measured: str
    because: str = ""
    about: Row | None = None
    """Measured numbers of older records as fields; null in others."""


class LostCase(Description):
    """Name of a case of a study that has no record, for instance after an error, and the reason."""

    name: str
    reason: str


class Conclusion(Description):
    """Statements, tables, charts and remarks that a study derives from its records."""

    statements: tuple[Statement, ...]
    answer: str = ""
    """Answer to the question of the study in one sentence; empty if only the
    statements answer it."""

    tables: tuple[Table, ...] = ()
    charts: tuple[Chart, ...] = ()
    rows: tuple[Row, ...] = ()
    """Numbers from which other tables and pages are made."""

    remarks: tuple[str, ...] = ()
    """Assumptions, and limits of the study."""


Records = Mapping[str, CaseRecord]


@dataclass(frozen=True)
class Study:
    """Definition of a study in the catalogue: the cases to compute and the evaluation of their
    records.

    name      name on the command line
    title     one line for lists and for the head of the page
    question  question that the study answers, for readers
    cases     function that returns the cases to compute
    conclude  function that derives the conclusion from the available records, by name of the case
    """

    name: str
    title: str
    question: str
    cases: Callable[[Settings], tuple[StudyCase, ...]]
    conclude: Callable[[Settings, Records], Conclusion]


class StudyRecord(Description):
    """Stored record of a study: all data that its page shows."""

    schema_version: int = STUDY_VERSION
    name: str
    title: str
    question: str
    level: str
    conclusion: Conclusion
    lost: tuple[LostCase, ...]
    """Cases without a record, which the conclusion leaves out."""

    provenance: Provenance
    own_cells: bool = False
    """True if the user chose the number of cells or the scene; the record then represents no
    level."""

    @model_validator(mode="after")
    def _is_of_this_version(self) -> StudyRecord:
        if self.schema_version != STUDY_VERSION:
            raise ValueError(f"it is of version {self.schema_version}, not {STUDY_VERSION}")
        return self

    @property
    def status(self) -> Status:
        """Overall status of a study: FAIL if a claim failed or a case has no record.

        Otherwise the status is INCONCLUSIVE if any claim is inconclusive, and else PASS.
        """
        outcomes = {statement.outcome for statement in self.conclusion.statements}
        if self.lost or Status.FAIL in outcomes:
            return Status.FAIL
        return Status.INCONCLUSIVE if Status.INCONCLUSIVE in outcomes else Status.PASS


def dump_study(record: StudyRecord) -> str:
    """Convert the record of a study to JSON text, without fields that have their default value."""
    said = record.model_dump(mode="json", exclude_defaults=True)
    return json_text({"schema_version": record.schema_version} | said)


def json_text(values: dict[str, Any]) -> str:
    """Return indented JSON text of a record, in which lists and objects without nested ones take
    one line."""
    text = json.dumps(values, indent=1, ensure_ascii=False, allow_nan=False)
    # No text of JSON has a line's end in it: only the space between values is changed.
    return re.sub(r"[\[{]\n[^\[\]{}]*[\]}]", lambda m: re.sub(r"\n *", " ", m[0]), text) + "\n"


def study_failure_line(study: StudyRecord) -> str:
    """Describe the first failed claim or lost case of a study in one line of a log.

    The line contains the command that repeats the study.
    """
    failed = [s for s in study.conclusion.statements if s.outcome is Status.FAIL]
    found = [f"{s.claim}: {s.measured}" for s in failed]
    found += [f"{case.name} was lost: {case.reason}" for case in study.lost]
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return f"FAIL study {study.name}: {found[0]}{more}; reproduce: {study.provenance.command}"


def measured_text(study: StudyRecord) -> str:
    """Return a note with the commit of a study record that is older than the source code.

    The note is empty for a record of the present source code.
    """
    made = study.provenance
    age = age_text(made)
    return age and f", {age}: measured at {commit_text(made.commit, changed=made.changed)}"


RECORD = "study.json"


def stored_studies(
    directory: Path, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """Read the study records in all subfolders of a directory, sorted by name of the study.

    left_out  function called with a message for each record that is damaged or of another version;
              None raises ValueError with the path instead
    """
    records = []
    for path in sorted(directory.glob(f"*/{RECORD}")):
        try:
            records.append(StudyRecord.model_validate_json(path.read_bytes()))
        except ValueError as error:
            problem = f"{path} is no record of a study that can be read"
            if left_out is None:
                raise ValueError(problem) from error
            left_out(problem)
    return tuple(sorted(records, key=lambda record: record.name))


RESIDUAL = "largest_residual"  # measure: largest residual of any increment of a case


def judged(good: bool, *, complete: bool = True) -> Status:
    """Return the outcome of a claim of a study: PASS, FAIL, or INCONCLUSIVE if required cases are
    missing.

    good      True if the available records fulfil the claim
    complete  True if all required cases are available
    """
    if not complete:
        return Status.INCONCLUSIVE
    return Status.PASS if good else Status.FAIL


def total(rows: Iterable[Row], counter: str) -> int:
    """Return the sum of a counter, such as "iterations", over the rows of a study.

    Rows without the counter add 0.
    """
    return sum(row.counters.get(counter, 0) for row in rows)


def solved(claim: str, count: int, asked: int, what: str = "") -> Statement:
    """Create the statement of a study that all requested cases have a record, with its outcome.

    claim  text of the claim
    count  number of cases with a record
    asked  number of requested cases
    what   noun for the counted cases
    """
    return Statement(
        claim=claim,
        outcome=judged(count == asked),
        measured=f"{count} of {asked}{what and ' '}{what}",
    )
