"""HTML pages of a verification report, of a study and of the judgement of a code on a challenge.

The pages need neither network nor scripts.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from functools import cache

import jinja2
from markupsafe import Markup

from verification.cases.catalogue import MODULE_OF
from verification.challenge.python_api import WHOLE, Judgement, Row
from verification.convergence.observed_order import ILLEGIBLE, order_text
from verification.exhibits.chart import (
    NONE,
    Chart,
    Table,
    drawable,
    log_chart,
    plain,
    point_curves,
    value_text,
)
from verification.judging.outcome import (
    SYMBOLS,
    WORDS,
    CaseOutcome,
    Status,
    clearance_text,
    error_text,
    failure_text,
    uncertainty_text,
    verdict_order_text,
)
from verification.regression.change_row import Comparison, change_table
from verification.report.drawing import inline_svg
from verification.report.file_names import PAGE, SHEETS
from verification.report.summary_text import (
    change_counts,
    changes_text,
    claims_line,
    counts_text,
    features,
    moved_rows,
    nearest_to_limit,
    origins,
    study_section,
    uncovered_errors,
    without_baseline,
    worse_rows,
)
from verification.report.validity import validity_table
from verification.running.report_record import Report
from verification.running.study import StudyRecord, measured_text

MAX_WORSE = 6  # on the front; the rest stands below
MAX_MOVED = 40
# of a study and of a table on a page of the quick level
MAX_CHARTS = 2
MAX_ROWS = 40
SEVERAL = 2  # cases whose equal references and reasons are printed once
WORDS_FROM = 30  # characters of a cell that make its column one of words
DIGITS = frozenset("0123456789")
EXPONENT = re.compile(r"(?<=\d)e[+−-]?\d+")
NUMBER = "number"  # class of the style sheet; "words" for the other columns


def render_page(report: Report) -> str:
    """Render the first page of a verification report as HTML. Equal reports give equal text."""
    return _render_template("page.html", report=report, brief=report.level == "quick")


def render_sheets(report: Report) -> str:
    """Render the page of a verification report with one section (sheet) per case as HTML."""
    return _render_template("sheets.html", report=report, brief=report.level == "quick")


def render_study(record: StudyRecord) -> str:
    """Render the page of a study as HTML from the record of the study."""
    return _render_template("study.html", study=record, brief=False)


def _render_template(template: str, **shown: object) -> str:
    return environment().get_template(template).render(**shown)


@cache
def environment() -> jinja2.Environment:
    """Return the Jinja environment with the templates, filters and functions of all HTML pages."""
    made = jinja2.Environment(
        loader=jinja2.PackageLoader("verification.report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters.update(
        value=value_text,
        plain=plain,
        clearance=clearance_text,
        error=error_text,
        order=verdict_order_text,
        uncertainty=uncertainty_text,
        failure=failure_text,
        svg=lambda chart, prefix="": Markup(inline_svg(chart, prefix)),  # nosec B704: escaped there
    )
    shared = (
        alignment,
        heading,
        cases_by_physics,
        line_of,
        reasons_of,
        shared_reasons,
        study_section,
        measured_text,
        features,
        counts_text,
        claims_line,
        change_counts,
        changes_text,
        moved_rows,
        origins,
        uncovered_errors,
        validity_table,
        without_baseline,
        worse_rows,
    )
    made.globals.update({one.__name__: one for one in shared})
    made.globals.update(
        Status=Status,
        symbols=SYMBOLS,
        words=WORDS,
        PAGE=PAGE,
        SHEETS=SHEETS,
        MAX_WORSE=MAX_WORSE,
        MAX_MOVED=MAX_MOVED,
        MAX_CHARTS=MAX_CHARTS,
        MAX_ROWS=MAX_ROWS,
    )
    return made


def cases_by_physics(cases: Sequence[CaseOutcome]) -> dict[str, list[CaseOutcome]]:
    """Group verification cases by their physics, such as "torsion" or "line contacts".

    The physics is the name of the module that declares a case; a case that the catalogue lacks is a
    group of its own. Groups are in the order of the report. The cases of a group are sorted by the
    share of the tolerance that they use, with failed cases first.
    """
    groups: dict[str, list[CaseOutcome]] = {}
    for case in cases:
        groups.setdefault(MODULE_OF.get(case.name, case.name).replace("_", " "), []).append(case)
    for group in groups.values():
        group.sort(key=_share_used, reverse=True)
    return groups


def _share_used(case: CaseOutcome) -> tuple[bool, float]:
    """Return the key by which cases are sorted: failed cases, then the share of the tolerance."""
    worst = nearest_to_limit(case)
    return case.status is Status.FAIL, 0.0 if worst is None else worst.clearance or 0.0


def line_of(case: CaseOutcome) -> str:
    """Describe a verification case in one line: passed verdicts, and the verdict nearest to its
    limit.

    For the second part, a failed verdict has priority, and a verdict on a quantity has priority
    over one on residuals.
    """
    total, passed = len(case.verdicts), case.count(Status.PASS)
    counted = f"{total} verdicts" if passed == total else f"{passed} of {total} verdicts passed"
    worst = nearest_to_limit(case)
    if worst is None:
        return counted
    name = worst.name.replace("_", " ")
    return f"{counted}; {name} uses {clearance_text(worst)} of what is allowed"


def shared_reasons(cases: Sequence[CaseOutcome]) -> dict[str, list[str]]:
    """Return the texts on references and tolerances that at least two verification cases share.

    A page prints these texts once. The values are the names of the verdicts with the text.
    """
    found = [reasons_of(case) for case in cases]
    times = Counter(text for reasons in found for text in reasons)
    return {
        text: list(dict.fromkeys(name for reasons in found for name in reasons.get(text, ())))
        for text, count in times.items()
        if count >= SEVERAL
    }


def reasons_of(case: CaseOutcome) -> dict[str, list[str]]:
    """Return the texts on the references and tolerances of a verification case.

    The values are the names of the verdicts to which a text applies.
    """
    found: dict[str, list[str]] = {}
    for v in case.verdicts:
        for text in (
            f"Reference: {v.reference_kind}; {v.source}.",
            f"Tolerance {v.tolerance_kind}, relative to {v.scale_name}: {v.because}.",
        ):
            names = found.setdefault(text, [])
            if v.name not in names:
                names.append(v.name)
    return found


def alignment(table: Table, column: int) -> str:
    """Return the style class of a table column of a page: "number" for short cells with digits,
    else "words".

    Numbers are aligned right.

    column  index of the column
    """
    cells = [row[column] for row in table.rows if len(row) > column]
    with_digits = all(DIGITS & set(cell) or len(cell) < 2 for cell in cells)  # – is no word
    short = max(map(len, cells), default=0) < WORDS_FROM
    return NUMBER if with_digits and short else "words"


def heading(table: Table, column: int) -> str:
    """Return the heading of a table column of a page, with the unit of its numbers in brackets.

    The unit is left out if the cells name units themselves.

    column  index of the column
    """
    head = table.columns[column]
    if table.units is None or column == 0 or alignment(table, column) != NUMBER:
        return head
    cells = [EXPONENT.sub("", row[column]) for row in table.rows if len(row) > column]
    bare = not any(sign.isalpha() or sign == "%" for cell in cells for sign in cell)
    unit = table.units.get(head, "–" if bare else "")
    return f"{head} [{unit}]" if unit else head


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
        WHOLE if row.order is None else order_text(*row.order.interval),
        row.because,
    )


def render_sheet(judgement: Judgement, comparison: Comparison | None = None) -> str:
    """Render the judgement of a code on a challenge as a self-contained HTML page without
    scripts.

    comparison  comparison with a saved judgement of the code, or None
    """
    page = environment().get_template("judgement.html")
    changes = (_change_table(comparison),) if comparison and comparison.rows else ()
    return page.render(
        judgement=judgement,
        comparison=comparison,
        tables=(*changes, _verdict_table(judgement), _level_table(judgement)),
        charts=tuple(_error_charts(judgement)),
    )


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


def _change_table(comparison: Comparison) -> Table:
    columns, rows = change_table(comparison.rows)
    return Table(
        title="Changes since the saved judgement, the worst first",
        columns=columns,
        rows=rows,
        note="Outside: the error exceeds its bound. Dearer: more unknowns. Gone: no longer given. "
        "Drift: another difference. U: the bound of the error.",
        units=NONE,
    )


def _level_table(judgement: Judgement) -> Table:
    rows = (
        (
            one.label,
            f"{one.h:.4g}",
            str(one.unknowns or WHOLE),
            WHOLE if one.seconds is None else f"{one.seconds:.3g}",
        )
        for one in judgement.answers
    )
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
    many = "the numbers and fields with the largest errors, each over its scale,"
    charts = []
    for name, title, against, label, by_h in (
        ("errors", "Errors by fineness", "the size h of a cell or element.", "h [m]", None),
        ("cost", "Errors by cost", "the CPU time of the level.", "CPU time [s]", seconds),
    ):
        lines = [
            (
                f"{r.quantity}, step {r.step}",
                drawable((h if by_h is None else by_h.get(h), e) for h, e in r.errors),
            )
            for r in fallen[:MAX_CURVES]
        ]
        if any(len(points) > 1 for _, points in lines):
            drawn = [quantity for quantity, points in lines if points]
            of = many if len(drawn) > 1 else f"{drawn[0]}, over its scale,"  # without a legend
            caption = f"Of {of} against {against}"
            charts.append(log_chart(name, title, caption, label, "error", point_curves(lines)))
    return charts
