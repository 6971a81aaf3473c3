"""Texts of a verification report: changes, sections on studies, Markdown summary, JUnit table.

Changes are those of the results since the recorded baseline, the accepted results of an earlier
version of the program.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from verification.exhibits.chart import plain, value_text
from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    ROUNDING,
    SYMBOLS,
    WORDS,
    CaseOutcome,
    ChangeKind,
    Origin,
    Status,
    Verdict,
    clearance_text,
    failure_line,
    judged_errors,
    moved_text,
)
from verification.problems.problem import ReferenceKind
from verification.regression.change_row import ABSENT, ChangeRow, count_row, rows_that_matter
from verification.regression.comparison import NOISE
from verification.running.provenance import age_text, is_current
from verification.running.report_record import Report
from verification.running.study import StudyRecord, measured_text, study_failure_line

# By the name of its study. A study gets its place on the page in `templates/page.html`.
TITLES = {
    "coated-tractions": "Coated contacts: the paper's figures 3 and 4",
    "work-precision": "What accuracy costs",
    "error-coverage": "Coverage of stated errors",
    "stability": "The stability map",
    "seeded-defects": "Seeded defects",
}
PROMISES = {
    "work-precision": "Know what accuracy costs",
    "stability": "Stay stable in hard cases",
    "error-coverage": "State an error for every number, and keep it",
}
FORCED = "forced_effects"  # the case that judges the plan
LEVELS = ("quick", "standard", "full")
PLACES = (Path("reports/studies"), Path("out"))  # where records are looked for


@dataclass(frozen=True)
class StudySection:
    """Section of the report page for one study.

    name     name of the study
    title    heading of the section
    record   record of the study; None if none was found
    command  command that makes the record
    """

    name: str
    title: str
    record: StudyRecord | None
    command: str


@dataclass(frozen=True)
class Feature:
    """One of the main claims about the program on the report page, with measured figures.

    promise  text of the claim
    status   outcome of the case or study that judges the claim; None if the report lacks it
    figures  measured figures in words
    address  link to the case or study
    """

    promise: str
    status: Status | None
    figures: str
    address: str


def study_section(report: Report, name: str) -> StudySection:
    """Return the section of a study for the report page; raises KeyError if the page has no such
    section.

    name  name of the study
    """
    command = f"slipstick maintain study {name} --level {report.level}"
    record = next((record for record in report.studies if record.name == name), None)
    return StudySection(name, TITLES[name], record, command)


def features(report: Report, sheets: str) -> tuple[Feature, ...]:
    """Return the main claims about the program for the report page, each with measured figures.

    sheets  address of the page with one section per case
    """
    return (
        _plan_feature(report, sheets),
        *(_study_feature(study_section(report, name), text) for name, text in PROMISES.items()),
    )


def _plan_feature(report: Report, sheets: str) -> Feature:
    promise = "Simulate only the effects that a scene calls for"
    case = next((case for case in report.cases if case.name == FORCED), None)
    if case is None:
        command = f"slipstick verify {FORCED} --level {report.level}"
        return Feature(promise, None, f"not in this report; {command} measures it", "#cases")
    runs = {run.label: run for run in case.runs}
    ratios = [
        run.convolutions / max(runs[run.planned].convolutions, 1)
        for run in case.runs
        if run.planned is not None
    ]
    told = f"{min(ratios):.2g} to {max(ratios):.2g} times the" if ratios else "as many"
    worst = max((v.error or 0.0 for v in case.verdicts if len(v.runs) > 1), default=0.0)
    figures = (
        f"with every effect forced on, {len(ratios)} scenes give the same answer within "
        f"{plain(worst, 2)} and take {told} convolutions"
    )
    return Feature(promise, case.status, figures, f"{sheets}#{FORCED}")


def _study_feature(section: StudySection, promise: str) -> Feature:
    address, record = f"#study-{section.name}", section.record
    if record is None:
        return Feature(promise, None, f"not in this report; {section.command} finds it", address)
    answer = record.conclusion.answer
    told = f"{answer} (level {record.level})" if answer else claims_line(record)
    return Feature(promise, record.status, told, address)


def claims_line(record: StudyRecord) -> str:
    """Return a text such as "5 of its 6 judged claims hold (level full)" on the claims of a
    study."""
    judged = [s.outcome for s in record.conclusion.statements if s.outcome is not None]
    good = judged.count(Status.PASS)
    return f"{good} of its {len(judged)} judged claims hold (level {record.level})"


def stored_records(
    places: Iterable[Path] = PLACES, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """Return one stored record of every study that has a section on the report page, sorted by
    name.

    Records of the current source code have priority, then the higher level, then the later date.
    Records with a number of cells that the user chose are left out.

    places    directories that are searched
    left_out  function called with a message for each record that is damaged or of another version;
              None raises ValueError instead
    """
    from verification.running.study import stored_studies

    best: dict[str, StudyRecord] = {}
    for place in places:
        for record in stored_studies(place, left_out):
            if record.own_cells or record.name not in TITLES:
                continue
            if record.name not in best or _record_preference(record) >= _record_preference(
                best[record.name]
            ):
                best[record.name] = record
    return tuple(best[name] for name in sorted(best))


def _record_preference(record: StudyRecord) -> tuple[bool, int, str]:
    level = LEVELS.index(record.level) if record.level in LEVELS else -1
    return is_current(record.provenance), level, record.provenance.date


OMISSIONS = (
    "Tilt and torsion are judged by problems of their own: torsion of balls up to sliding, with a "
    "coating and without, a punch and a ball pressed beside their axes. No case and no reference "
    "has them together with a tangential push.",
    "Tangential loads on coated bodies with friction have no closed form: they are judged by the "
    "other solvers, by an external code and by the study coated-tractions.",
    "Where both solvers are compared they take the same increments: what finite increments cost is "
    "judged apart, by refining them.",
    "The finite elements are axisymmetric: neither tilt nor a load that turns, no height map and "
    "no friction map is solved by a second solver.",
    "The paper's own numbers are known from its figures and two printed values only; figure 2 is "
    "compared with the closed form that the paper compares with.",
    "No case compares a number with a measurement.",
    "No case judges how far the scatter of input moves a result.",
    "For ν > 0 no exact solution of partial slip is known; there the closed form is a companion "
    "within a stated band.",
)


DIGITS = 9  # enough to see what changed
# in place of a quantity and its run
CASE = "case"
ALL = "all runs"
TO_ACCEPT = "accept the removal with a reason"


def change_rows(report: Report) -> list[ChangeRow]:
    """Return the changes of results since the recorded baseline that matter to a reader of the
    report.

    The changes are sorted by severity of their kind, then by size.
    """
    return rows_that_matter(_all_rows(report))


def moved_rows(report: Report) -> list[ChangeRow]:
    """Return the changes since the baseline that matter to a reader, without results that are new.

    New results have no recorded value to compare with.
    """
    return [row for row in change_rows(report) if row.kind is not ChangeKind.NEW]


def worse_rows(report: Report) -> list[ChangeRow]:
    """Return the results that are worse than in the recorded baseline, for instance in error or
    cost."""
    return [row for row in change_rows(report) if row.kind.regresses]


def _all_rows(report: Report) -> Iterator[ChangeRow]:
    """Yield all changes of a report since the recorded baseline, including new and removed cases.

    New cases are left out if no case has recorded results, because the report states that
    separately.
    """
    some = report.gone or len(without_baseline(report)) < len(report.cases)
    for case in report.cases:
        if case.baseline is None and some:
            verdicts = f"{len(case.verdicts)} verdicts"
            yield ChangeRow(case.name, CASE, ALL, ChangeKind.NEW, now=verdicts)
        yield from case_rows(case)
    for gone in report.gone:
        yield ChangeRow(
            gone.name,
            CASE,
            ALL,
            ChangeKind.GONE,
            "recorded",
            "not in the report",
            since=gone.since,
            remark=TO_ACCEPT,
        )


def case_rows(case: CaseOutcome) -> Iterator[ChangeRow]:
    """Yield the changes of the numbers and counts of one verification case since its recorded
    baseline.

    Recorded numbers that the case now lacks are included.
    """
    if case.baseline is None:
        return
    for number in case.verdicts:
        change = number.regression
        if change is not None:
            was = value_text(change.was, number.unit, DIGITS) if change.recorded else ABSENT
            yield ChangeRow(
                case.name,
                number.name,
                number.run,
                change.kind,
                was,
                value_text(number.value, number.unit, DIGITS),
                moved_text(change),
                case.baseline.name,
                change.remark,
                math.inf if change.moved is None else change.moved,
            )
    for count in case.counts:
        yield count_row(case.name, ALL, count, case.baseline.name)
    for gone in case.gone:
        yield ChangeRow(
            case.name,
            gone.name,
            gone.run,
            ChangeKind.GONE,
            ABSENT if gone.was is None else value_text(gone.was, gone.unit, DIGITS),
            since=case.baseline.name,
            remark=TO_ACCEPT,
        )


def change_counts(report: Report) -> dict[ChangeKind, int]:
    """Count the changes of a report since the recorded baseline by kind (worse, better, new, …)."""
    found = Counter(row.kind for row in _all_rows(report))
    return {kind: found[kind] for kind in ChangeKind if found[kind]}


def without_baseline(report: Report) -> list[str]:
    """Return the names of the cases of a report that have no recorded results at the level of the
    report."""
    return [case.name for case in report.cases if case.baseline is None]


def origins(report: Report) -> list[tuple[Origin, list[str]]]:
    """Return the origins (commit and date) of the recorded baselines, with the names of their
    cases.

    The origin with the most cases comes first.
    """
    found: dict[Origin, list[str]] = {}
    for case in report.cases:
        if case.baseline is not None:
            found.setdefault(case.baseline, []).append(case.name)
    return sorted(found.items(), key=lambda item: -len(item[1]))


def changes_text(report: Report) -> str:
    """Summarise the changes of a report since the recorded baseline in one line of text."""
    absent = without_baseline(report)
    parts = [", ".join(f"{number} {kind}" for kind, number in change_counts(report).items())]
    if report.cases and len(absent) == len(report.cases):
        parts.append(f"no baseline yet of level {report.level}")
    elif absent:
        parts.append(f"no baseline yet of {', '.join(absent)}")
    if report.chosen:
        parts.append("chosen cases alone, nothing is said about the others")
    return "; ".join(part for part in parts if part)


MAX_LINES = 40  # of failures, and of changes: a pull request's comment holds 65 kB
TIMES = (3.0, 10.0)  # factors of an error that a verdict should detect
OUTSIDE = {
    ReferenceKind.CLOSED_FORM,
    ReferenceKind.SEMI_CLOSED,
    ReferenceKind.THEORY,
    ReferenceKind.EXTERNAL_CODE,
}


def counts_text(report: Report) -> str:
    """Summarise a report in one line: numbers of verdicts by status, covering stated errors, and
    studies."""
    found = [verdict.covered for _, verdict in judged_errors(report.cases)]
    failed = len(report.failed_studies)
    older = sum(study.status is Status.FAIL for study in report.studies) - failed
    open_ = sum(study.status is Status.INCONCLUSIVE for study in report.studies)
    passed, inconclusive = report.counts[Status.PASS], report.counts[Status.INCONCLUSIVE]
    parts = [f"{passed} passed, {report.counts[Status.FAIL]} failed, {inconclusive} inconclusive"]
    parts += [f"{sum(map(bool, found))} of {len(found)} stated errors cover"] if found else []
    parts += [f"{failed} of the studies failed"] if failed else []
    parts += [f"{older} of the studies failed and are older than the code"] if older else []
    parts += [f"{open_} {'study' if open_ == 1 else 'studies'} inconclusive"] if open_ else []
    return "; ".join(parts)


def uncovered_errors(report: Report) -> dict[str, str]:
    """Return a text for each stated error that is smaller than the difference from the reference.

    The keys name case, quantity and run.
    """
    return {
        f"{case.name}/{verdict.name} [{verdict.run}]": f"{_off_text(verdict)} from the reference, "
        f"{value_text(verdict.stated_error, verdict.unit)} stated"
        for case, verdict in judged_errors(report.cases)
        if not verdict.covered
    }


def _off_text(verdict: Verdict) -> str:
    return value_text(abs((verdict.value or 0.0) - verdict.reference), verdict.unit)


def uncovered_lines(report: Report) -> list[str]:
    """Return one log line for each stated error that is smaller than the difference from the
    reference."""
    return [f"UNCOVERED {name}: {text}" for name, text in uncovered_errors(report).items()]


def failure_lines(report: Report) -> list[str]:
    """Return one log line for each failed verdict, for each requirement that no passing case shows,
    and for each failed study of the current source code."""
    lines = [failure_line(case.name, verdict, report.level) for case, verdict in report.failures]
    lines += [f"FAIL requirement {text}: no passing case shows it" for text in report.unmet]
    return lines + [study_failure_line(study) for study in report.failed_studies]


def power_text(report: Report) -> str:
    """Describe the sensitivity of the verdicts of a report to larger errors, in one line.

    The text states the share of verdicts that would still pass if the error were 3 or 10 times as
    large. Only passed verdicts with an independent reference and an error above round-off count.
    Without such verdicts the text is empty.
    """
    judged = [
        (verdict.error, verdict.allowed)
        for case in report.cases
        for verdict in case.verdicts
        if verdict.status is Status.PASS
        and verdict.tolerance_kind != "order"
        and verdict.reference_kind in OUTSIDE
        and verdict.error is not None
        and verdict.error > ROUNDING
    ]
    if not judged:
        return ""
    passing, hidden = (
        [sum(t * e <= u and (t - 1) * e < least for e, u in judged) / len(judged) for t in TIMES]
        for least in (float("inf"), NOISE)
    )
    return (
        f"Of {len(judged)} numbers with a reference from outside and an error above round-off, "
        f"{passing[0]:.0%} would pass with an error three times as large and {passing[1]:.0%} with "
        f"ten times; {hidden[0]:.0%} and {hidden[1]:.0%} without that the comparison with "
        "baselines tells it as worse"
    )


def render_summary(report: Report) -> str:
    """Render the Markdown summary of a report: status, failures, changes, and one table row per
    case."""
    return "\n".join(_summary_lines(report)) + "\n"


def _summary_lines(report: Report) -> Iterator[str]:
    yield f"# {_status_text(report.status)}: slipstick verify, {report.level}"
    yield ""
    yield f"{counts_text(report)}. Cases: {len(report.cases)}."
    if age := age_text(report.provenance):
        yield f"The report is {age}."
    if power := power_text(report):
        yield f"{power}."
    lines = [f"`{line}`" for line in (*failure_lines(report), *uncovered_lines(report))]
    if lines:
        yield ""
    yield from (f"- {line}" for line in lines[:MAX_LINES])
    if len(lines) > MAX_LINES:
        yield f"- and {len(lines) - MAX_LINES} more"
    yield ""
    yield from _change_lines(report)
    yield ""
    if report.studies:
        told = (
            f"{study.name} {_status_text(study.status)} ({study.level}{measured_text(study)})"
            for study in report.studies
        )
        yield f"Studies: {', '.join(told)}."
        yield ""
    yield "| case | verdict | verdicts | closest to its limit |"
    yield "| --- | --- | --- | --- |"
    for case in report.cases:
        status, worst = _status_text(case.status), nearest_to_limit(case)
        closest = "–" if worst is None else f"{worst.name} [{worst.run}]: {clearance_text(worst)}"
        yield f"| {case.name} | {status} | {len(case.verdicts)} | {closest} |"


def _status_text(status: Status) -> str:
    return f"{SYMBOLS[status]} {WORDS[status]}"


def nearest_to_limit(case: CaseOutcome) -> Verdict | None:
    """Return the verdict of a case that uses most of its tolerance.

    Failed verdicts come first, then those that pass. The largest residual and violation of a case
    count only if the case has no other verdict.
    """

    def rank(verdict: Verdict) -> tuple[bool, bool, float]:
        measured = verdict.status is Status.PASS and verdict.name not in FOUND_IN_A_RUN
        return verdict.status is Status.FAIL, measured, verdict.clearance or 0.0

    return max((v for v in case.verdicts if v.clearance is not None), key=rank, default=None)


def _change_lines(report: Report) -> Iterator[str]:
    """Yield the Markdown lines of the summary on changes of results since the recorded baseline."""
    yield f"Since the baseline: {changes_text(report)}."
    for origin, names in origins(report):
        text = f"- {len(names)} of the cases: {origin.name}, {origin.date[:10]}, {origin.reason}"
        yield f"{text}; differs here: {'; '.join(origin.differs)}" if origin.differs else text
    rows = change_rows(report)
    if not rows:
        return
    yield ""
    yield "| change | quantity | was | is | moved by | remark |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for row in rows[:MAX_LINES]:
        quantity = f"{row.case}/{row.name} [{row.run}]"
        cells = (row.kind, quantity, row.was, row.now, row.moved, row.remark)
        yield f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"
    if len(rows) > MAX_LINES:
        yield ""
        yield f"and {len(rows) - MAX_LINES} more; `slipstick maintain compare` lists them."


Made = tuple[str, Status, str, str]  # name, outcome, message, text


def render_junit(report: Report) -> str:
    """Render a verification report as JUnit XML, with one test suite per case and one suite of
    studies.

    Each verdict is a test case. Only studies of the current source code are included. The time of
    a suite is the wall time of its case. Changes since the baseline are text output of a suite and
    not failures.
    """
    root = ElementTree.Element("testsuites", name=f"slipstick verify, {report.level}")
    for case in report.cases:
        verdicts = [
            (
                f"{v.name} [{v.run}]",
                v.status,
                failure_line(case.name, v, report.level)
                if v.status is Status.FAIL
                else f"inconclusive: {v.because}",
                v.because,
            )
            for v in case.verdicts
        ]
        lines = [row.line for row in case_rows(case) if row.kind.matters]
        lines = lines if case.baseline else ["no baseline yet"]
        suite = _add_test_suite(root, case.name, verdicts, lines)
        suite.set("time", f"{report.provenance.seconds.get(case.name, 0.0):.2f}")
    own = [study for study in report.studies if is_current(study.provenance)]
    failed = [study for study in own if study.status is Status.FAIL]
    if own:
        studies = [
            (
                one.name,
                Status.FAIL if one in failed else Status.PASS,
                study_failure_line(one) if one in failed else "",
                "",
            )
            for one in own
        ]
        _add_test_suite(root, "studies", studies)
    if report.unmet:
        unmet = [(text, Status.FAIL, "no passing case shows it", "") for text in report.unmet]
        _add_test_suite(root, "requirements", unmet)
    for name in ("tests", "failures", "errors", "skipped"):
        root.set(name, str(sum(int(suite.get(name, 0)) for suite in root)))
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _add_test_suite(
    root: ElementTree.Element, name: str, made: list[Made], lines: list[str] | None = None
) -> ElementTree.Element:
    ends = [status for _, status, _, _ in made]
    suite = ElementTree.SubElement(
        root,
        "testsuite",
        name=name,
        tests=str(len(made)),
        errors="0",
        failures=str(ends.count(Status.FAIL)),
        skipped=str(ends.count(Status.INCONCLUSIVE)),
    )
    kinds = {Status.FAIL: "failure", Status.INCONCLUSIVE: "skipped"}
    for title, status, message, text in made:
        element = ElementTree.SubElement(suite, "testcase", classname=name, name=title)
        if status in kinds:
            child = ElementTree.SubElement(element, kinds[status], message=message)
            child.text = text if status is Status.FAIL else None
    if lines:
        ElementTree.SubElement(suite, "system-out").text = "\n".join(lines)
    return suite
