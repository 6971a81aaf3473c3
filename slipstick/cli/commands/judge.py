"""`slipstick judge`: another code's answers to a challenge."""

from __future__ import annotations

import traceback
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.options import optional

if TYPE_CHECKING:
    from verification.challenge.judgement import Judgement


class GradeName(StrEnum):
    """A: 1e-4 of the scale, B: 1e-3, C: 1e-2."""

    A = "A"
    B = "B"
    C = "C"


def judge(
    answers: Annotated[
        str,
        typer.Argument(
            metavar="DIR|FILE.py:FUNCTION",
            help="A challenge, filled in; or a function that solves.",
        ),
    ],
    case: Annotated[
        str | None, optional("--case", metavar="CASE", help="What the function is to solve.")
    ] = None,
    levels: Annotated[
        int, typer.Option("--levels", metavar="N", help="Of a function: 0 to N - 1.", min=1)
    ] = 4,
    page: Annotated[
        Path | None,
        optional("--page", metavar="FILE", help="Write the sheet as HTML, badge.json beside it."),
    ] = None,
    grade: Annotated[
        GradeName | None,
        optional("--class", metavar="CLASS", help="What every error must meet: A, B or C."),
    ] = None,
    strict: Annotated[
        bool,
        typer.Option("--strict", help="Exit with 6 where something is inconclusive."),
    ] = False,
    partial: Annotated[
        bool, typer.Option("--partial", help="Accept that required numbers are omitted.")
    ] = False,
) -> None:
    """Judge what another code answered, by bounds that do not depend on it.

    Per number and field: the error against class A, B or C; whether it stalls under refinement;
    whether the uncertainty that it claims is honest; whether fields carry the load; the order, if
    one is claimed. Exit code 0 if nothing failed, 1 if a verdict did or a required number is
    omitted, 2 if the files cannot be read, 3 if the solver gave up or raised, 6 with --strict if
    something is inconclusive. FILE.py is run: judge only what you trust.
    """
    from contact_results.directory.atomic_file import atomic_file
    from slipstick.cli.terminal import print_table
    from verification.challenge.answer_reader import read_answers
    from verification.challenge.judgement import judged
    from verification.challenge.python_api import names_a_solver
    from verification.challenge.requested_quantities import Grade
    from verification.report.judgement_sheet import COLUMNS, render_sheet, row_texts

    if names_a_solver(answers):
        found = _solved(answers, case, levels, grade, strict)
    elif case is not None:
        raise typer.BadParameter("--case is for a function; a folder knows its challenge")
    else:
        found = judged(*read_answers(Path(answers)), None if grade is None else Grade(grade))
    print_table(COLUMNS, [row_texts(row) for row in found.rows])
    for quantity, step, required in found.omitted:
        typer.echo(f"omitted: {quantity}, step {step}{' (required)' if required else ''}")
    typer.echo(found.line)
    if page is not None:
        badge = page.parent / "badge.json"
        for path, text in ((page, render_sheet(found)), (badge, found.badge())):
            with atomic_file(path) as unfinished:
                unfinished.write_text(text, encoding="utf-8")
        typer.echo(f"sheet: {page}")
    if code := found.exit_code(strict=strict, partial=partial):
        raise typer.Exit(code)


def _solved(
    name: str, case: str | None, levels: int, grade: GradeName | None, strict: bool
) -> Judgement:
    """Of a function; ends the command where it cannot or raises."""
    from contact_results.directory.refusal import Refused
    from slipstick.cli.errors import ExitCode
    from slipstick.cli.options import unknown_names
    from verification.challenge.answer import Solver
    from verification.challenge.cases import challenges
    from verification.challenge.python_api import CannotDo, named_solver
    from verification.challenge.python_api import judge as judge_solver

    if case is None:
        raise typer.BadParameter("a function needs --case; 'slipstick challenge list' names them")
    if problem := unknown_names("challenge", [case], challenges(), "slipstick challenge list"):
        raise typer.BadParameter(problem)
    solve = named_solver(name)
    try:
        return judge_solver(case, solve, levels, grade, Solver(name))
    except Refused as reason:
        raise Refused(f"{case} by {name}: {reason}") from None
    except CannotDo as reason:
        typer.echo(f"{case} | {name} | cannot: {reason}")
        raise typer.Exit(ExitCode.INCONCLUSIVE if strict else ExitCode.PASS) from None
    except Exception:
        traceback.print_exc()
        typer.echo(f"{case}: {name} raised; see above", err=True)
        raise typer.Exit(ExitCode.NOT_CONVERGED) from None
