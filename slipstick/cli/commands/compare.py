"""`slipstick maintain compare`: changes since the accepted numbers, or since a report."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.commands.report import read_report
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional

if TYPE_CHECKING:
    from verification.regression.baseline import Baseline
    from verification.running.report_record import Report


def compare(
    report: Annotated[
        Path,
        typer.Argument(metavar="REPORT", help="Folder of a report, or its report.json."),
    ] = Path("reports/quick"),
    baseline: Annotated[
        Path | None,
        optional(
            "--baseline",
            metavar="PLACE",
            help="A folder of baselines, or the report.json of another report; the baselines that "
            "come with slipstick if absent.",
        ),
    ] = None,
    chosen: Annotated[
        bool,
        typer.Option(
            "--chosen", help="Compare a report of chosen cases without missing the other cases."
        ),
    ] = False,
) -> None:
    """Say what changed since the baseline, by how much in units of the tolerance, since which
    commit, and how to see it again.

    Nothing is computed. Exit code 0 if nothing changed; 5 if something did and is within what
    its reference allows (also: new, not recorded yet, suspiciously better, cheaper); 7 if a
    recorded verdict, finding, run or case is missing, or if within the tolerance an error has
    grown by half or a case takes a twentieth more iterations, convolutions or factorisations; 1 if
    something fails that did not or has
    moved away from its reference by more than is allowed at all; 2 if the report contradicts
    itself, or if only chosen cases ran and others are recorded: such a report never stands for a
    whole one, unless --chosen says that it need not. What other processors and versions leave
    is no change: a millionth of what errors are divided by, and a hundredth of what is allowed
    where the error has not grown by half.

    Baselines are recorded by level, and those of the report's level are taken.
    """  # fmt: skip
    from verification.regression.comparison import compared, refuse_if_not_whole
    from verification.report.changes import without_baseline
    from verification.running.sources import age_text

    measured, recorded = read_report(report), _baselines(baseline)
    if not chosen:
        refuse_if_not_whole(measured, recorded)
    outcome = compared(measured, recorded)
    if age := age_text(measured.provenance):
        typer.echo(f"the report is {age}")
    _print_changes(outcome)
    if len(without_baseline(outcome)) == len(outcome.cases) > 0:
        typer.echo(
            f"error: nothing is recorded of these cases at level {outcome.level}; to record it: "
            f"slipstick maintain baseline --accept --because '...' --from {report}",
            err=True,
        )
    code = exit_code_of(outcome)
    if code is not ExitCode.PASS:
        raise typer.Exit(code)


def exit_code_of(report: Report) -> ExitCode:
    """What a compared report amounts to."""
    from verification.judging.outcome import ChangeKind
    from verification.report.changes import change_rows, without_baseline

    kinds = {row.kind for row in change_rows(report)}
    if ChangeKind.OUTSIDE in kinds:
        return ExitCode.ACCURACY
    if any(kind.regresses for kind in kinds):
        return ExitCode.WORSE
    unknown = kinds or without_baseline(report)
    return ExitCode.BASELINE_DRIFT if unknown else ExitCode.PASS


def _baselines(place: Path | None) -> dict[str, Baseline]:
    from verification.regression.baseline import baselines_of, read_baselines
    from verification.report.files import record_in

    if place is None or (place.is_dir() and not record_in(place).is_file()):
        return read_baselines(place)
    return baselines_of(read_report(place), f"the report {place}")


def _print_changes(report: Report) -> None:
    from slipstick.cli.terminal import print_table
    from verification.judging.outcome import ChangeKind, failure_line
    from verification.report.changes import change_rows, changes_text, origins

    for case in report.cases:
        for verdict in case.verdicts:
            change = verdict.regression
            if change is not None and change.kind is ChangeKind.OUTSIDE:
                typer.echo(failure_line(case.name, verdict, report.level))
    rows = change_rows(report)
    if rows:
        columns = ("quantity", "run", "change", "was", "is", "moved by", "since", "remark")
        print_table(
            columns,
            [
                (f"{r.case}/{r.name}", r.run, r.kind, r.was, r.now, r.moved, r.since, r.remark)
                for r in rows
            ],
        )
        judged = {case.name for case in report.cases}
        names = dict.fromkeys(row.case for row in rows if row.case in judged)
        command = " ".join(("slipstick verify", *names, f"--level {report.level}"))
        typer.echo(f"reproduce: {command}")
    for origin, cases in origins(report):
        typer.echo(f"baseline of {len(cases)} cases: {origin.name}, {origin.date}: {origin.reason}")
        for difference in origin.differs:
            typer.echo(f"  differs: {difference}")
    typer.echo(changes_text(report))
