"""`slipstick judge`: another code's answers to a challenge."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.optional import optional


class GradeName(StrEnum):
    """A: 1e-4 of the scale, B: 1e-3, C: 1e-2."""

    A = "A"
    B = "B"
    C = "C"


def judge(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A challenge, filled in.")],
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
        typer.Option("--strict", help="Exit with 6 where something is inconclusive or missing."),
    ] = False,
) -> None:
    """Judge what another code answered, by bounds that do not depend on it.

    Per number and field: the error against class A, B or C; whether it stalls under refinement;
    whether the uncertainty that it claims is honest; whether fields carry the load; the order, if
    one is claimed. Exit code 0 if nothing failed, 1 if a verdict did, 2 if the files cannot be
    read, 3 if the solver gave up, 6 with --strict if something is inconclusive or missing.
    """
    from contact_results.directory.atomic_file import atomic_file
    from slipstick.cli.terminal import print_table
    from verification.challenge.asked import Grade
    from verification.challenge.judgement import judged
    from verification.challenge.reading import read_answers
    from verification.report.judgement_sheet import COLUMNS, render_sheet, row_texts

    found = judged(*read_answers(folder), None if grade is None else Grade(grade))
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
    if code := found.exit_code(strict=strict):
        raise typer.Exit(code)
