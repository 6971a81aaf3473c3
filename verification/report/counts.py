"""The headline: how many verdicts ended how, and what studies did not pass."""

from __future__ import annotations

from verification.exhibits.numbers import value_text
from verification.judging.coverage import judged_errors
from verification.judging.outcome import Status
from verification.running.report_record import Report


def counts_text(report: Report) -> str:
    """How many verdicts ended how, and what studies did not pass."""
    counts = report.counts
    more = "".join(f"; {text}" for text in (covered_text(report), studies_text(report)) if text)
    return (
        f"{counts[Status.PASS]} passed, {counts[Status.FAIL]} failed, "
        f"{counts[Status.INCONCLUSIVE]} inconclusive{more}"
    )


def covered_text(report: Report) -> str:
    """Number of stated errors that cover the difference from the reference; empty without any."""
    found = [verdict.covered for _, verdict in judged_errors(report.cases)]
    return f"{sum(map(bool, found))} of {len(found)} stated errors cover" if found else ""


def uncovered_lines(report: Report) -> list[str]:
    """One line for every stated error that does not cover."""
    return [
        f"UNCOVERED {case.name}/{verdict.name} [{verdict.run}]: "
        f"{value_text(abs((verdict.value or 0.0) - verdict.reference), verdict.unit)} from the "
        f"reference, {value_text(verdict.stated_error, verdict.unit)} stated"
        for case, verdict in judged_errors(report.cases)
        if not verdict.covered
    ]


def studies_text(report: Report) -> str:
    """How many of the studies that are shown did not pass; empty where all did."""
    failed = len(report.failed_studies)
    not_here = sum(study.status is Status.FAIL for study in report.studies) - failed
    open_ = sum(study.status is Status.INCONCLUSIVE for study in report.studies)
    parts = (
        f"{failed} of the studies failed" if failed else "",
        f"{not_here} of the studies failed and are older than the code" if not_here else "",
        f"{open_} {'study' if open_ == 1 else 'studies'} inconclusive" if open_ else "",
    )
    return ", ".join(part for part in parts if part)
