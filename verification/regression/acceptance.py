"""From a report to baselines, if the report may become one."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from verification.judging.outcome import Status
from verification.regression.baseline import Baseline, Recording, keys_of, recording
from verification.regression.baseline_files import read_baselines, write_baselines
from verification.regression.refusal import BaselineRefused

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.running.report_record import Report


def accept(
    report: Report,
    reason: str,
    directory: Path,
    names: Collection[str] = (),
    *,
    with_failures: bool = False,
    with_changes: bool = False,
) -> tuple[Path, ...]:
    """Record the cases of a report as what later ones are compared with; the files written.

    reason         why these numbers are right
    names          cases of the report; none means all
    with_failures  also where a verdict failed
    with_changes   also if the source differed from its commit, or has none: "was … at 1a2b3c4"
                   is then not what that commit gives

    Keys that the earlier recording has and the report has not are listed in `REMOVED.md` with the
    reason; so is a case that a whole report lacks, whose recording is deleted.

    Raises BaselineRefused for a report that must not be recorded; nothing is written then.
    """
    reason = " ".join(reason.split())
    earlier = {
        case: baseline.levels[report.level]
        for case, baseline in read_baselines(directory).items()
        if report.level in baseline.levels and (not names or case in names)
    }
    cases = _chosen(report, () if report.chosen else earlier, names)
    failed = [f"{c.name}/{v.name}" for c in cases for v in c.verdicts if v.status is Status.FAIL]
    for refused, text in (
        (not reason, "a baseline needs a reason: --because 'why these numbers are right'"),
        (
            bool(failed) and not with_failures,
            f"{len(failed)} failed, the first is {', '.join(failed[:1])}; correct it, or accept "
            "it --with-failures",
        ),
        (
            not _reproducible(report) and not with_changes,
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
    """A report in the place of baselines, to compare another one with it."""
    return {
        case.name: Baseline(
            case=case.name, levels={report.level: recording(case, report.provenance, reason)}
        )
        for case in report.cases
    }


def _chosen(
    report: Report, removable: Collection[str], names: Collection[str]
) -> list[CaseOutcome]:
    missing = sorted(set(names) - {case.name for case in report.cases} - set(removable))
    if missing:
        raise BaselineRefused(
            f"the report has no case {', '.join(missing)}; --from names the report"
        )
    return [case for case in report.cases if not names or case.name in names]


def _reproducible(report: Report) -> bool:
    return report.provenance.commit is not None and not report.provenance.changed
