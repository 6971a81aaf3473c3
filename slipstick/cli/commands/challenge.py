"""Command `slipstick challenge`: list or export problems for other codes."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.options import directory, refuse_unknown
from slipstick.cli.terminal import print_table
from verification.challenge.cases import challenges
from verification.challenge.files import export


class Action(StrEnum):
    """Action of the command `slipstick challenge`: list the challenges, or export one."""

    LIST = "list"
    EXPORT = "export"


def challenge(
    action: Annotated[Action, typer.Argument(help="List all challenges, or export one.")],
    case: Annotated[
        str | None,
        typer.Argument(metavar="CASE", help="Name of the challenge; 'list' prints all names."),
    ] = None,
    output: Annotated[
        Path | None, directory("Directory of the files. Default: challenge-CASE.")
    ] = None,
    blind: Annotated[
        bool, typer.Option("--blind", help="Omit the reference and the scales.")
    ] = False,
) -> None:
    """Export a problem for another code: scene, description, empty answers, and the reference.

    Complete answers.json, then run 'slipstick judge DIR'. The answer does not need slipstick.
    """
    known = challenges()
    if action is Action.LIST:
        if case or output or blind:
            raise typer.BadParameter("'list' lists all challenges; omit CASE and options")
        rows = [
            (one.name, str(len(one.numbers)), str(len(one.fields)), one.title)
            for one in known.values()
        ]
        print_table(("challenge", "numbers", "fields", "title"), rows)
        return
    if case is None:
        raise typer.BadParameter(f"name a challenge; there are {', '.join(known)}")
    refuse_unknown("challenge", [case], known, "slipstick challenge list")
    folder = output or Path(f"challenge-{case.replace('/', '-')}")
    export(known[case], folder, blind=blind)
    typer.echo(f"{folder}: read problem.md, complete answers.json, then: slipstick judge {folder}")
