"""A study: cases that are computed one by one, and what is concluded from all of them."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any, ClassVar, Protocol, Self, TypeVar

from pydantic import Field, model_validator

from contact_scene.reading.description import Description
from verification.exhibits.chart import Chart, Table, plain
from verification.judging.case import Level
from verification.judging.outcome import Status, commit_text
from verification.running.provenance import Provenance
from verification.running.sources import age_text

Value = str | bool | int | float | None


class Row(Description):
    """One observation."""

    parameters: dict[str, Value] = Field(default_factory=dict)
    """What it is of: what was asked for."""

    measures: dict[str, float | None] = Field(default_factory=dict)
    """What was measured; null where it is not finite or not known."""

    units: dict[str, str] = Field(default_factory=dict)
    """Of the measures that have one."""

    counters: dict[str, int] = Field(default_factory=dict)
    """What was counted: the same at every run."""

    words: dict[str, str] = Field(default_factory=dict)
    """What was said: kinds of ends, reasons."""

    def number(self, name: str) -> float | None:
        """A measure, a counter or a parameter that is a number; None without one. What was asked
        for goes before what was counted under the same name."""
        known: Any = {**self.measures, **self.counters, **self.parameters}.get(name)
        return None if isinstance(known, str) else known


def value_of(row: Row, name: str) -> float:
    """A measure that is known; KeyError if the row lacks it, ValueError if it is null."""
    value = row.measures[name]
    if value is None:
        raise ValueError(f"{name} is not known of {row.parameters}")
    return value


class CaseRecord(Row):
    """What a case of a study leaves, whatever it computes."""

    parts: tuple[Row, ...] = ()
    """What it saw on its way."""

    seconds: float = 0.0
    """CPU time, of the worker's whole work where the case measures none; with `repeats`, all that
    differs between equal runs."""

    clock: dict[str, float] = Field(default_factory=dict)
    """CPU seconds of its parts by name, which no run repeats either."""

    repeats: int = 1
    """Solves of which `seconds` is the median."""


class TypedRow(Description):
    """A row whose names and types are known. Of its fields texts and members of enumerations are
    kept as words, whole numbers and what is true or not as counters, other numbers as measures."""

    PARAMETERS: ClassVar[tuple[str, ...]] = ()
    """Fields that say what it is of."""

    UNITS: ClassVar[Mapping[str, str]] = {}

    def row(self) -> Row:
        """As it is kept."""
        values = self.model_dump(mode="json")
        parameters = {name: values.pop(name) for name in self.PARAMETERS}
        words = {name: value for name, value in values.items() if isinstance(value, str)}
        counters = {name: int(value) for name, value in values.items() if isinstance(value, int)}
        return Row(
            parameters=parameters,
            measures={n: v for n, v in values.items() if n not in words and n not in counters},
            units={name: unit for name, unit in self.UNITS.items() if name in values},
            counters=counters,
            words=words,
        )

    @classmethod
    def of(cls, row: Row) -> Self:
        """Back from its row."""
        known: dict[str, Any] = {**row.parameters, **row.measures, **row.counters, **row.words}
        return cls.model_validate({name: known[name] for name in cls.model_fields if name in known})


class Named(Protocol):
    """A case, by what its record is found."""

    @property
    def name(self) -> str: ...


C = TypeVar("C", bound=Named)


def found(cases: Iterable[C], records: Mapping[str, CaseRecord]) -> dict[C, CaseRecord]:
    """The records that there are, by case, in the order of the cases."""
    return {case: records[case.name] for case in cases if case.name in records}


def rows_of(cases: Iterable[C], known: Mapping[C, CaseRecord]) -> list[CaseRecord]:
    """Of these cases, those that have one."""
    return [known[case] for case in cases if case in known]


def parameters_of(case: Any) -> dict[str, Value]:
    """The plain values that a case is made of, by the names of its fields."""
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


ROWS, PARTS, FINDINGS, SECONDS = "rows.csv", "parts.csv", "findings.csv", "seconds.csv"

CASE = "case name"  # a column that no parameter can have: fields of cases have no space

Cells = Mapping[str, object]


def row_files(records: Mapping[str, CaseRecord], findings: Sequence[Row] = ()) -> dict[str, str]:
    """Return the CSV files of a study by name, without empty ones.

    `rows.csv` has one line per case, `parts.csv` one per part of a case, `findings.csv` one per row
    of the conclusion, `seconds.csv` the measured times.
    """
    clock = [(name, record.seconds, record.repeats) for name, record in records.items()]
    files: dict[str, Sequence[Cells]] = {
        ROWS: _named(records.items()),
        PARTS: _named((name, part) for name, record in records.items() for part in record.parts),
        FINDINGS: [_cells(row) for row in findings],
        SECONDS: [dict(zip((CASE, "seconds", "repeats"), line, strict=True)) for line in clock],
    }
    return {name: _text(lines) for name, lines in files.items() if lines}


def _named(rows: Iterable[tuple[str, Row]]) -> list[Cells]:
    """By name of the case that they are of."""
    return [{CASE: name, **_cells(row)} for name, row in rows]


def _cells(row: Row) -> Cells:
    """Parameters by their name, measures as name [unit], counters as name [count], words."""
    return {
        **row.parameters,
        **{f"{name} [{row.units.get(name, '1')}]": v for name, v in row.measures.items()},
        **{f"{name} [count]": count for name, count in row.counters.items()},
        **row.words,
    }


def _text(lines: Iterable[Cells]) -> str:
    """A column for every name that any line has."""
    lines = tuple(lines)
    text = io.StringIO()
    head = dict.fromkeys(name for line in lines for name in line)
    table = csv.DictWriter(text, head, lineterminator="\n")
    table.writeheader()
    table.writerows(lines)
    return text.getvalue()


STUDY_VERSION = 1


class StudyCase(Protocol):
    """A frozen dataclass of plain values that says what to compute; it is sent to a worker."""

    @property
    def name(self) -> str:
        """Names the case within its study: letters, digits and hyphens."""

    def compute(self) -> Description:
        """Do the work; raises what the solvers raise. Cases of a study give a `CaseRecord`."""


@dataclass(frozen=True)
class Settings:
    """How much is computed.

    level   decides what is left open
    cells   of the finest grid along each side; None leaves it to the level
    levels  of refinement, for studies that refine; None leaves it to the level
    """

    level: Level
    cells: int | None = None
    levels: int | None = None


class Statement(Description):
    """One line of the verdict: a claim, how it was judged, and the numbers behind it."""

    claim: str
    outcome: Status | None
    """None for a finding: a number that is reported and not judged."""

    measured: str
    because: str = ""
    about: Row | None = None
    """The same as fields: what it is about, and the numbers behind it; null in older records."""


class LostCase(Description):
    """A case without a record."""

    name: str
    reason: str


class Conclusion(Description):
    """What a study shows. Texts are for people; the numbers behind them are in the records."""

    statements: tuple[Statement, ...]
    answer: str = ""
    """To the question of the study, in a sentence; empty where only the statements answer it."""

    tables: tuple[Table, ...] = ()
    charts: tuple[Chart, ...] = ()
    rows: tuple[Row, ...] = ()
    """Numbers that are read on: tables and pages are made of them."""

    remarks: tuple[str, ...] = ()
    """What is assumed, and what the study does not show."""

    @property
    def failed(self) -> bool:
        """Return True if a statement failed."""
        return any(statement.outcome is Status.FAIL for statement in self.statements)


Records = Mapping[str, CaseRecord]


@dataclass(frozen=True)
class Study:
    """A study of the catalogue.

    title     a line for lists and the head of the page
    question  what it is about, for a reader
    cases     what has to be computed
    conclude  from the records that there are, by name of the case: some may be missing
    """

    name: str
    title: str
    question: str
    cases: Callable[[Settings], tuple[StudyCase, ...]]
    conclude: Callable[[Settings, Records], Conclusion]


class StudyRecord(Description):
    """All that the page of a study shows."""

    schema_version: int = STUDY_VERSION
    name: str
    title: str
    question: str
    level: str
    conclusion: Conclusion
    lost: tuple[LostCase, ...]
    """Cases that have no record: the conclusion does without them."""

    provenance: Provenance
    own_cells: bool = False
    """Whether somebody chose the cells: it is then of no level."""

    @model_validator(mode="after")
    def _is_of_this_version(self) -> StudyRecord:
        if self.schema_version != STUDY_VERSION:
            raise ValueError(f"it is of version {self.schema_version}, not {STUDY_VERSION}")
        return self

    @property
    def status(self) -> Status:
        """Fail if a statement failed or a case was lost."""
        outcomes = {statement.outcome for statement in self.conclusion.statements}
        if self.lost or Status.FAIL in outcomes:
            return Status.FAIL
        return Status.INCONCLUSIVE if Status.INCONCLUSIVE in outcomes else Status.PASS


def dump_study(record: StudyRecord) -> str:
    """The record as JSON text, without what is as it is where nothing is said of it."""
    said = record.model_dump(mode="json", exclude_defaults=True)
    return json_text({"schema_version": record.schema_version} | said)


def json_text(values: dict[str, Any]) -> str:
    """Return indented JSON, with lists of numbers and texts alone on one line."""
    text = json.dumps(values, indent=1, ensure_ascii=False, allow_nan=False)
    # No text of JSON has a line's end in it: only the space between values is changed.
    return re.sub(r"[\[{]\n[^\[\]{}]*[\]}]", lambda m: re.sub(r"\n *", " ", m[0]), text) + "\n"


def study_failure_line(study: StudyRecord) -> str:
    """What a study of the same sources found wrong first, and how to see it again."""
    failed = [s for s in study.conclusion.statements if s.outcome is Status.FAIL]
    found = [f"{s.claim}: {s.measured}" for s in failed]
    found += [f"{case.name} was lost: {case.reason}" for case in study.lost]
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return f"FAIL study {study.name}: {found[0]}{more}; reproduce: {study.provenance.command}"


def measured_text(study: StudyRecord) -> str:
    """Return the origin of a record that is older than the code; empty for a current one."""
    made = study.provenance
    age = age_text(made)
    return age and f", {age}: measured at {commit_text(made.commit, changed=made.changed)}"


RECORD = "study.json"


def stored_studies(
    directory: Path, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """The records of all studies that have left theirs in a folder of this directory, by name.

    left_out  is told of a record that is broken or of another version; without it that raises
              ValueError, naming the file
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


RESIDUAL = "largest_residual"  # of any increment of a case, by the name of its measure


def judged(good: bool, *, complete: bool = True) -> Status:
    """Return the outcome of a claim; open where cases are missing that it is about."""
    if not complete:
        return Status.INCONCLUSIVE
    return Status.PASS if good else Status.FAIL


def largest(rows: Iterable[Row], name: str) -> float:
    """The largest magnitude of a measure over the rows that have it; infinite where one is not
    finite, 0 without rows."""
    values = [row.measures[name] for row in rows if name in row.measures]
    return max((math.inf if v is None else abs(v) for v in values), default=0.0)


def total(rows: Iterable[Row], counter: str) -> int:
    """Sum of a counter over the rows."""
    return sum(row.counters.get(counter, 0) for row in rows)


def solved(claim: str, count: int, asked: int, what: str = "") -> Statement:
    """Whether all that was asked for has a record.

    what  is counted, in a word
    """
    return Statement(
        claim=claim,
        outcome=judged(count == asked),
        measured=f"{count} of {asked}{what and ' '}{what}",
        about=Row(counters={"found": count, "asked": asked}),
    )


def converged(
    rows: Sequence[Row],
    tolerance: float,
    where: str,
    *,
    claim: str = "every increment converged",
    asked: int = 0,
) -> Statement:
    """Whether every increment of all cases ended within the tolerance.

    where  in words
    asked  rows that there should be: open with fewer
    """
    worst = largest(rows, RESIDUAL)
    return Statement(
        claim=claim,
        outcome=judged(worst <= tolerance, complete=len(rows) >= asked),
        measured=f"largest residual {_study_text(worst)} {where}",
        because=f"allowed {tolerance:g}",
        about=_measures({RESIDUAL: worst}),
    )


def within(
    what: str, rows: Sequence[Row], allowed: Mapping[str, float], because: str, *, asked: int = 0
) -> Statement:
    """Whether measures are nowhere larger than allowed, by name; those that a row lacks are not
    asked of it.

    asked  rows that there should be: open with fewer
    """
    worst = {name: largest(rows, name) for name in allowed}
    limits = ", ".join(f"{name} ≤ {plain(most)}" for name, most in allowed.items())
    return Statement(
        claim=f"{what}: {limits}",
        outcome=judged(all(worst[n] <= allowed[n] for n in allowed), complete=len(rows) >= asked),
        measured=", ".join(f"{name} {_study_text(error)}" for name, error in worst.items()),
        because=because,
        about=_measures(worst),
    )


def _study_text(value: float) -> str:
    return plain(_finite(value), 2)


def _measures(values: Mapping[str, float]) -> Row:
    return Row(measures={name: _finite(value) for name, value in values.items()})


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
