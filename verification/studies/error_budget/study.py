"""The study of error budgets."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from verification.exhibits.chart import Chart, Look, curve
from verification.exhibits.log_chart import log_chart
from verification.exhibits.table import Table, table_of
from verification.running.row import Row, found, value_of
from verification.running.row_views import Text, number
from verification.running.rules import judged, solved
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.error_budget.budget import (
    BOX,
    BUDGETS,
    FINER,
    PENALTY,
    STIFFER,
    TIGHTER,
    TOLERANCE,
    TOTAL,
    Budget,
    parts_of,
)
from verification.studies.work_precision.setting import PrecisionCase

NEGLIGIBLE = 0.01  # part of the error that the solver's tolerance may have
FLOOR = 1e-9  # parts below it are drawn at it: nothing that anybody asks for is so small
HEIGHT = 1.9
APART = 0.18  # quantities of one row, of its height
ROUND_OFF = 1e-7  # below this an error is the reference's own
REMARKS = (
    f"A part is the change of the error when one choice is refined: {FINER:g} times as many cells "
    f"or elements along a length, {FINER:g} times as many increments, springs {STIFFER:g} times as "
    f"stiff as c = {PENALTY:g}, a section {FINER:g} times as large as {BOX:g} contact radii, a "
    f"window {FINER:g} times as large with cells of the same side, a tolerance {TIGHTER:g} times "
    "as large.",
    "Parts have signs, and a refinement by two takes off only part of a choice's error: their sum "
    "is not the total. Where an error of order p falls by refinement, 1 − 2⁻ᵖ of it is shown.",
    "Of a field the change of its error norm is taken.",
    "The penalty's stiffness follows the mesh, so that its part falls with the mesh's.",
)


def cases(settings: Settings) -> tuple[PrecisionCase, ...]:
    """All solves, each once."""
    return tuple(dict.fromkeys(c for budget in BUDGETS for c in budget.cases(settings.level)))


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Statements, and a table and a chart for every case."""
    asked = cases(settings)
    known = found(asked, records)
    shown = {b: parts for b in BUDGETS if (parts := parts_of(b, settings.level, known))}
    rows = tuple(row for parts in shown.values() for row in parts)
    return Conclusion(
        statements=(
            solved("every choice is refined in every case", len(known), len(asked), "solves"),
            _tolerance_is_no_part(rows),
            *(_largest_parts(budget.case, parts) for budget, parts in shown.items()),
        ),
        tables=tuple(_table(budget, settings, parts) for budget, parts in shown.items()),
        charts=tuple(chart(budget, parts) for budget, parts in shown.items()),
        rows=rows,
        remarks=REMARKS,
    )


def _tolerance_is_no_part(rows: Iterable[Row]) -> Statement:
    parts = [
        (value_of(row, TOLERANCE) / max(value_of(row, TOTAL), ROUND_OFF), row)
        for row in rows
        if TOLERANCE in row.measures
    ]
    part, row = max(parts, key=lambda pair: pair[0], default=(math.inf, None))
    return Statement(
        claim="the solver's tolerance is no part of any error",
        outcome=judged(part <= NEGLIGIBLE),
        measured="no case"
        if row is None
        else f"at most {100 * part:.2g} % of it, in {row.parameters['case']}: "
        f"{row.parameters['quantity']}",
        because=f"allowed {100 * NEGLIGIBLE:g} %; errors below {ROUND_OFF:g} count as that",
        about=row,
    )


def _largest_parts(case: str, parts: Iterable[Row]) -> Statement:
    known = ((row.parameters["quantity"], row.words.get("largest")) for row in parts)
    return Statement(
        claim=f"{case}: what most of the error comes from",
        outcome=None,
        measured="; ".join(f"{quantity}: {part}" for quantity, part in known if part),
    )


def chart(budget: Budget, parts: Sequence[Row]) -> Chart:
    """The parts of every quantity under one another, the total at the bottom."""
    total, *choices = parts[0].measures
    places = (total, *reversed(choices))  # from below
    curves = [
        curve(
            str(part.parameters["quantity"]),
            [max(value_of(part, name), FLOOR) for name in places],
            [place + APART * (len(parts) // 2 - series) for place in range(len(places))],
            Look.TILES,
            series,
        )
        for series, part in enumerate(parts)
    ]
    return log_chart(
        f"budget_{budget.case}",
        f"Error budget, {budget.title}",
        "By how much the error changes when one choice alone is refined, and the whole error; "
        f"changes below {FLOOR:g} are drawn there. "
        + "; ".join("{quantity}: {meaning}".format(**part.parameters) for part in parts)
        + ".",
        "part of the relative error",
        "",
        curves,
        height=HEIGHT,
        y_places=places,
    )


def _table(budget: Budget, settings: Settings, parts: Sequence[Row]) -> Table:
    columns: dict[str, Text] = {"quantity": lambda row: str(row.parameters["meaning"])}
    return table_of(
        f"{budget.case}: parts of the error, {budget.base(settings.level).text}",
        columns | {name: number(name) for name in parts[0].measures},
        parts,
    )


STUDY = Study(
    name="error-budget",
    title="Where the error of the headline cases comes from",
    question="How much of the error of a case is due to the mesh, the increments, the penalty, the "
    "truncated domain and the solver's tolerance?",
    cases=cases,
    conclude=conclude,
)
