"""Command `slipstick judge`: judge the answers of another code to a challenge."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from contact_results.directory.atomic_file import Refused, atomic_file
from slipstick.cli.changes import print_comparison
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional, refuse_if, refuse_unknown
from slipstick.cli.terminal import print_table
from verification.challenge.cases import challenges
from verification.challenge.files import read_answers
from verification.challenge.python_api import Judgement, judged
from verification.challenge.python_api import judge as judge_solver
from verification.challenge.requested_quantities import Grade
from verification.challenge.saved_judgements import (
    judgement_changes,
    read_judgements,
    save_judgement,
)
from verification.challenge.solver_process import (
    SECONDS_PER_LEVEL,
    CannotDo,
    NoSuchSolver,
    SolverFailed,
    names_a_solver,
)
from verification.regression.change_row import Comparison
from verification.report.page import COLUMNS, render_sheet, row_texts


class GradeName(StrEnum):
    """Accuracy class of a judgement: largest error 1e-4 (A), 1e-3 (B) or 1e-2 (C) of the scale."""

    A = "A"
    B = "B"
    C = "C"


def judge(
    answers: Annotated[
        str,
        typer.Argument(
            metavar="DIR|FILE.py:FUNCTION",
            help="Folder of a challenge with answers, or a function that solves it.",
        ),
    ],
    case: Annotated[
        str | None, optional("--case", metavar="CASE", help="Challenge that the function solves.")
    ] = None,
    levels: Annotated[
        int,
        typer.Option(
            "--levels",
            metavar="N",
            help="Number of levels at which the function is called, from 0.",
            min=1,
        ),
    ] = 4,
    seconds: Annotated[
        float,
        typer.Option(
            "--seconds",
            metavar="S",
            help="Time limit of the function on each level, on level 0 with its import.",
            min=0.0,
        ),
    ] = SECONDS_PER_LEVEL,
    page: Annotated[
        Path | None,
        optional(
            "--page",
            metavar="FILE",
            help="Write the sheet as HTML to FILE, with the comparison of --against, and "
            "badge.json to its folder.",
        ),
    ] = None,
    grade: Annotated[
        GradeName | None,
        optional("--class", metavar="CLASS", help="Class that every error must meet: A, B or C."),
    ] = None,
    strict: Annotated[
        bool,
        typer.Option("--strict", help="Exit with code 6 if a verdict is inconclusive."),
    ] = False,
    partial: Annotated[
        bool, typer.Option("--partial", help="Accept answers without required numbers.")
    ] = False,
    save: Annotated[
        Path | None,
        optional(
            "--save",
            metavar="FILE",
            help="Save errors, answers, orders and unknowns of the case in FILE (JSON), which "
            "keeps other cases.",
        ),
    ] = None,
    against: Annotated[
        Path | None,
        optional(
            "--against",
            metavar="FILE",
            help="Compare with the judgement that --save stored in FILE.",
        ),
    ] = None,
) -> None:
    """Judge the answers of another code by bounds that do not depend on the code.

    The judgement of each number and field includes its error against class A, B or C, convergence
    under refinement, the claimed uncertainty, the balance of fields with the load, and the claimed
    order.

    Exit codes:

    - 0: no verdict failed
    - 1: a verdict failed, or a required number is missing
    - 2: the files cannot be read
    - 3: the solver failed, ended without an answer, or exceeded the time limit
    - 6: a verdict is inconclusive, with --strict
    - 7: with --against, an error grew by 50 % and by more than 1e-6 of its scale, unknowns grew by
      5 %, or a verdict, number or level is missing

    FILE.py is executed in a process of its own: judge only code that you trust.
    """
    refuse_if([(save and against, "--save excludes --against; omit one of them")])
    earlier = against or (save if save and save.exists() else None)
    if earlier is not None:
        read_judgements(earlier)  # Refuse before the solve.
    if names_a_solver(answers):
        found = _judge_function(answers, case, levels, seconds, grade, strict, against)
    elif case is not None:
        raise typer.BadParameter("--case applies to functions only; omit it for a folder")
    else:
        found = judged(*read_answers(Path(answers)), None if grade is None else Grade(grade))
    print_table(COLUMNS, [row_texts(row) for row in found.rows])
    for quantity, step, required in found.omitted:
        typer.echo(f"omitted: {quantity}, step {step}{' (required)' if required else ''}")
    typer.echo(found.line)
    comparison = None
    try:
        if against is not None:
            comparison = _comparison(found.challenge.name, found, against)
    finally:  # The page is written without a comparison if the file lacks the case.
        if page is not None:
            _write_sheet(page, found, comparison)
    if save is not None:
        save_judgement(found, save)
        typer.echo(f"saved: {save}")
    worse = ExitCode.PASS if comparison is None else print_comparison(comparison)
    # A lost verdict is inconclusive, too: what is worse precedes.
    codes = (
        found.exit_code(partial=partial),
        worse,
        found.exit_code(strict=strict, partial=partial),
    )
    if any(codes):
        raise typer.Exit(next(filter(None, codes)))


def _comparison(case: str, found: Judgement | None, against: Path) -> Comparison:
    """Compare a judgement, or None of an unsolved challenge, with the saved one."""
    return Comparison(tuple(judgement_changes(case, found, against)), against, f"--save {against}")


def _write_sheet(page: Path, found: Judgement, comparison: Comparison | None) -> None:
    """Write the page of a judgement, and badge.json beside it."""
    badge = page.parent / "badge.json"
    for path, text in ((page, render_sheet(found, comparison)), (badge, found.badge())):
        with atomic_file(path) as unfinished:
            unfinished.write_text(text, encoding="utf-8")
    typer.echo(f"sheet: {page}")


def _judge_function(
    name: str,
    case: str | None,
    levels: int,
    seconds: float,
    grade: GradeName | None,
    strict: bool,
    against: Path | None,
) -> Judgement:
    """Call a Python function that solves a challenge, and judge its answers.

    Exits the command if the function cannot solve the challenge or gives no answer.

    name     FILE.py:FUNCTION
    case     name of the challenge
    levels   number of refinement levels at which the function is called
    seconds  time limit of each level
    grade    accuracy class that every error must meet, or None
    strict   true to exit with code 6 if the function cannot solve the challenge
    against  file of saved judgements; code 7 if it contains the unsolved challenge
    """
    if case is None:
        raise typer.BadParameter(
            "a function needs --case; 'slipstick challenge list' lists the challenges"
        )
    refuse_unknown("challenge", [case], challenges(), "slipstick challenge list")
    try:
        return judge_solver(case, name, levels, grade, seconds=seconds)
    except NoSuchSolver:
        raise
    except Refused as reason:
        raise Refused(f"{case} by {name}: {reason}") from None
    except CannotDo as reason:
        typer.echo(f"{case} | {name} | cannot: {reason}")
        code = ExitCode.INCONCLUSIVE if strict else ExitCode.PASS
        if against is not None and (lost := _comparison(case, None, against)).rows:
            code = print_comparison(lost)
        raise typer.Exit(code) from None
    except SolverFailed as reason:
        typer.echo(f"{case}: {name} {reason}", err=True)
        raise typer.Exit(ExitCode.NOT_CONVERGED) from None
