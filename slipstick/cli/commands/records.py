"""Command `slipstick maintain records`: list or regenerate stored records."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional, refuse_unknown
from slipstick.cli.terminal import print_table
from verification.judging.outcome import commit_text
from verification.running.provenance import age_text
from verification.running.report_record import stored_records


def records(
    directory: Annotated[
        Path, typer.Argument(metavar="DIR", help="Folder with full/ and studies/.")
    ] = Path("reports"),
    only: Annotated[
        list[str] | None,
        optional(metavar="NAME", help="Name of a folder with a record; repeatable. Default: all."),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Exit with code 7 if a record is older than the code.")
    ] = False,
    regenerate: Annotated[
        bool, typer.Option("--regenerate", help="Regenerate records older than the code.")
    ] = False,
) -> None:
    """List stored records by cost, with their commit and changes of the code since.

    A record is older than the code if one of the modules that made it, or of their imports, has
    changed. --regenerate makes these records again, the cheapest first, and prints the times.
    After the command was killed, the same command computes the missing records and cases. Exit
    code 7 with --check if a record is older than the code; 1 if a record cannot be made; 2 if DIR
    has no record.
    """
    found = stored_records(directory)
    if not found:
        raise typer.BadParameter(f"no record in {directory}", param_hint="DIR")
    names = [record.name for record in found]
    refuse_unknown("record", only or (), names, "slipstick maintain records")
    found = [record for record in found if not only or record.name in only]
    stale = [record for record in found if age_text(record.provenance)]
    print_table(
        ("record", "made at", "seconds", "age"),
        [
            (
                str(record.path),
                commit_text(record.provenance.commit, changed=record.provenance.changed),
                f"{record.seconds:.0f}",
                age_text(record.provenance) or "current",
            )
            for record in found
        ],
    )
    failed = False
    for record in stale if regenerate else ():
        started = time.perf_counter()
        code = subprocess.run(
            [sys.executable, "-m", "slipstick", *record.arguments], check=False
        ).returncode
        if code in (ExitCode.PASS, ExitCode.ACCURACY):
            record.pack()
        failed |= code != ExitCode.PASS
        typer.echo(f"{record.path}: exit code {code}, {time.perf_counter() - started:.0f} s")
    if failed:
        raise typer.Exit(ExitCode.ACCURACY)
    if check and stale and not regenerate:
        raise typer.Exit(ExitCode.WORSE)
