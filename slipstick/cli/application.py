"""Entry point of the command line: commands, version, and handling of exceptions."""

import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from contact_results.blas_threads import one_thread
from contact_results.directory.stop_signals import cleaned_up_when_stopped
from slipstick.cli.errors import ExitCode, explain
from slipstick.cli.lazy_commands import MAINTAIN, LazyCommands, MaintenanceCommands

application = typer.Typer(
    cls=LazyCommands,
    no_args_is_help=True,
    rich_markup_mode="markdown",
    epilog="Exit codes: 0 success; 1 accuracy verdict failed; 2 invalid scene or output; "
    "3 not converged or resolved; 4 too little memory, disk or time; 5 baseline drift; "
    "6 inconclusive (judge --strict); 7 worse than the baseline; 70 internal error; "
    "141 output closed.",
    context_settings={"help_option_names": ["-h", "--help"]},
)


maintenance = typer.Typer(cls=MaintenanceCommands, no_args_is_help=True)
application.add_typer(
    maintenance,
    name=MAINTAIN,
    rich_help_panel="Maintenance",
    help="Maintain the program: studies, baselines, reports, schemas, costs.",
)


@maintenance.callback()
def maintain() -> None:
    """Maintain the program: studies, baselines, reports, schemas, costs."""


def _print_version(wanted: bool) -> None:
    if wanted:
        from contact_results.directory.machine import program_version

        typer.echo(f"slipstick {program_version()}")
        raise typer.Exit


@application.callback()
def slipstick(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version and stop."
        ),
    ] = False,
) -> None:
    """Frictional contact of elastic, possibly coated bodies: slip, stick and their accuracy.

    A scene file (TOML) describes bodies, friction and loads; start with 'slipstick check SCENE'.
    """


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit with a code of `errors.ExitCode`.

    arguments  without the name of the program; None for those of this process
    """
    one_thread()
    command = typer.main.get_command(application)
    try:
        with cleaned_up_when_stopped():
            command(args=arguments, prog_name="slipstick")
    except SystemExit:
        # Typer exits with code 1 after its output was closed, with this replacement of stdout.
        if type(sys.stdout).__name__ == "PacifyFlushWrapper":
            raise SystemExit(ExitCode.NOBODY_READS) from None
        raise
    except Exception as error:
        raise SystemExit(explain(error)) from None
