"""Command `slipstick maintain baseline`: list or accept reference numbers of later comparisons."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.commands.report import read_report
from slipstick.cli.options import optional, refuse_unknown
from slipstick.cli.terminal import print_table
from verification.judging.outcome import commit_text
from verification.regression.baseline import BASELINES, read_baselines
from verification.regression.baseline import accept as accept_numbers


def baseline(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="CASE", help="Cases to accept or list. Default: all."),
    ] = None,
    accept: Annotated[
        bool, typer.Option("--accept", help="Record the numbers of a report.")
    ] = False,
    because: Annotated[
        str,
        optional(
            "--because",
            metavar="TEXT",
            help="Reason why the numbers are right; required by --accept.",
        ),
    ] = "",
    source: Annotated[
        Path,
        typer.Option("--from", metavar="REPORT", help="Folder of a report, or its report.json."),
    ] = Path("reports/quick"),
    directory: Annotated[
        Path | None,
        optional(
            "--to",
            metavar="DIR",
            help="Folder of the baselines. Default: the baselines of slipstick.",
        ),
    ] = None,
    with_failures: Annotated[
        bool, typer.Option("--with-failures", help="Accept cases with failed verdicts.")
    ] = False,
    with_changes: Annotated[
        bool,
        typer.Option("--with-changes", help="Accept numbers of sources with uncommitted changes."),
    ] = False,
) -> None:
    """List the accepted numbers, or accept the numbers of a report as baseline.

    A baseline has values, counts and verdicts of every case of the report, with the command, the
    versions, the processor, the commit, the date and the reason. Exit code 2 if there is no reason,
    if a verdict failed, or if the sources had uncommitted changes. The order is: commit, verify,
    accept, commit the baseline.

    Only the level of the report is replaced. Removed keys, and cases missing in a report of all
    cases, are listed in REMOVED.md with the reason.
    """
    folder = BASELINES if directory is None else directory
    if accept:
        report = read_report(source)
        files = accept_numbers(
            report,
            because,
            folder,
            names or (),
            with_failures=with_failures,
            with_changes=with_changes,
        )
        typer.echo(f"baselines of level {report.level} in {folder}: {len(files)} accepted")
        return
    if because:
        raise typer.BadParameter("--because needs --accept; add --accept or omit --because")
    accepted = read_baselines(folder)
    refuse_unknown("baseline", names or (), accepted, f"slipstick maintain baseline --to {folder}")
    rows = [
        (
            case,
            level,
            commit_text(of.by.commit, changed=of.by.changed),
            of.by.date[:10],
            str(len(of.quantities)),
            of.by.reason,
        )
        for case in names or accepted
        for level, of in accepted[case].levels.items()
    ]
    if rows:
        print_table(("case", "level", "commit", "date", "quantities", "reason"), rows)
    else:
        typer.echo(f"there are no baselines in {folder}")
