"""Command `slipstick maintain tolerances`: propose or accept tolerances from the errors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.commands.report import read_report
from slipstick.cli.options import optional
from slipstick.cli.terminal import print_table
from verification.regression.tolerances import accept_tolerances, proposed, read_tolerances


def tolerances(
    reports: Annotated[
        list[Path],
        typer.Argument(
            metavar="REPORT...", help="Reports of one level with different BLAS kernels."
        ),
    ],
    accept: Annotated[bool, typer.Option("--accept", help="Store the proposals.")] = False,
    because: Annotated[
        str,
        optional(
            "--because",
            metavar="TEXT",
            help="Reason why the errors are right; required by --accept.",
        ),
    ] = "",
) -> None:
    """Propose or accept a tolerance of 2 times the largest error for each number with slack.

    A number has slack if its tolerance exceeds 3 times its largest error. The variable
    OPENBLAS_CORETYPE=Haswell, SkylakeX or Prescott selects the BLAS kernel of a report. Accepted
    tolerances of a level are in verification/tolerances, with errors and reason; the bounds in the
    cases remain upper limits.
    Exit code 2 without a reason.
    """
    read = [read_report(path) for path in reports]
    if accept:
        count = accept_tolerances(read, because)
        typer.echo(f"{count} tolerances of level {read[0].level} accepted")
        return
    rows = [
        (case, key, f"{tolerance.error:.2g}", f"{tolerance.allowed:.2g}")
        for case, keys in proposed(read, read_tolerances(read[0].level)).items()
        for key, tolerance in keys.items()
    ]
    print_table(("case", "number", "largest error", "proposed"), rows)
