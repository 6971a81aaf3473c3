"""The pages, a front and the sheets of the cases: neither needs network or scripts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import cache

import jinja2

from verification.exhibits.chart import Chart
from verification.exhibits.numbers import plain, value_text
from verification.exhibits.table import Table
from verification.judging.outcome import CaseOutcome, Status, Verdict
from verification.judging.verdict_text import (
    clearance_text,
    failure_text,
    order_text,
    uncertainty_text,
)
from verification.report.answers import answers
from verification.report.both_solvers import (
    both_solvers_charts,
    furthest_apart,
    shared_references,
)
from verification.report.changes import (
    change_counts,
    changes_text,
    moved_rows,
    origins,
    without_baseline,
    worse_rows,
)
from verification.report.closing import closing_sentences, line_of
from verification.report.counts import counts_text
from verification.report.extent import extent
from verification.report.features import claims_line, features
from verification.report.files import PAGE, SHEETS
from verification.report.front import front_charts
from verification.report.order_table import not_judged
from verification.report.orders import observed_orders
from verification.report.profiles_together import profiles_together
from verification.report.sections import study_section
from verification.report.shared_styles import with_shared_styles
from verification.report.stability_map import legend, stability_map
from verification.report.svg import image_address
from verification.report.templating import environment
from verification.running.report_record import Report
from verification.running.study_text import measured_text

PAPER_CASE = "paper_fretting_loop"  # which makes the paper's figures 1 and 2
MOST_WORSE = 6  # on the front; the rest stands below
SEVERAL = 2  # cases whose equal references and reasons are printed once
MOST_MOVED = 40


def render_page(report: Report) -> str:
    """The front as HTML; equal records give equal text."""
    return _rendered("page.html", report)


def render_sheets(report: Report) -> str:
    """One sheet per case, in the order of the record."""
    return _rendered("sheets.html", report)


def _rendered(template: str, report: Report) -> str:
    return with_shared_styles(_environment().get_template(template).render(report=report))


@cache
def _environment() -> jinja2.Environment:
    made = environment()
    made.filters.update(
        value=value_text, plain=plain, clearance=clearance_text, order=order_text,
        uncertainty=uncertainty_text, failure=failure_text,
        address=image_address,
    )  # fmt: skip
    made.globals.update(
        Status=Status,
        MOST_WORSE=MOST_WORSE,
        PAGE=PAGE,
        SHEETS=SHEETS,
        PAPER_CASE=PAPER_CASE,
        MOST_MOVED=MOST_MOVED,
        bar=_bar,
        kinds=_kinds,
        references=_references,
        common=_common,
        answers=answers,
        study_section=study_section,
        measured_text=measured_text,
        features=features,
        observed_orders=observed_orders,
        not_judged=not_judged,
        both_solvers=_both_solvers,
        extent=extent,
        inconclusive=_inconclusive,
        counts_text=counts_text,
        front_charts=front_charts,
        stability_map=stability_map,
        map_legend=legend,
        line_of=line_of,
        closing_sentences=closing_sentences,
        claims_line=claims_line,
    )
    made.globals.update(
        change_counts=change_counts,
        changes_text=changes_text,
        moved_rows=moved_rows,
        origins=origins,
        without_baseline=without_baseline,
        worse_rows=worse_rows,
    )
    return made


def _bar(verdict: Verdict) -> int:
    """Length of the bar of a verdict in per cent; full from the allowed error on."""
    part = verdict.clearance
    return 100 if part is None else round(min(100.0, 100 * part))


def _kinds(report: Report) -> dict[str, dict[Status, int]]:
    """Verdicts by what they judge, and how they ended."""
    verdicts = [verdict for case in report.cases for verdict in case.verdicts]
    kinds = {
        "against a reference": [v for v in verdicts if v.tolerance_kind != "order"],
        "order of convergence": [v for v in verdicts if v.tolerance_kind == "order"],
    }
    return {
        kind: {status: sum(v.status is status for v in of) for status in Status}
        for kind, of in kinds.items()
    }


def _both_solvers(report: Report) -> tuple[tuple[Chart, ...], Table] | None:
    """Profiles and errors of both solvers against the same references, where there are such."""
    shared = shared_references(report)
    charts = (*profiles_together(report), *both_solvers_charts(shared))
    return (charts, furthest_apart(shared)) if shared else None


def _inconclusive(report: Report) -> list[tuple[CaseOutcome, Verdict]]:
    """Verdicts that are neither passed nor failed, with their cases."""
    return [
        (case, verdict)
        for case in report.cases
        for verdict in case.verdicts
        if verdict.status is Status.INCONCLUSIVE
    ]


def _common(cases: Sequence[CaseOutcome]) -> dict[str, list[str]]:
    """References and reasons that several cases share, with their verdicts."""
    named: dict[str, list[str]] = {}
    times = Counter(text for case in cases for text in _references(case))
    for case in cases:
        named.update(_references(case))
    return {text: named[text] for text, count in times.items() if count >= SEVERAL}


def _references(case: CaseOutcome) -> dict[str, list[str]]:
    """Return each source of a reference and each reason of a tolerance, with its verdicts."""
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
