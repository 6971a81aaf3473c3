"""Baselines and tolerances: accepted results of the cases, and the comparison of later results.

Each case has one file of baselines, with one recording per level (quick, standard or full). A case
states a bound with its theoretical reason. Errors are usually far below the bound, so that a defect
that triples them would pass. The proposed tolerance of a number is about twice its largest error
over several BLAS kernels. It is proposed if the error is below a third of the present tolerance. A
proposal is accepted with a reason, in one file per level, and never exceeds the bound of its
case.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import Field, model_validator

from contact_results.directory.atomic_file import Refused, atomic_file
from contact_results.directory.json_record import read_record, record_text, write_record
from contact_scene.reading.description import Description
from verification.judging.case import Level
from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    Change,
    ChangeKind,
    Count,
    CounterChange,
    FindingRecord,
    Gone,
    GoneCase,
    Origin,
    Status,
    Verdict,
    commit_text,
)
from verification.problems.problem import ROUNDING

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

Key = tuple[str, ...]


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


class RecordedFinding(Description):
    """Recorded value of a number that a verification case reports without a verdict, in a
    baseline."""

    name: str
    run: str
    unit: str
    value: float | None

    @property
    def key(self) -> Key:
        """Key of the number in its verification case: name and run."""
        return key_of(self)


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
    findings: tuple[RecordedFinding, ...]
    runs: tuple[RecordedRun, ...]


class Baseline(Description):
    """Accepted results of one verification case at all levels at which they were recorded.

    Each case has one file with this content.
    """

    schema_version: int = BASELINE_VERSION
    case: str
    levels: dict[str, Recording]


def key_of(number: Verdict | FindingRecord | RecordedQuantity | RecordedFinding) -> Key:
    """Return the key that identifies a number in its case: kind, name, run and kind of tolerance.

    Results are compared with the recorded number of the same key. The run is omitted for residuals
    and similar numbers, which may come from any run.
    """
    run = "" if number.name in FOUND_IN_A_RUN else number.run
    if isinstance(number, Verdict | RecordedQuantity):
        return ("quantity", number.name, run, number.tolerance_kind)
    return ("finding", number.name, run)


def keys_of(recorded: Recording | None) -> set[str]:
    """Return the names of all numbers in a recording of a case, as "name [run]".

    The result is empty without a recording.
    """
    if recorded is None:
        return set()
    keys = (*(one.key for one in recorded.quantities), *(one.key for one in recorded.findings))
    return {f"{name} [{run}]" for _, name, run, *_ in keys}


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
        findings=tuple(
            RecordedFinding(**_fields(RecordedFinding, finding)) for finding in case.findings
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


SAME_DIGITS = 1e-8  # relative difference of equal references
# Processors and versions end solves at other iterates within their tolerance (1e-8), and what is
# measured on them may differ by somewhat more. Less than that is no change on any machine.
NOISE = 1e-6  # relative to the error scale, or to the value of a finding
NOISE_OF_TOLERANCE = 0.01
SAME_COUNT = 0.05  # relative; solves may end an iteration earlier or later
TOLERANCE_KEPT = 0.01  # relative; derived tolerances follow the last digits of small differences

# Worse: an error that has become this many times larger, by more than the noise of machines: what
# is far inside a wide tolerance has no other guard.
WORSE_BY = 1.5
# The residual below the tolerance does not measure the accuracy of a result.
ENDS_OF_SOLVES = FOUND_IN_A_RUN

# Suspiciously better: an error that has become this many times smaller, by at least that part of
# the tolerance.
BETTER_BY = 2.0
BETTER_BY_PART = 0.05


def quantity_change(verdict: Judged, was: RecordedQuantity | None, origin: Origin) -> Change:
    """Classify the change of a judged quantity since its recorded value as worse, better, new or
    other.

    verdict  present value, reference and tolerance
    was      recorded quantity; None if none is recorded
    origin   commit and date of the recording
    """
    if was is None:
        failed = verdict.status is Status.FAIL
        kind = ChangeKind.OUTSIDE if failed else ChangeKind.NEW
        return Change(kind=kind, recorded=False, since=origin.name)
    allowed = min(verdict.most_allowed, was.allowed)
    difference = _difference(verdict.value, was.value)
    moved = difference / allowed if allowed > 0 else math.inf
    return Change(
        kind=_kind(verdict, was, difference, allowed),
        was=was.value,
        moved=moved if math.isfinite(moved) else None,
        since=origin.name,
        remark="; ".join(_remarks(verdict, was)),
    )


def finding_change(finding: FindingRecord, was: RecordedFinding | None, origin: Origin) -> Change:
    """Classify the change of a number without a verdict since its recorded value.

    Integers are treated as counts and may change by 5 %.

    finding  present value
    was      recorded number; None if none is recorded
    origin   commit and date of the recording
    """
    if was is None:
        return Change(kind=ChangeKind.NEW, recorded=False, since=origin.name)
    values = [value or 0.0 for value in (finding.value, was.value)]
    counts = all(value.is_integer() for value in values)
    noise = (SAME_COUNT if counts else NOISE) * max(map(abs, values))
    same = _difference(finding.value, was.value) <= noise
    kind = ChangeKind.UNCHANGED if same else ChangeKind.DRIFT
    return Change(kind=kind, was=was.value, since=origin.name)


def _kind(verdict: Judged, was: RecordedQuantity, difference: float, allowed: float) -> ChangeKind:
    if verdict.status is Status.FAIL and was.status is not Status.FAIL:
        return ChangeKind.OUTSIDE
    if was.status is Status.FAIL and verdict.status is not Status.FAIL:
        return ChangeKind.BETTER
    if difference > allowed and _is_farther(verdict, was):
        return ChangeKind.OUTSIDE
    # This test comes before those of tolerances, because derived tolerances grow with the error.
    ends = verdict.name in ENDS_OF_SOLVES
    now = verdict.model_copy(update={"reference": was.reference})
    if (was.covered and not verdict.covered) or _is_judged_less(verdict, was):
        return ChangeKind.WORSE
    if not ends and grows(was, now, WORSE_BY, NOISE * verdict.scale):
        return ChangeKind.WORSE
    if any(_remarks(verdict, was)):
        return ChangeKind.DRIFT
    if ends:
        return ChangeKind.UNCHANGED
    if difference <= max(NOISE * verdict.scale, NOISE_OF_TOLERANCE * allowed):
        return ChangeKind.UNCHANGED
    better = grows(verdict, was, BETTER_BY, BETTER_BY_PART * allowed)
    return ChangeKind.BETTER if better else ChangeKind.DRIFT


def _is_judged_less(verdict: Judged, was: RecordedQuantity) -> bool:
    """Return True if a recorded number is no longer judged, or with a tolerance wider by half.

    Tolerances of orders and of the worst run depend on results. Derived ones follow the noise.
    """
    lost = was.status is Status.PASS and verdict.status is Status.INCONCLUSIVE
    fixed = verdict.tolerance_kind != "order" and verdict.name not in ENDS_OF_SOLVES
    noise = NOISE * verdict.scale if verdict.tolerance_kind == "derived" else 0.0
    return lost or (fixed and verdict.most_allowed > WORSE_BY * was.allowed + noise)


def _is_farther(verdict: Judged, was: RecordedQuantity) -> bool:
    """Return True if the present value is farther from its reference than the recorded value.

    A convergence order that was recorded as inconclusive, because its interval is too wide, is not
    compared. A present order with too wide an interval is compared with the recorded tolerance.

    verdict  present value with its reference
    was      recorded quantity
    """
    if was.status is Status.INCONCLUSIVE:
        return False
    if verdict.status is Status.INCONCLUSIVE and verdict.value is not None:
        return abs(verdict.value - verdict.reference) > was.allowed
    if verdict.value is None or was.value is None:
        return was.value is not None
    return abs(verdict.value - verdict.reference) > abs(was.value - was.reference)


def grows(
    small: Judged | RecordedQuantity, large: Judged | RecordedQuantity, by: float, least: float
) -> bool:
    """Return True if the error of one quantity is much smaller than that of another one.

    Used in both directions, to detect results that became worse or better. Convergence orders are
    not compared here, because they are judged by their intervals.

    small  quantity with the smaller error
    large  quantity with the larger error
    by     smallest ratio of the errors
    least  smallest difference of the errors, in the unit of the value
    """
    if small.tolerance_kind == "order" or small.value is None or large.value is None:
        return False
    error, larger = (
        abs(one.value - one.reference) for one in (small, large) if one.value is not None
    )
    return has_grown(error, larger, by, least)


def has_grown(error: float, larger: float, by: float, least: float) -> bool:
    """Return True if an error has become `by` times as large, and larger by at least `least`.

    This is the rule for all accuracy regressions: of verdicts and of stated errors.
    """
    return larger > error and larger >= by * error and larger - error >= least


def _remarks(verdict: Judged, was: RecordedQuantity) -> Iterator[str]:
    """Yield the differences between a verdict and its recorded quantity other than the value, as
    texts.

    These are a larger or missing stated error, status, tolerance, reference and unit.
    """
    stated, recorded = verdict.stated_error, was.stated_error
    if was.covered and not verdict.covered:
        yield f"stated error {'not converged' if stated is None else f'{stated:.2e}'}: not covered"
    if (
        stated is not None
        and recorded is not None
        and has_grown(recorded, stated, WORSE_BY, NOISE * verdict.scale)
    ):
        yield f"stated error {stated:.2e}, was {recorded:.2e}"
    if verdict.status is not was.status:
        lost = was.status is Status.PASS and verdict.status is Status.INCONCLUSIVE
        held = ", held to the recorded tolerance" if lost else ""
        yield f"{was.status} -> {verdict.status}{held}"
    allowed = verdict.most_allowed
    if not math.isclose(allowed, was.allowed, rel_tol=TOLERANCE_KEPT):
        yield f"tolerance {allowed:.2e}, was {was.allowed:.2e}"
    floor = ROUNDING * verdict.scale
    if not math.isclose(verdict.reference, was.reference, rel_tol=SAME_DIGITS, abs_tol=floor):
        yield f"reference was {was.reference:.9g}"
    if verdict.unit != was.unit:
        yield f"unit was {was.unit or 'none'}"


def _difference(value: float | None, was: float | None) -> float:
    """Return the absolute difference of a present and a recorded value.

    None represents a value that is not finite: two such values do not differ, one differs
    infinitely.
    """
    if value is None or was is None:
        return 0.0 if value is was else math.inf
    return abs(value - was)


def counter_changes(case: CaseOutcome | Recording, recorded: Recording) -> Iterator[CounterChange]:
    """Yield the total work counts of a case that changed by more than 5 % since the recording.

    The counts are increments, iterations, convolutions and factorizations. Only solves that exist
    in both are counted; new and removed solves are reported separately.

    case      present outcome of the case
    recorded  accepted results of the case
    """
    then = {run.label: run for run in recorded.runs}
    both = [(run, then[run.label]) for run in case.runs if run.label in then]
    for name in COUNTERS:
        now, was = (sum(getattr(pair[i], name) for pair in both) for i in (0, 1))
        yield from count_change(name, now, was)


def count_change(name: str, now: int, was: int) -> Iterator[CounterChange]:
    """Yield the change of a count of work, such as "iterations", if it changed by more than 5 %."""
    if abs(now - was) > SAME_COUNT * was:
        kind = ChangeKind.DEARER if now > was else ChangeKind.DRIFT
        remark = f"{now / was:.3g} times" if was else ""
        yield CounterChange(name=name, kind=kind, was=was, now=now, remark=remark)


def compared(report: Report, baselines: Mapping[str, Baseline]) -> Report:
    """Compare a report with baselines, and return the report with the change of every number.

    An earlier comparison in the report is replaced. A case without a baseline at the level of the
    report has `CaseOutcome.baseline` None. Recorded cases that the report lacks are listed as gone,
    unless the report is of chosen cases.

    baselines  accepted results by name of the case
    """
    made_by = recorded_by(report.provenance, reason="")
    cases = tuple(
        _compared(case, _recording(baselines.get(case.name), report.level), made_by)
        for case in report.cases
    )
    return report.model_copy(
        update={
            "cases": cases,
            "gone": tuple(_gone_cases(report, baselines)),
        }
    )


def refuse_if_not_whole(report: Report, baselines: Mapping[str, Baseline]) -> None:
    """Raise BaselineRefused if a report of chosen cases lacks a case with recorded results.

    Called where a comparison must include all recorded cases.
    """
    missing = [name for name, _ in _missing(report, baselines)] if report.chosen else []
    if missing:
        raise BaselineRefused(
            f"the report is of chosen cases; {len(missing)} that are recorded at level "
            f"{report.level} were not run: {', '.join(missing)}; --chosen compares those that were"
        )


def _gone_cases(report: Report, baselines: Mapping[str, Baseline]) -> Iterator[GoneCase]:
    for name, recorded in () if report.chosen else _missing(report, baselines):
        since = commit_text(recorded.by.commit, changed=recorded.by.changed)
        yield GoneCase(name=name, since=since)


def _missing(report: Report, baselines: Mapping[str, Baseline]) -> Iterator[tuple[str, Recording]]:
    """Yield the cases that are recorded at the level of a report but absent from the report.

    Each item has the name of the case and its recorded results.
    """
    present = {case.name for case in report.cases}
    for name, baseline in sorted(baselines.items()):
        recorded = _recording(baseline, report.level)
        if recorded is not None and name not in present:
            yield name, recorded


def _recording(baseline: Baseline | None, level: str) -> Recording | None:
    return None if baseline is None else baseline.levels.get(level)


def _compared(case: CaseOutcome, recorded: Recording | None, made_by: RecordedBy) -> CaseOutcome:
    """Compare a case with its recording, or remove an earlier comparison if there is none."""
    origin = None
    if recorded is not None:
        origin = Origin(
            commit=recorded.by.commit,
            changed=recorded.by.changed,
            date=recorded.by.date,
            reason=recorded.by.reason,
            differs=tuple(_differences(recorded.by, made_by)),
        )
    quantities = {one.key: one for one in recorded.quantities} if recorded else {}
    findings = {one.key: one for one in recorded.findings} if recorded else {}

    def change_of(number: Verdict | FindingRecord) -> Change | None:
        key = key_of(number)
        if origin is None:
            return None
        if isinstance(number, Verdict):
            return quantity_change(number, quantities.get(key), origin)
        return finding_change(number, findings.get(key), origin)

    return case.model_copy(
        update={
            "baseline": origin,
            **{
                name: tuple(
                    number.model_copy(update={"regression": change_of(number)})
                    for number in getattr(case, name)
                )
                for name in ("verdicts", "findings")
            },
            "counts": tuple(counter_changes(case, recorded)) if recorded else (),
            "gone": tuple(_gone(case, recorded)) if recorded else (),
        }
    )


def _gone(case: CaseOutcome, recorded: Recording) -> Iterator[Gone]:
    present: set[Key] = {key_of(verdict) for verdict in case.verdicts}
    present |= {key_of(finding) for finding in case.findings}
    numbers: tuple[RecordedQuantity | RecordedFinding, ...] = (
        *recorded.quantities,
        *recorded.findings,
    )
    for number in numbers:
        if number.key not in present:
            yield Gone(name=number.name, run=number.run, unit=number.unit, was=number.value)
    labels = {run.label for run in case.runs}
    for run in recorded.runs:
        if run.label not in labels:
            yield Gone(name="run", run=run.label, unit="", was=None)


def _differences(then: RecordedBy, now: RecordedBy) -> Iterator[str]:
    """Yield texts on differences of processor, Python and libraries between a recording and a
    report.

    These differences may explain changes of the last digits.

    then  origin of the recorded results
    now   origin of the report
    """
    facts = [("processor", then.processor, now.processor), ("Python", then.python, now.python)]
    for name in sorted(then.libraries.keys() | now.libraries.keys()):
        facts.append((name, then.libraries.get(name), now.libraries.get(name)))
    for name, was, here in facts:
        if was != here:
            yield f"{name}: {here or 'none'}, was {was or 'none'}"


TOLERANCES = Path(__file__).resolve().parents[1] / "tolerances"
SLACK = 3.0
TIMES = 2.0
# Over the scale of errors and the tolerance of a solve: by less an error depends on the iterate at
# which the solve ends, and with it on the processor. Numbers without a run are held to the
# tolerance of the radial solver.
LEAST = 10.0
WITHOUT_RUN = 1e-10
# Part of the last change Σ|Δp|/Σp of an edge correction that a number may move by, in addition to
# its error, which is 0.2 % to 2 % of this change. On 41 numbers of five cases the kernels Haswell
# and Katmai differ by at most 3e-6 of it.
MOVED = 0.01


class Tolerance(Description):
    """Accepted tolerance of one verification result, and its largest error at the time of
    acceptance.

    Both are relative to the error scale of the result.
    """

    allowed: float
    error: float


class Acceptance(Description):
    """Tolerances of verification results that were accepted together, with the reason.

    because     reason for the acceptance
    commit      commit of the source that computed the errors
    kernels     processors or BLAS kernels on which the errors were measured
    tolerances  accepted tolerances by case and key of the number
    """

    because: str
    commit: str | None
    kernels: tuple[str, ...]
    tolerances: dict[str, dict[str, Tolerance]]


class Tolerances(Description):
    """Accepted tolerances of all cases at one level (quick, standard or full): content of one
    file."""

    level: str
    accepted: tuple[Acceptance, ...] = ()

    def of(self, case: str) -> dict[str, tuple[Tolerance, Acceptance]]:
        """Return the accepted tolerances of a case, each with its acceptance, by key of the number.

        case  name of the verification case
        """
        return {
            key: (tolerance, acceptance)
            for acceptance in self.accepted
            for key, tolerance in acceptance.tolerances.get(case, {}).items()
        }


def read_tolerances(level: str, directory: Path = TOLERANCES) -> Tolerances:
    """Read the accepted tolerances of a level (quick, standard or full) from their file.

    The result has no tolerances if there is no file. Raises BaselineRefused for a damaged file.
    """
    path = directory / f"{level}.json"
    if not path.exists():
        return Tolerances(level=level)
    return read_record(path, Tolerances, "file of tolerances", RESTORE, BaselineRefused)


def held_to(cases: Sequence[CaseOutcome], tolerances: Tolerances) -> tuple[CaseOutcome, ...]:
    """Judge the results of verification cases again by the accepted tolerances.

    An accepted tolerance applies if it is smaller than the present tolerance of the verdict. It is
    at least the uncertainty of the reference: smaller errors cannot be distinguished from it.
    """
    return tuple(
        case.model_copy(
            update={
                "verdicts": tuple(
                    _judge_by_tolerance(v, known.get(text_of(v))) for v in case.verdicts
                )
            }
        )
        for case in cases
        for known in (tolerances.of(case.name),)
    )


def _judge_by_tolerance(verdict: Verdict, known: tuple[Tolerance, Acceptance] | None) -> Verdict:
    if known is None:
        return verdict
    tolerance, acceptance = known
    allowed = max(tolerance.allowed, verdict.least)
    if allowed >= verdict.allowed:
        return verdict
    passes = verdict.error is not None and verdict.error <= allowed
    return verdict.model_copy(
        update={
            "allowed": allowed,
            "bound": verdict.allowed,
            "status": Status.PASS if passes else Status.FAIL,
            "because": f"{verdict.because}; of the bound {verdict.allowed:.2g} so much is allowed: "
            + (
                f"{TIMES:g} times the error {tolerance.error:.2g} ({acceptance.because})"
                if allowed == tolerance.allowed
                else "the uncertainty of the reference"
            ),
        }
    )


def proposed(
    reports: Sequence[Report], known: Tolerances | None = None
) -> dict[str, dict[str, Tolerance]]:
    """Propose tolerances of verification results from reports of one level on several BLAS kernels.

    A number gets a proposal if its tolerance exceeds three times the largest error, or if the error
    exceeds its tolerance, and the proposal is below the bound of its case. Returns the tolerances
    by case and key of the number.

    known  accepted tolerances, by which the reports are judged first
    """
    found: dict[str, dict[str, Tolerance]] = {}
    if known is not None:
        reports = [
            report.model_copy(update={"cases": held_to(report.cases, known)}) for report in reports
        ]
    for case, key, verdicts, floor in _common_numbers(reports):
        bound, held = (verdicts[0].bound or verdicts[0].allowed), verdicts[0].allowed
        error = max(verdict.error or 0.0 for verdict in verdicts)
        floor = max(floor, *(verdict.least for verdict in verdicts))
        allowed = float(f"{TIMES * error + floor:.2g}")
        slack = held > SLACK * max(error, floor) or error > held
        if slack and allowed < bound:
            found.setdefault(case, {})[key] = Tolerance(allowed=allowed, error=error)
    return found


def _common_numbers(reports: Sequence[Report]) -> Iterator[tuple[str, str, list[Verdict], float]]:
    """Yield each finite number that all reports have: case, key, its verdicts, and an allowance.

    The allowance is added to proposed tolerances, because an error depends on the iterate at which
    a solve ends. It is ten times the tolerance of the solve, plus 1 % of the last change of an edge
    correction. Convergence orders are left out.
    """
    levels = sorted({report.level for report in reports})
    if len(levels) != 1:
        raise BaselineRefused(f"the reports are of the levels {', '.join(levels)}; name one level")
    maps = [
        {(case.name, text_of(v)): v for case in report.cases for v in case.verdicts}
        for report in reports
    ]
    solved = {
        (case.name, run.label): LEAST * run.tolerance + MOVED * run.edge_change
        for case in reports[0].cases
        for run in case.runs
    }
    for key, verdict in maps[0].items():
        verdicts = [found[key] for found in maps if key in found]
        finite = all(v.error is not None for v in verdicts) and len(verdicts) == len(maps)
        if finite and verdict.tolerance_kind != "order":
            labels = verdict.runs or (verdict.run,)
            least = max(solved.get((key[0], label), LEAST * WITHOUT_RUN) for label in labels)
            yield *key, verdicts, least


def accept_tolerances(reports: Sequence[Report], because: str, directory: Path = TOLERANCES) -> int:
    """Store the tolerances proposed from reports in the file of their level; return their number.

    Raises BaselineRefused without a reason.

    because    reason for which the errors are correct
    directory  folder of the files of tolerances
    """
    because = " ".join(because.split())
    if not because:
        raise BaselineRefused("tolerances need a reason: --because 'why these errors are right'")
    level = reports[0].level
    earlier = read_tolerances(level, directory)
    new = proposed(reports, earlier)
    kept = tuple(
        acceptance.model_copy(update={"tolerances": rest})
        for acceptance in earlier.accepted
        if (rest := _remove_tolerances(acceptance.tolerances, new))
    )
    made = [report.provenance for report in reports]
    kernels = dict.fromkeys(str(one.machine.get("arithmetic", "unknown")) for one in made)
    accepted = Acceptance(
        because=because, commit=made[0].commit, kernels=tuple(kernels), tolerances=new
    )
    content = Tolerances(level=level, accepted=(*kept, *((accepted,) if new else ())))
    write_record(directory / f"{level}.json", content)
    return sum(map(len, new.values()))


def _remove_tolerances(
    tolerances: Mapping[str, Mapping[str, Tolerance]], new: Mapping[str, Mapping[str, Tolerance]]
) -> dict[str, dict[str, Tolerance]]:
    rest = {
        case: {key: one for key, one in keys.items() if key not in new.get(case, {})}
        for case, keys in tolerances.items()
    }
    return {case: keys for case, keys in rest.items() if keys}


def text_of(verdict: Verdict) -> str:
    """Return the key of a judged quantity in its case as text: name, run and kind of tolerance.

    Accepted tolerances are stored by this key.
    """
    _, name, run, kind = key_of(verdict)
    return f"{name} [{run}] {kind}"
