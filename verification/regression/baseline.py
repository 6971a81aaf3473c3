"""Baselines: the accepted results of the cases, to which later results are compared.

Each case has one file of baselines, with one recording per level (quick, standard or full).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import Field, model_validator

from contact_results.directory.atomic_file import Refused, atomic_file
from contact_results.directory.json_record import read_record, record_text
from contact_scene.reading.description import Description
from verification.judging.case import Level
from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    Count,
    Status,
    Verdict,
)

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.running.provenance import Provenance
    from verification.running.report_record import Report


class BaselineRefused(Refused):
    """Exception for a baseline file that cannot be read, and for a report that must not be
    accepted.

    A baseline contains accepted results of a verification case, with which later results are
    compared.
    """


BASELINE_VERSION = 1
COUNTERS = ("increments", "iterations", "convolutions", "factorizations")

Key = tuple[str, str, str]


class RecordedQuantity(Description):
    """Recorded value of a quantity with a verdict, its reference and its tolerance, in a baseline.

    `allowed` (the tolerance) and `reference` have the unit of the value.
    """

    name: str
    run: str
    tolerance_kind: str
    unit: str
    value: float | None
    reference: float
    allowed: Annotated[float, Field(ge=0)]
    status: Status
    covered: bool | None = None
    """True if the stated error covered the difference from the reference; None if
    none was stated."""
    stated_error: float | None = None
    """Stated error in the unit of the value; None if none was stated or recorded."""

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
        """Absolute difference of the recorded value and its reference, in their unit.

        The result is None if the value is not finite.
        """
        return None if self.value is None else abs(self.value - self.reference)

    @property
    def key(self) -> Key:
        """Key of the quantity in its verification case: name, run and kind of tolerance."""
        return key_of(self)


class JudgedQuantity(RecordedQuantity):
    """Judged answer of a solver outside this program: `value` is its error relative to its scale.

    The reference is 0. The value is None if the answer has no finite error, or is judged otherwise.
    """

    answer: float | None = None
    """Answered number, in the unit that the challenge requires; null for fields and points."""

    order: tuple[float, float] | None = None
    """Observed order of convergence and half-width of its 95 % interval; null if unknown."""

    @property
    def scale(self) -> float:
        """Scale of the value, which is 1, because errors are relative."""
        return 1.0

    @property
    def most_allowed(self) -> float:
        """Largest accepted error, relative to its scale."""
        return self.allowed


Judged: TypeAlias = Verdict | JudgedQuantity


class RecordedRun(Description):
    """Recorded work of one solve of a verification case, in a baseline.

    The work consists of the numbers of increments, iterations, convolutions and factorizations.
    """

    label: str
    increments: Count
    iterations: Count
    convolutions: Count
    factorizations: Count


class RecordedBy(Description):
    """Origin of the results in a baseline (commit, machine, libraries), and the reason of
    acceptance."""

    reason: str
    command: str
    date: str
    commit: str | None
    changed: bool
    program_version: str
    processor: str | None
    """Processor type that the arithmetic used; see `machine.arithmetic`."""

    python: str | None
    libraries: dict[str, str | None]


class Recording(Description):
    """Accepted results of one verification case at one level (quick, standard or full), with their
    origin."""

    by: RecordedBy
    status: Status
    quantities: tuple[RecordedQuantity, ...]
    runs: tuple[RecordedRun, ...]


class Baseline(Description):
    """Accepted results of one verification case at all levels at which they were recorded.

    Each case has one file with this content.
    """

    schema_version: int = BASELINE_VERSION
    case: str
    levels: dict[str, Recording]


def key_of(number: Verdict | RecordedQuantity) -> Key:
    """Return the key that identifies a number in its case: name, run and kind of tolerance.

    Results are compared with the recorded number of the same key. The run is omitted for residuals
    and similar numbers, which may come from any run.
    """
    run = "" if number.name in FOUND_IN_A_RUN else number.run
    return number.name, run, number.tolerance_kind


def keys_of(recorded: Recording | None) -> set[str]:
    """Return the names of all numbers in a recording of a case, as "name [run]".

    The result is empty without a recording.
    """
    quantities = () if recorded is None else recorded.quantities
    return {f"{name} [{run}]" for name, run, _ in (one.key for one in quantities)}


def recording(case: CaseOutcome, provenance: Provenance, reason: str) -> Recording:
    """Convert the outcome of a verification case to the form in which accepted results are stored.

    provenance  versions, machine and commit of the report
    reason      reason for which the results are accepted
    """
    return Recording(
        by=recorded_by(provenance, reason),
        status=case.status,
        quantities=tuple(
            RecordedQuantity(**_fields(RecordedQuantity, v) | {"allowed": v.most_allowed})
            for v in case.verdicts
        ),
        runs=tuple(RecordedRun(**_fields(RecordedRun, run)) for run in case.runs),
    )


def _fields(record: type[Description], source: Description) -> dict[str, Any]:
    return {name: getattr(source, name) for name in record.model_fields}


def recorded_by(provenance: Provenance, reason: str) -> RecordedBy:
    """Select the part of the provenance of a report that is stored with accepted results.

    reason  reason for which the results are accepted
    """
    machine = provenance.machine
    processor, python = machine.get("arithmetic", machine.get("processor")), machine.get("python")
    return RecordedBy(
        reason=reason,
        processor=None if processor is None else str(processor),
        python=None if python is None else str(python),
        **provenance.model_dump(
            include={"command", "date", "commit", "changed", "program_version", "libraries"}
        ),
    )


BASELINES = Path(__file__).resolve().parents[1] / "baselines"
ENDING = ".json"
REMOVED = "REMOVED.md"
REMOVED_HEAD = """# Removed baseline keys

Each removed key of an accepted baseline, with its successor or the reason for its removal.

| case | quantity [run] | successor, or reason |
| --- | --- | --- |
"""
RESTORE = "restore it from the repository"
REMEDY = f"{RESTORE}, or delete it and accept it anew"


def read_baselines(directory: Path | None = None) -> dict[str, Baseline]:
    """Read the baselines (accepted results) of all cases in a folder, by name of the case.

    The result is empty if the folder has none.

    directory  folder; None for that of the package

    Raises BaselineRefused for the first file that is damaged or not a baseline of the case in its
    name.
    """
    folder = BASELINES if directory is None else directory
    files = sorted(folder.glob(f"*{ENDING}")) if folder.is_dir() else []
    return {path.stem: _read_baseline(path) for path in files}


def write_baselines(
    recordings: Mapping[str, Recording | None],
    level: str,
    directory: Path,
    removed: Mapping[str, Sequence[str]] = MappingProxyType({}),
    reason: str = "",
) -> tuple[Path, ...]:
    """Store accepted results of cases at one level in their baseline files; return the files
    written.

    Results at other levels are kept. All files are read before any is written. Raises
    BaselineRefused for an existing file that is not a valid baseline.

    recordings  accepted results by case; None deletes those of this level
    level       quick, standard or full
    removed     keys of numbers that are no longer recorded, by case, to be listed in `REMOVED.md`
    reason      reason for the removals
    """
    texts: dict[Path, str] = {}
    for case, recorded in recordings.items():
        path = directory / f"{case}{ENDING}"
        levels = _read_baseline(path).levels if path.exists() else {}
        levels = {name: one for name, one in levels.items() if name != level}
        if recorded is not None:
            levels[level] = recorded
        ordered = {
            name: levels[name] for name in sorted(levels, key=lambda name: Level[name.upper()])
        }
        texts[path] = record_text(Baseline(case=case, levels=ordered)) if ordered else ""
    if removed:
        path = directory / REMOVED
        head = path.read_text(encoding="utf-8") if path.exists() else REMOVED_HEAD
        because = reason.replace("|", "/")
        rows = (
            f"| {case} | {', '.join(keys).replace('|', '/')} | {level}: {because} |\n"
            for case, keys in removed.items()
        )
        texts[path] = head + "".join(rows)
    for path, text in texts.items():
        if not text:
            path.unlink()
            continue
        with atomic_file(path) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
    return tuple(path for path in texts if path.suffix == ENDING)


def _read_baseline(path: Path) -> Baseline:
    baseline = read_record(path, Baseline, "baseline", REMEDY, BaselineRefused)
    unknown = sorted(baseline.levels.keys() - {level.name.lower() for level in Level})
    for wrong, text in (
        (baseline.schema_version != BASELINE_VERSION, f"is of version {baseline.schema_version}"),
        (baseline.case != path.stem, f"is of case {baseline.case!r}"),
        (bool(unknown), f"has a level {', '.join(unknown)}"),
    ):
        if wrong:
            raise BaselineRefused(f"baseline {path} {text}; {REMEDY}")
    return baseline


def accept(
    report: Report,
    reason: str,
    directory: Path,
    names: Collection[str] = (),
    *,
    with_failures: bool = False,
    with_changes: bool = False,
) -> tuple[Path, ...]:
    """Store the results of a report as baselines for later comparisons; return the files written.

    Recorded numbers that the report lacks are listed in `REMOVED.md` with the reason. The recording
    of a case that a complete report lacks is deleted. Raises BaselineRefused, before anything is
    written, for a report that must not be accepted.

    reason         reason for which the results are correct
    directory      folder of the baselines
    names          cases to accept; empty for all of the report
    with_failures  if True, accept failed verdicts as well
    with_changes   if True, accept a report whose source differed from its commit or had none; its
                   results cannot be reproduced from the commit
    """
    reason, made = " ".join(reason.split()), report.provenance
    earlier = {
        case: baseline.levels[report.level]
        for case, baseline in read_baselines(directory).items()
        if report.level in baseline.levels and (not names or case in names)
    }
    cases = _chosen_cases(report, () if report.chosen else earlier, names)
    failed = [f"{c.name}/{v.name}" for c in cases for v in c.verdicts if v.status is Status.FAIL]
    for refused, text in (
        (not reason, "a baseline needs a reason: --because 'why these numbers are right'"),
        (
            bool(failed) and not with_failures,
            f"{len(failed)} failed, the first is {', '.join(failed[:1])}; correct it, or accept "
            "it --with-failures",
        ),
        (
            (made.commit is None or made.changed) and not with_changes,
            "the report was made from a source that no commit holds, so nobody could make its "
            "numbers again; commit, verify, then accept, or accept it --with-changes",
        ),
    ):
        if refused:
            raise BaselineRefused(text)
    recordings = {case.name: recording(case, report.provenance, reason) for case in cases}
    lost = {} if report.chosen else dict.fromkeys(earlier.keys() - recordings.keys())
    changes: dict[str, Recording | None] = recordings | lost
    gone = {
        case: keys_of(earlier[case]) - keys_of(changes[case]) for case in earlier.keys() & changes
    }
    removed = {case: sorted(keys) for case, keys in sorted(gone.items()) if keys}
    return write_baselines(changes, report.level, directory, removed, reason)


def baselines_of(report: Report, reason: str) -> dict[str, Baseline]:
    """Convert the results of a report to baselines, so that another report can be compared with
    them.

    reason  reason that is stored with the results
    """
    return {
        case.name: Baseline(
            case=case.name, levels={report.level: recording(case, report.provenance, reason)}
        )
        for case in report.cases
    }


def _chosen_cases(
    report: Report, removable: Collection[str], names: Collection[str]
) -> list[CaseOutcome]:
    missing = sorted(set(names) - {case.name for case in report.cases} - set(removable))
    if missing:
        raise BaselineRefused(
            f"the report has no case {', '.join(missing)}; --from names the report"
        )
    return [case for case in report.cases if not names or case.name in names]
