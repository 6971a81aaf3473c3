"""The headline: how many verdicts ended how, and what studies did not pass."""

from __future__ import annotations

from verification.judging.outcome import Status
from verification.running.report_record import Report


def counts_text(report: Report) -> str:
    """How many verdicts ended how, and what studies did not pass."""
    counts = report.counts
    studies = f"; {told}" if (told := studies_text(report)) else ""
    return (
        f"{counts[Status.PASS]} passed, {counts[Status.FAIL]} failed, "
        f"{counts[Status.INCONCLUSIVE]} inconclusive{studies}"
    )


def studies_text(report: Report) -> str:
    """How many of the studies that are shown did not pass; empty where all did."""
    failed = len(report.failed_studies)
    not_here = sum(study.status is Status.FAIL for study in report.studies) - failed
    open_ = sum(study.status is Status.INCONCLUSIVE for study in report.studies)
    parts = (
        f"{failed} of the studies failed" if failed else "",
        f"{not_here} of the studies failed with other sources" if not_here else "",
        f"{open_} {'study' if open_ == 1 else 'studies'} inconclusive" if open_ else "",
    )
    return ", ".join(part for part in parts if part)
