"""Saved judgements of a solver on challenges, and the comparison of later judgements with them.

The rules are those of the baselines of this program, see `verification.regression.comparison`.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from typing import Literal

from contact_results.directory.atomic_file import Refused
from contact_results.directory.json_record import read_record, write_record
from contact_scene.reading.description import Description
from verification.challenge.python_api import WHOLE, Judgement, Row
from verification.convergence.observed_order import order_text
from verification.exhibits.chart import plain
from verification.judging.outcome import (
    WORDS,
    ChangeKind,
    Count,
    Origin,
    Status,
    finite,
    moved_text,
)
from verification.regression.baseline import JudgedQuantity
from verification.regression.change_row import ABSENT, ChangeRow, count_row, rows_that_matter
from verification.regression.comparison import count_change, quantity_change

WHAT = "file of judgements"
REMEDY = "restore it, or delete it and save the judgement again by --save"
NO_ORIGIN = Origin(commit=None, changed=False, date="", reason="")
DIGITS = 3  # of an error


class SavedLevel(Description):
    """Refinement level of a saved judgement."""

    label: str
    h: float
    """Side of a cell or element at the contact edge [m]."""

    unknowns: Count | None
    """Number of unknowns of the discrete problem; null if the solver does not give it."""


class SavedJudgement(Description):
    """Saved judgement of a solver on one challenge."""

    solver: str
    quantities: tuple[JudgedQuantity, ...]
    levels: tuple[SavedLevel, ...]
    """Refinement levels from coarse to fine."""


class SavedJudgements(Description):
    """Content of the file of `slipstick judge --save`: judgements by name of the challenge."""

    schema_version: Literal[1] = 1
    cases: dict[str, SavedJudgement]


def read_judgements(path: Path) -> SavedJudgements:
    """Read a file of saved judgements; raises Refused if the file is missing or damaged."""
    return read_record(path, SavedJudgements, WHAT, REMEDY)


def save_judgement(found: Judgement, path: Path) -> None:
    """Save the judgement of a solver on a challenge in a file, which keeps those of other
    challenges.

    Equal judgements give equal bytes. Raises Refused for an existing file that is damaged.
    """
    cases = read_judgements(path).cases if path.exists() else {}
    saved = SavedJudgement(
        solver=found.solver.name,
        # A property without an error, such as stalled convergence, has a row only if it fails.
        quantities=tuple(
            _quantity(row)
            for row in found.rows
            if row.error is not None or row.status is Status.PASS
        ),
        levels=_levels(found),
    )
    ordered = sorted((cases | {found.challenge.name: saved}).items())
    write_record(path, SavedJudgements(cases=dict(ordered)))


def judgement_changes(case: str, found: Judgement | None, path: Path) -> list[ChangeRow]:
    """Return the changes of a judgement since it was saved in a file, the worst first.

    case   name of the challenge
    found  judgement of the challenge; None if the solver cannot do the challenge

    Raises Refused if the file is missing or damaged, or does not contain the judged challenge.
    """
    cases = read_judgements(path).cases
    if case not in cases:
        if found is None:
            return []
        raise Refused(
            f"{WHAT} {path}: key cases: got {', '.join(cases) or 'none'}, expected {case}; add it "
            f"by --save {path}"
        )
    rows = (found and found.rows) or ()
    levels = _levels(found) if found else ()
    return rows_that_matter(
        (
            *_quantity_changes(case, rows, cases[case], path.name),
            *_level_changes(case, levels, cases[case], path.name),
        )
    )


def _levels(found: Judgement) -> tuple[SavedLevel, ...]:
    return tuple(
        SavedLevel(label=one.label, h=one.h, unknowns=one.unknowns)
        for one in sorted(found.answers, key=lambda one: -one.h)
    )


def _quantity(row: Row) -> JudgedQuantity:
    return JudgedQuantity(
        name=row.quantity,
        run=WHOLE if row.step is None else f"step {row.step}",
        tolerance_kind="required",
        unit="",
        value=None if row.error is None else finite(row.error),
        reference=0.0,
        allowed=row.bound or 0.0,
        status=row.status,
        answer=None if row.value is None else finite(row.value),
        order=None if row.order is None else row.order.interval,
    )


def _quantity_changes(
    case: str, rows: tuple[Row, ...], saved: SavedJudgement, since: str
) -> Iterator[ChangeRow]:
    """Yield the changes of errors, other properties and observed orders of a judged challenge."""
    found = {one.key: (one, row.because) for row in rows for one in [_quantity(row)]}
    known = {one.key: one for one in saved.quantities}
    for key, (now, because) in found.items():
        was = known.get(key)
        change = quantity_change(now, was, NO_ORIGIN)
        remark = change.remark or ("" if now.status is Status.PASS else because)
        text = ABSENT if was is None else _error_text(was)
        size = change.moved or 0.0
        yield ChangeRow(
            case,
            now.name,
            now.run,
            change.kind,
            text,
            _error_text(now),
            moved_text(change),
            since,
            remark,
            size,
        )
        if was and was.order and now.order:
            apart = abs(now.order[0] - was.order[0]) > now.order[1] + was.order[1]
            kind = ChangeKind.DRIFT if apart else ChangeKind.UNCHANGED
            texts = order_text(*was.order), order_text(*now.order)
            yield ChangeRow(case, f"order of {now.name}", now.run, kind, *texts, since=since)
    for key, was in known.items():
        if key not in found:
            yield ChangeRow(
                case,
                was.name,
                was.run,
                ChangeKind.GONE,
                _error_text(was),
                since=since,
                remark="the solver no longer gives it",
            )


def _error_text(one: JudgedQuantity) -> str:
    """Return the relative error of a judged quantity as text; its status if it has no error."""
    return WORDS[one.status] if one.value is None else f"error {plain(one.value, DIGITS)}"


def _level_changes(
    case: str, levels: tuple[SavedLevel, ...], saved: SavedJudgement, since: str
) -> Iterator[ChangeRow]:
    """Yield lost refinement levels, and the change of the number of unknowns of all levels."""
    for now, was in zip_longest(levels, saved.levels):
        if now is None:
            yield ChangeRow(
                case,
                "level",
                was.label,
                ChangeKind.GONE,
                f"h = {was.h:.3g} m",
                since=since,
                remark="call the solver on as many levels as before",
            )
    pairs = [
        (now.unknowns, was.unknowns)
        for now, was in zip(levels, saved.levels, strict=False)
        if now.unknowns is not None and was.unknowns is not None
    ]
    for change in count_change("unknowns", *(sum(pair[i] for pair in pairs) for i in (0, 1))):
        yield count_row(case, "all levels", change, since)
