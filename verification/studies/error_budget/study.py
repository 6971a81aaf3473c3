"""The study of error budgets."""

from __future__ import annotations

from collections.abc import Sequence

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.judging.outcome import Status
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.error_budget.budget import (
    BOX,
    BUDGETS,
    FINER,
    PENALTY,
    STIFFER,
    TIGHTER,
    TOLERANCE,
    Budget,
    Found,
    Parts,
    parts_of,
)
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.points import setting_text
from verification.studies.work_precision.setting import Measured, PrecisionCase

TOTAL = "total error"
NEGLIGIBLE = 0.01  # part of the error that the solver's tolerance may have
FLOOR = 1e-9  # parts below it are drawn at it: nothing that anybody asks for is so small
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
    found: Found = {
        case: record
        for case in cases(settings)
        if isinstance(record := records.get(case.name), Measured)
    }
    shown = {b: parts for b in BUDGETS if (parts := parts_of(b, settings.level, found))}
    worst = max(
        (
            (part.parts[TOLERANCE] / max(part.total, ROUND_OFF), budget.case, part.quantity)
            for budget, parts in shown.items()
            for part in parts
            if TOLERANCE in part.parts
        ),
        default=None,
    )
    return Conclusion(
        statements=(
            Statement(
                claim="every choice is refined in every case",
                outcome=Status.PASS if len(found) == len(cases(settings)) else Status.FAIL,
                measured=f"{len(found)} of {len(cases(settings))} solves",
            ),
            Statement(
                claim="the solver's tolerance is no part of any error",
                outcome=Status.PASS if worst and worst[0] <= NEGLIGIBLE else Status.FAIL,
                measured="no case"
                if worst is None
                else f"at most {100 * worst[0]:.2g} % of it, in {worst[1]}: {worst[2]}",
                because=f"allowed {100 * NEGLIGIBLE:g} %; errors below {ROUND_OFF:g} count as that",
            ),
            *(
                Statement(
                    claim=f"{budget.case}: what most of the error comes from",
                    outcome=None,
                    measured="; ".join(f"{p.quantity}: {p.largest}" for p in parts if p.parts),
                )
                for budget, parts in shown.items()
            ),
        ),
        tables=tuple(_table(budget, settings, parts) for budget, parts in shown.items()),
        charts=tuple(chart(budget, parts) for budget, parts in shown.items()),
        remarks=REMARKS,
    )


def chart(budget: Budget, parts: Sequence[Parts]) -> Chart:
    """The parts of every quantity under one another, the total at the bottom."""
    rows = (TOTAL, *reversed(list(parts[0].parts)))  # from below
    curves = []
    for series, part in enumerate(parts):
        values = {**part.parts, TOTAL: part.total}
        places = [row for row, name in enumerate(rows) if name in values]
        curves.append(
            curve(
                part.quantity,
                [max(values[rows[row]], FLOOR) for row in places],
                [row + APART * (len(parts) // 2 - series) for row in places],
                Look.TILES,
                series,
            )
        )
    panel = Panel(
        x_label="part of the relative error",
        y_label="",
        y_places=rows,
        curves=tuple(curves),
        logarithmic=True,
        height=1.9,
    )
    return Chart(
        name=f"budget_{budget.case}",
        title=f"Error budget, {budget.title}",
        caption="By how much the error changes when one choice alone is refined, and the whole "
        f"error; changes below {FLOOR:g} are drawn there. "
        + "; ".join(f"{name}: {words}" for name, words in CONTACTS[budget.contact].errors.items())
        + ".",
        rows=((panel,),),
    )


def _table(budget: Budget, settings: Settings, parts: Sequence[Parts]) -> Table:
    names = tuple(parts[0].parts)
    return Table(
        title=f"{budget.case}: parts of the error, {setting_text(budget.base(settings.level))}",
        columns=("quantity", TOTAL, *names),
        rows=tuple(
            (
                CONTACTS[budget.contact].errors[part.quantity],
                plain(part.total, 2),
                *(plain(part.parts[name], 2) for name in names),
            )
            for part in parts
        ),
    )


STUDY = Study(
    name="error-budget",
    title="Where the error of the headline cases comes from",
    question="How much of the error of a case is due to the mesh, the increments, the penalty, the "
    "truncated domain and the solver's tolerance?",
    cases=cases,
    conclude=conclude,
)
