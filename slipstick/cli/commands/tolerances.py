"""`slipstick maintain tolerances`: tolerances that follow the errors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.commands.report import read_report
from slipstick.cli.options import optional


def tolerances(
    reports: Annotated[
        list[Path],
        typer.Argument(
            metavar="REPORT...", help="Reports of one level, each by another BLAS kernel."
        ),
    ],
    accept: Annotated[bool, typer.Option("--accept", help="Store the proposals.")] = False,
    because: Annotated[
        str, optional("--because", metavar="TEXT", help="Why the errors are right.")
    ] = "",
) -> None:
    """Propose a tolerance of twice the largest error for each number with slack, or accept these.

    A number has slack if its tolerance exceeds three times its largest error. Reports of several
    BLAS kernels are made by OPENBLAS_CORETYPE=Haswell, SkylakeX, Prescott and so on. Accepted
    tolerances of a level are in verification/tolerances, with their errors and the reason; the
    bounds in the cases remain the largest tolerances. Exit code 2 without a reason.
    """
    from slipstick.cli.terminal import print_table
    from verification.regression.tolerances import (
        accept_tolerances,
        proposed,
        read_tolerances,
    )

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
