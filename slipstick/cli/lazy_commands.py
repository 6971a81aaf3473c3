"""Commands that are imported when they are called, not when they are listed."""

from dataclasses import dataclass
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from slipstick.cli.option_mistakes import WordedCommand


@dataclass(frozen=True)
class LazyCommand:
    """Where a command's function lives, and the line that `--help` shows for it."""

    module: str
    function: str
    summary: str

    def load(self, name: str) -> Any:
        """Import the module and build the command from its function."""
        single = typer.Typer(add_completion=False, rich_markup_mode="markdown")
        single.command(name, cls=WordedCommand)(getattr(import_module(self.module), self.function))
        return typer.main.get_command(single)


COMMANDS: dict[str, LazyCommand] = {
    name: LazyCommand(f"slipstick.cli.{name}", name, summary)
    for name, summary in {
        "check": "Validate a scene file and say what it describes.",
        "plan": "Say which effects a scene needs, on which grid, in how many increments.",
        "run": "Solve a scene and write its results, tables and figures.",
        "frf": "Tabulate and plot the surface FRF of the lower body of a scene.",
        "stress": "Compute displacement and stress below the surface.",
        "table": "Print a table of reference numbers with their uncertainty.",
        "export": "Write the surface of a run for ParaView.",
        "verify": "Measure the accuracy against closed forms and write the report.",
        "compare": "Say what changed since the numbers that were accepted, or since a report.",
        "history": "Draw accuracy and cost over commits, and say what became worse.",
        "baseline": "List the accepted numbers, or accept those of a report.",
        "bench": "Measure what the method costs, beside other codes in turn.",
        "challenge": "List or export problems for other codes to solve.",
        "judge": "Judge another code's answers to a challenge.",
        "study": "Compute a study on a pool of processes and write its page.",
        "report": "Render the report again from recorded results.",
        "schema": "Print the JSON Schema of a scene file, a summary or a report.",
    }.items()
}


class LazyCommands(TyperGroup):
    """A group that knows names and summaries from a table and imports only what is called."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for name, command in COMMANDS.items():
            self.add_command(TyperCommand(name, help=command.summary))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        name, listed, rest = super().resolve_command(ctx, args)
        return name, COMMANDS[name].load(name) if name in COMMANDS else listed, rest
