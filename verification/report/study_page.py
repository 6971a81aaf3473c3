"""The page of a study, in its own directory and beside a report."""

from __future__ import annotations

from verification.report.templating import environment
from verification.running.record import StudyRecord


def render_study(record: StudyRecord) -> str:
    """The page as HTML; equal records give equal text."""
    return environment().get_template("study.html").render(study=record)
