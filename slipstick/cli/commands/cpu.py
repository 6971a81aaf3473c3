"""Command `slipstick maintain cpu`: compare the CPU time of solvers and commands."""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.changes import print_comparison
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional
from verification.regression.change_row import Comparison
from verification.regression.cpu_time import (
    CPU_TIMES,
    Commands,
    accept_cpu_times,
    cpu_time_changes,
    read_cpu_times,
)
from verification.running.provenance import provenance

# Options that leave the solve of the scene alone.
ALONE = ("--figures", "none", "--no-error", "--output", "out")
COARSER = ("--set", "fem_reference.elements_per_radius=8")
SOLVERS = {
    "semi-analytical": (),
    "radial": (),
    "fem": COARSER,
    "fem-complementarity": COARSER,
}


def commands(scenes: Path) -> Commands:
    """Return the measured commands by name: a solve by each solver, and the commands of a new user.

    scenes  folder of the scenes of slipstick
    """
    pressed, pushed = scenes / "coated_ball.toml", scenes / "coated_fretting.toml"
    layer = "body.layers[1].thickness=0.1..0.2 mm 2"
    return {
        **{
            f"solve by {solver}": ("run", pushed, "--solver", solver, *ALONE, *more)
            for solver, more in SOLVERS.items()
        },
        "check": ("check", pressed),
        "plan": ("plan", pressed),
        "run": ("run", pressed, "--output", "out"),
        "stress": ("stress", pressed, "--output", "out"),
        "sweep": ("sweep", pressed, "--vary", layer, "--output", "out"),
    }


def cpu(
    accept: Annotated[bool, typer.Option("--accept", help="Store the times.")] = False,
    because: Annotated[
        str,
        optional(
            "--because",
            metavar="TEXT",
            help="Reason why the times are right; required by --accept.",
        ),
    ] = "",
) -> None:
    """Compare the CPU time of solvers and commands with the stored times.

    Each command is measured between two runs of a calibrated loop, and repeated up to 5 times; the
    smallest ratio of both times counts. Above 1.3 times the stored ratio a change is printed.
    Exit code 7 above 1.6 times, if the times were stored on this kind of processor.
    """
    made = provenance("slipstick maintain cpu", {})
    with as_file(files("slipstick") / "scenes") as scenes:
        if accept:
            accept_cpu_times(commands(scenes), made, because)
            typer.echo(f"CPU times in {CPU_TIMES}")
            return
        rows = tuple(cpu_time_changes(commands(scenes), made, read_cpu_times()))
    code = print_comparison(
        Comparison(rows, Path(CPU_TIMES.name), "slipstick maintain cpu --accept")
    )
    if code is not ExitCode.PASS:
        raise typer.Exit(code)
