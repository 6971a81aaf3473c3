"""Entry point of the command line: table of commands, lazy imports and handling of exceptions."""

import atexit
import gc
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from contact_results.blas_threads import one_thread
from contact_results.directory.stop_signals import cleaned_up_when_stopped
from slipstick.cli.errors import ExitCode, explain

LONGEST = 600  # characters of a message
# Number of new objects before a search for unreachable cycles of references. Searches at Python's
# default of 700, during imports, and at exit take 15 % of the CPU time of a short run.
COLLECTED_OBJECTS = 500_000


class WordedCommand(TyperCommand):
    """Typer command that reports invalid values of options in the wording of slipstick."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the arguments of the command; raises BadParameter with a reworded message."""
        try:
            return super().parse_args(ctx, args)
        except typer.BadParameter as error:
            error.message = _shorten_message(_reword_message(error))
            raise

    def invoke(self, ctx: Any) -> Any:
        """Call the function of the command; raises BadParameter with a shortened message."""
        try:
            return super().invoke(ctx)
        except typer.BadParameter as error:
            error.message = _shorten_message(error.message)
            raise


def _shorten_message(message: str) -> str:
    left_out = len(message) - LONGEST
    if left_out <= 0:
        return message
    half = LONGEST // 2
    return f"{message[:half]} ... {left_out} characters ... {message[-half:]}"


def _reword_message(error: typer.BadParameter) -> str:
    """Return the message of an invalid option value in the wording of slipstick.

    Messages of the library pydantic are reworded; other messages are unchanged.
    """
    find: Any = getattr(error.__cause__, "errors", None)
    if find is None:
        return error.message
    (found, *_) = find(include_url=False)
    kind, given, context = found["type"], found["input"], found.get("ctx", {})
    if kind == "greater_than_equal":
        return f"got {given}, expected at least {context['ge']}"
    if kind == "less_than_equal":
        return f"got {given}, expected at most {context['le']}"
    if kind.startswith("int_"):
        return f"got '{given}', expected a whole number"
    if kind == "value_error":
        return str(context["error"])
    return error.message


@dataclass(frozen=True)
class LazyCommand:
    """Command of the command line that is imported when it is called.

    module, function  module and function of the command
    summary           line in `--help`
    """

    module: str
    function: str
    summary: str

    def load(self, name: str) -> Any:
        """Import the module of the command, and build the typer command from its function.

        name  name of the command on the command line
        """
        single = typer.Typer(add_completion=False, rich_markup_mode="markdown")
        single.command(name, cls=WordedCommand)(getattr(import_module(self.module), self.function))
        return typer.main.get_command(single)


def _lazy_commands(summaries: dict[str, str]) -> dict[str, LazyCommand]:
    """Return lazy commands by name, from their lines in `--help`."""
    return {
        name: LazyCommand(f"slipstick.cli.commands.{name}", name, summary)
        for name, summary in summaries.items()
    }


COMMANDS = _lazy_commands(
    {
        "example": "Print a scene file that comes with the program.",
        "check": "Validate a scene file and describe it.",
        "plan": "Print the effects, the grid, the time and the memory of a run.",
        "run": "Solve a scene and write its results, tables and pictures.",
        "stress": "Compute displacement and stress below the surface.",
        "limit": "Find the load factors at which stresses meet their strengths.",
        "sweep": "Solve a scene for values of its keys; write a table and a chart.",
        "convergence": "Refine a scene; state the error and the cost of its setting.",
        "against": "Compare a run with a measured loop or profile.",
        "export": "Write the surface of a run for ParaView.",
        "table": "Print a table of reference numbers with their uncertainty.",
        "verify": "Measure the accuracy against closed forms and write the report.",
        "challenge": "List or export problems for other codes to solve.",
        "judge": "Judge another code's answers to a challenge.",
    }
)
MAINTAIN = "maintain"
MAINTENANCE = _lazy_commands(
    {
        "study": "Compute a study on a pool of processes and write its page.",
        "compare": "List changes since the accepted numbers, or since a report.",
        "baseline": "List the accepted numbers, or accept those of a report.",
        "tolerances": "Propose or accept tolerances that follow the errors.",
        "cpu": "Compare the CPU time of solvers and commands with the stored times.",
        "records": "List stored records, their age and cost, or regenerate them.",
        "deposit": "Write all reference tables as an RO-Crate.",
        "report": "Render the report again from recorded results.",
        "schema": "Print the JSON Schema of a scene file, a summary or a report.",
    }
)


# All commands by name, as given on the command line.
ALL_COMMANDS = COMMANDS | {f"{MAINTAIN} {name}": each for name, each in MAINTENANCE.items()}


class LazyCommands(TyperGroup):
    """Group of commands from a table, of which only the called command is imported."""

    table = COMMANDS

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for name, command in self.table.items():
            self.add_command(TyperCommand(name, help=command.summary))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        name, listed, rest = super().resolve_command(ctx, args)
        return name, self.table[name].load(name) if name in self.table else listed, rest


class MaintenanceCommands(LazyCommands):
    """Group of the commands `slipstick maintain ...` for the maintenance of the program."""

    table = MAINTENANCE


application = typer.Typer(
    cls=LazyCommands,
    no_args_is_help=True,
    rich_markup_mode="markdown",
    epilog="Exit codes: 0 success; 1 accuracy verdict failed; 2 invalid scene or output; "
    "3 not converged or resolved; 4 too little memory, disk or time; 5 baseline drift; "
    "6 inconclusive (judge --strict, convergence); 7 worse than the baseline; "
    "70 internal error; 141 output closed.",
    context_settings={"help_option_names": ["-h", "--help"]},
)


maintenance = typer.Typer(cls=MaintenanceCommands, no_args_is_help=True)
application.add_typer(
    maintenance,
    name=MAINTAIN,
    rich_help_panel="Maintenance",
    help="Maintain the program: studies, baselines, tolerances, records, reports.",
)


@maintenance.callback()
def maintain() -> None:
    """Maintain the program: studies, baselines, tolerances, records, reports."""


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

    arguments  arguments without the name of the program; None for those of this process
    """
    one_thread()
    gc.set_threshold(COLLECTED_OBJECTS)
    atexit.register(gc.freeze)  # the exit then searches no objects
    # The search for plugins of pydantic reads the metadata of all installed packages.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    command = typer.main.get_command(application)
    try:
        with cleaned_up_when_stopped():
            command(args=arguments, prog_name="slipstick")
    except SystemExit:
        # Typer replaces stdout by this class, and exits with code 1, after its output was closed.
        if type(sys.stdout).__name__ == "PacifyFlushWrapper":
            raise SystemExit(ExitCode.NOBODY_READS) from None
        raise
    except Exception as error:
        raise SystemExit(explain(error)) from None
