"""`slipstick maintain baseline`: the numbers that later reports are compared with."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.commands.report import read_report
from slipstick.cli.options import optional


def baseline(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="CASE", help="Cases to accept or list; none means all."),
    ] = None,
    accept: Annotated[
        bool, typer.Option("--accept", help="Record the numbers of a report.")
    ] = False,
    because: Annotated[
        str,
        optional(
            "--because", metavar="TEXT", help="Why these numbers are right; --accept needs it."
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
            help="Folder of the baselines; the one that comes with slipstick if absent.",
        ),
    ] = None,
    with_failures: Annotated[
        bool, typer.Option("--with-failures", help="Accept cases with failed verdicts as well.")
    ] = False,
    with_changes: Annotated[
        bool,
        typer.Option(
            "--with-changes", help="Accept numbers of a source that differs from its commit."
        ),
    ] = False,
) -> None:
    """List the accepted numbers, or accept those of a report as what later ones are compared with.

    Accepted are values, counts and verdicts of every case of the report, with the command, the
    versions, the processor, the commit, the date and the reason. Exit code 2 if there is no
    reason, a verdict failed, or the source differed from its commit: a baseline of numbers that no
    commit gives could not be made again. So: commit, verify, accept, commit the baseline.
    Each level is recorded for itself; what is recorded of the others stays. Keys that the report
    no longer has, and cases that a report of all cases no longer has, are listed in REMOVED.md with
    the reason.
    """  # fmt: skip
    from verification.regression.baseline import BASELINES

    folder = BASELINES if directory is None else directory
    if not accept:
        if because:
            raise typer.BadParameter("--because gives the reason of --accept, which is not there")
        _list(folder, names or [])
        return
    from verification.regression.baseline import accept as record

    report = read_report(source)
    files = record(
        report,
        because,
        folder,
        names or (),
        with_failures=with_failures,
        with_changes=with_changes,
    )
    typer.echo(f"{len(files)} baselines of level {report.level} in {folder}")


def _list(folder: Path, names: list[str]) -> None:
    from slipstick.cli.terminal import print_table
    from verification.judging.outcome import commit_text
    from verification.regression.baseline import read_baselines

    rows = [
        (case, level, commit_text(of.by.commit, changed=of.by.changed), of.by.date[:10],
         str(len(of.quantities)), of.by.reason)
        for case, recorded in read_baselines(folder).items()
        for level, of in recorded.levels.items()
        if not names or case in names
    ]  # fmt: skip
    if not rows:
        typer.echo(f"no baseline yet in {folder}")
        return
    print_table(("case", "level", "commit", "date", "quantities", "reason"), rows)
