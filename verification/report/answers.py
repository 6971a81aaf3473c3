"""Three questions that a reader comes with, answered from the records of this report."""

from __future__ import annotations

from dataclasses import dataclass, replace

from verification.exhibits.chart import Chart
from verification.exhibits.numbers import percent, plain
from verification.exhibits.table import APART_EVERYWHERE, Table
from verification.judging.outcome import CaseOutcome, Verdict
from verification.judging.verdict_text import clearance_text
from verification.problems.reference import ReferenceKind
from verification.report.both_solvers import WORDS, SharedReference, shared_references
from verification.report.prices import cost_sentence, price_table, telling_chart
from verification.report.sections import StudySection, study_of, study_section
from verification.running.record import StudyRecord
from verification.running.report_record import Report
from verification.solver import Solver

CLAIMS = 2  # of a study without an answer
Direct = tuple[CaseOutcome, Verdict]


@dataclass(frozen=True)
class Answer:
    """A question, what the records say, and where more of it stands.

    sentences  made from the records; empty without an answer
    table      numbers to it
    links      anchor and text
    missing    the study that would answer it, or answer it better, with its command
    """

    question: str
    sentences: tuple[str, ...]
    chart: Chart | None
    links: tuple[tuple[str, str], ...]
    missing: StudySection | None = None
    table: Table | None = None


def answers(report: Report) -> tuple[Answer, ...]:
    """Gross sliding, cost, and both solvers, in this order."""
    return _gross_sliding(report), _cost(report), _disagreement(report)


def _gross_sliding(report: Report) -> Answer:
    return _from_study(report, "Is 0.76 µW gross sliding?", "coated-tractions", ("figure_4_shear",))


def _cost(report: Report) -> Answer:
    """By counted work, which is the same everywhere, and by the clock if it was looked at."""
    name = "work-precision"
    answer = _from_study(report, "What does an error of 0.1 % cost with each method?", name, ())
    record = study_of(report, name)
    if record is None:
        return answer
    timed = record.provenance.timed
    if timed is None:
        shown, unit, said = record.conclusion, "", answer.sentences
    else:
        by_clock = f"By the clock, on the machine that its provenance names: {timed.answer}"
        shown, unit, said = timed, ", in CPU seconds", (*answer.sentences, by_clock)
    if short := cost_sentence(record):
        said = (f"{short[0].upper()}{short[1:]}.", *said)
    return replace(
        answer, sentences=said, chart=telling_chart(shown) or answer.chart,
        table=price_table(shown, unit),
    )  # fmt: skip


def _disagreement(report: Report) -> Answer:
    """From the references that both solvers were judged by, and from their comparisons."""
    shared = shared_references(report)
    return Answer(
        "Where do finite elements and the semi-analytical method disagree?",
        (*_furthest(shared), *_direct(report)),
        None,
        (("solvers", "all of them"),) if shared else (),
    )


def _from_study(report: Report, question: str, name: str, charts: tuple[str, ...]) -> Answer:
    section = study_section(report, name)
    if section.record is None:
        return Answer(question, (), None, (), section)
    conclusion = section.record.conclusion
    claims = tuple(f"{s.claim}: {s.measured}." for s in conclusion.statements[:CLAIMS])
    said = (conclusion.answer,) if conclusion.answer else claims
    links = ((f"study-{name}", section.title),)
    return Answer(question, said, _chart(section.record, charts), links)


def _chart(record: StudyRecord | None, wanted: tuple[str, ...]) -> Chart | None:
    """The first of the charts that are wanted, or the first that there is."""
    if record is None:
        return None
    by_name = {chart.name: chart for chart in record.conclusion.charts}
    named = [by_name[name] for name in wanted if name in by_name]
    return next(iter([*named, *by_name.values()]), None)


def _furthest(shared: tuple[SharedReference, ...]) -> list[str]:
    """The largest difference of both solvers from one reference."""
    told = [pair for pair in shared if pair.tells]
    if not told:
        return []
    worst = max(told, key=lambda pair: pair.difference)
    errors = " and ".join(f"{WORDS[s]} {percent(worst.by(s).error)}" for s in Solver)
    return [
        f"On their finest runs, which are not equally fine, they are furthest apart in "
        f"{worst.name}: {percent(worst.difference)} of the reference ({errors} from it)."
    ]


def _direct(report: Report) -> list[str]:
    """The comparison of both results that uses most of what is allowed."""
    found: list[Direct] = [
        (case, verdict)
        for case in report.cases
        for verdict in case.verdicts
        if verdict.reference_kind == ReferenceKind.OTHER_SOLVER and verdict.clearance is not None
    ]
    if not found:
        return []
    case, worst = max(found, key=lambda item: item[1].clearance or 0.0)
    return [
        f"Compared with each other in {len(found)} numbers, they come closest to what is allowed "
        f"in case {case.name}, {worst.run}: {worst.meaning}, {plain(worst.error, 2)}, where "
        f"{plain(worst.allowed, 2)} is allowed ({clearance_text(worst)} of it).",
        *_left_out(report),
    ]


def _left_out(report: Report) -> list[str]:
    """What no comparison sees: how far they are apart where they are not compared."""
    return [
        f"{table.note} (Case {case.name}.)"
        for case in report.cases
        for table in case.tables
        if table.name == APART_EVERYWHERE
    ]
