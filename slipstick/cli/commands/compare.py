"""Command `slipstick maintain compare`: list changes since the accepted numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.changes import print_changes
from slipstick.cli.commands.report import read_report
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional
from verification.judging.outcome import ChangeKind, failure_line
from verification.regression.baseline import Baseline, baselines_of, read_baselines
from verification.regression.comparison import compared, refuse_if_not_whole
from verification.report.files import record_in
from verification.report.summary_text import change_rows, changes_text, origins, without_baseline
from verification.running.provenance import age_text
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
            help="Folder of baselines, or report.json of another report. Default: the baselines of "
            "slipstick.",
        ),
    ] = None,
    chosen: Annotated[
        bool,
        typer.Option(
            "--chosen", help="Compare a report of chosen cases; do not report missing cases."
        ),
    ] = False,
) -> None:
    """List the changes since the baseline, with the commit of the baseline and a command.

    Changes are given in units of the tolerance. Nothing is computed.

    Exit codes:

    - 0: no change
    - 1: a verdict fails that passed, or a number moved away from its reference by more than the
      tolerance
    - 2: the report contradicts itself, or has chosen cases only, without --chosen
    - 5: other changes within the tolerance: new, not recorded, much better, fewer iterations, a
      stated error that grew by 50 %
    - 7: a recorded verdict, finding, run or case is missing, a verdict that passed is inconclusive,
      an error or a tolerance grew by 50 %, a stated error no longer covers the difference from the
      reference, or iterations, convolutions or factorisations grew by 5 %

    Differences of processors and versions are no change: 1e-6 of the scale of an error, and 1 % of
    the tolerance if the error grew by less than 50 %. The baselines are those of the report's
    level.
    """
    measured, recorded = read_report(report), _read_baselines(baseline)
    if not chosen:
        refuse_if_not_whole(measured, recorded)
    outcome = compared(measured, recorded)
    if age := age_text(measured.provenance):
        typer.echo(f"the report is {age}")
    _print_changes(outcome)
    if len(without_baseline(outcome)) == len(outcome.cases) > 0:
        typer.echo(
            f"error: these cases have no baseline at level {outcome.level}; to record one: "
            f"slipstick maintain baseline --accept --because '...' --from {report}",
            err=True,
        )
    code = exit_code_of(outcome)
    if code is not ExitCode.PASS:
        raise typer.Exit(code)


def exit_code_of(report: Report) -> ExitCode:
    """Return the exit code of `slipstick maintain compare` for a report with its changes.

    The code is 1 for a number outside its tolerance, 7 for a regression, 5 for other changes and
    for cases without a baseline, else 0.

    report  verification report that was compared with a baseline
    """
    kinds = {row.kind for row in change_rows(report)}
    if ChangeKind.OUTSIDE in kinds:
        return ExitCode.ACCURACY
    if any(kind.regresses for kind in kinds):
        return ExitCode.WORSE
    unknown = kinds or without_baseline(report)
    return ExitCode.BASELINE_DRIFT if unknown else ExitCode.PASS


def _read_baselines(place: Path | None) -> dict[str, Baseline]:
    if place is None or (place.is_dir() and not record_in(place).is_file()):
        return read_baselines(place)
    return baselines_of(read_report(place), f"the report {place}")


def _print_changes(report: Report) -> None:
    """Print the changes of a verification report since its baseline.

    A command that reproduces the changed cases is printed as well.
    """
    for case in report.cases:
        for verdict in case.verdicts:
            change = verdict.regression
            if change is not None and change.kind is ChangeKind.OUTSIDE:
                typer.echo(failure_line(case.name, verdict, report.level))
    rows = change_rows(report)
    if rows:
        print_changes(rows)
        judged = {case.name for case in report.cases}
        names = dict.fromkeys(row.case for row in rows if row.case in judged)
        command = " ".join(("slipstick verify", *names, f"--level {report.level}"))
        typer.echo(f"reproduce: {command}")
    for origin, cases in origins(report):
        typer.echo(f"baseline of {len(cases)} cases: {origin.name}, {origin.date}: {origin.reason}")
        for difference in origin.differs:
            typer.echo(f"  differs: {difference}")
    typer.echo(changes_text(report))
