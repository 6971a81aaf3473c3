"""HTML page of the judgement of a code on a challenge.

The page shows verdicts, refinement levels, and errors against element size and computing time.
"""

from __future__ import annotations

from verification.challenge.judgement import WHOLE, Judgement, Row, order_text
from verification.convergence.observed_order import ILLEGIBLE
from verification.exhibits.chart import NONE, Chart, Table, drawable, log_chart, point_curves
from verification.judging.outcome import SYMBOLS, WORDS
from verification.report.page import environment

COLUMNS = ("quantity", "step", "level", "verdict", "error", "bound", "class", "order", "because")
MAX_CURVES = 8


def row_texts(row: Row) -> tuple[str, ...]:
    """Return the table cells of a verdict: quantity, load step, level, status, error, bound and
    others.

    row  verdict on one quantity of an answer to a challenge
    """
    return (
        row.quantity,
        WHOLE if row.step is None else str(row.step),
        row.level,
        f"{SYMBOLS[row.status]} {WORDS[row.status]}",
        WHOLE if row.error is None else f"{row.error:.2e}",
        WHOLE if row.bound is None else f"{row.bound:.3g}",
        row.grade or WHOLE,
        WHOLE if row.order is None else order_text(row.order),
        row.because,
    )


def render_sheet(judgement: Judgement) -> str:
    """Render the judgement of a code on a challenge as a self-contained HTML page without
    scripts."""
    page = environment().get_template("judgement.html")
    return page.render(
        judgement=judgement, tables=(_verdict_table(judgement), _level_table(judgement)),
        charts=tuple(_error_charts(judgement)),
    )  # fmt: skip


def _verdict_table(judgement: Judgement) -> Table:
    return Table(
        title="Verdicts",
        columns=COLUMNS,
        rows=tuple(map(row_texts, judgement.rows)),
        note="On the finest level. Classes: A 1e-4, B 1e-3, C 1e-2 of what the error is divided "
        "by; a pass keeps clear of twice the uncertainty of the reference. An order is not known "
        f"where its 95 % interval is ± {ILLEGIBLE:g} or wider; more levels narrow it.",
        units=NONE,
    )


def _level_table(judgement: Judgement) -> Table:
    rows = (
        (one.label, f"{one.h:.4g}", str(one.unknowns or WHOLE),
         WHOLE if one.seconds is None else f"{one.seconds:.3g}")
        for one in judgement.answers
    )  # fmt: skip
    return Table(
        title="Levels",
        columns=("level", "h", "unknowns", "CPU time"),
        rows=tuple(rows),
        units={"h": "m", "CPU time": "s"},
    )


def _error_charts(judgement: Judgement) -> list[Chart]:
    """Return charts of the largest errors of a code against element size and against CPU time.

    A chart is left out if no quantity has errors at two levels.
    """
    fallen = [row for row in judgement.rows if len(row.errors) > 1]
    fallen.sort(key=lambda row: -(row.error or 0.0))
    seconds = {one.h: one.seconds for one in judgement.answers}
    of = "Of the numbers and fields with the largest errors, each over its scale, against"
    charts = []
    for name, title, against, label, by_h in (
        ("errors", "Errors by fineness", "the size h of a cell or element.", "h [m]", None),
        ("cost", "Errors by cost", "the CPU time of the level.", "CPU time [s]", seconds),
    ):
        lines = [
            (f"{r.quantity}, step {r.step}",
             drawable((h if by_h is None else by_h.get(h), e) for h, e in r.errors))
            for r in fallen[:MAX_CURVES]
        ]  # fmt: skip
        if any(len(points) > 1 for _, points in lines):
            caption = f"{of} {against}"
            charts.append(log_chart(name, title, caption, label, "error", point_curves(lines)))
    return charts
