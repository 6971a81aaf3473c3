"""Records of studies in a line."""

from __future__ import annotations

from verification.judging.change import commit_text
from verification.judging.outcome import Status
from verification.running.record import StudyRecord
from verification.running.sources import age_text


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
