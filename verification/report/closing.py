"""What a case shows, in sentences made from its numbers: one on the line, two at a sheet's end."""

from __future__ import annotations

from verification.exhibits.numbers import percent, plain
from verification.judging.outcome import FOUND_IN_A_RUN, CaseOutcome, Status, Verdict
from verification.judging.verdict_text import clearance_text, order_text
from verification.solver import Solver

FINENESS = {Solver.CELLS: "cells", Solver.ELEMENTS: "elements", Solver.RADII: "rings"}
BARE = ("1", "dimensionless", "")  # scales that say nothing of an error


def line_of(case: CaseOutcome) -> str:
    """How many verdicts passed, and the one that uses most of what is allowed."""
    total = len(case.verdicts)
    passed = case.count(Status.PASS)
    counted = f"{total} verdicts" if passed == total else f"{passed} of {total} verdicts passed"
    worst = _closest(case)
    return (
        counted
        if worst is None
        else f"{counted}; {_plain_name(worst.name)} uses {clearance_text(worst)} of what is allowed"
    )


def closing_sentences(case: CaseOutcome) -> tuple[str, ...]:
    """How near its numbers come to what is allowed, and what refining or solving took."""
    return tuple(text for text in (_judged(case), _refined(case) or _solved(case)) if text)


def _judged(case: CaseOutcome) -> str:
    """The verdict nearest to its limit, or farthest beyond it."""
    worst = _closest(case)
    total, failed = len(case.verdicts), case.count(Status.FAIL)
    unsure = case.count(Status.INCONCLUSIVE)
    if worst is None:
        return f"{failed} of its {total} verdicts failed, none by a number." if failed else ""
    where = f"{worst.meaning} ({worst.run})"
    if worst.tolerance_kind == "order":
        found = f"{order_text(worst)} where {plain(worst.reference)} is expected"
    else:
        of = "" if worst.scale_name in BARE else f" of {worst.scale_name}"
        found = f"off by {_share(worst.error or 0.0)}{of}"
    size = f"{where}: {found}, {clearance_text(worst)} of what is allowed."
    if failed:
        return f"{failed} of its {total} numbers are not within what is allowed; farthest is {size}"
    judged = total - unsure
    left = f" {unsure} could not be judged." if unsure else ""
    how = "Its one judged number is" if judged == 1 else f"All its {judged} judged numbers are"
    return f"{how} within what is allowed; nearest to its limit is {size}{left}"


def _refined(case: CaseOutcome) -> str:
    """By how much refining made a number better, the one that went farthest."""
    orders = [v for v in case.verdicts if v.order is not None and v.interval is not None]
    if orders:
        best = min(orders, key=lambda v: v.interval or 0.0)
        assert best.order is not None
        others = "" if len(orders) == 1 else f", the sharpest of {len(orders)} orders observed here"
        return (
            f"Over {len(best.order.sizes)} levels of the {best.order.refined} the error of "
            f"{_plain_name(best.order.of)} falls with order {order_text(best)} where "
            f"{plain(best.reference)} is expected{others}."
        )
    followed = [v for v in case.verdicts if v.refined is not None and v.refined.errors[-1] > 0]
    if not followed:
        return ""
    best = max(followed, key=_gain)
    assert best.refined is not None
    first, last = best.refined.errors[0], best.refined.errors[-1]
    if first <= last:
        return ""
    solver = next((run.solver for run in case.runs if run.label in best.runs), Solver.CELLS)
    return (
        f"From {plain(best.refined.per_radius[0], 2)} to {plain(best.refined.per_radius[-1], 2)} "
        f"{FINENESS[solver]} per contact radius the error of {best.meaning} falls from "
        f"{_share(first)} to {_share(last)}."
    )


def _solved(case: CaseOutcome) -> str:
    """What the solves took and left."""
    if not case.runs:
        kinds = sorted({str(v.reference_kind) for v in case.verdicts})
        return f"No contact is solved here: numbers are held against {_listed(kinds)}."
    work = (
        ("convolutions", sum(run.convolutions for run in case.runs)),
        ("factorisations", sum(run.factorizations for run in case.runs)),
    )
    took = " and ".join(f"{count} {name}" for name, count in work if count)
    residuals = [run.largest_residual for run in case.runs if run.largest_residual is not None]
    left = f", with a residual of {plain(max(residuals), 2)} at most" if residuals else ""
    many = "Its solve" if len(case.runs) == 1 else f"Its {len(case.runs)} solves"
    return f"{many} took {took or 'no counted work'}{left}."


def _closest(case: CaseOutcome) -> Verdict | None:
    """The verdict that uses most of what is allowed: a failed one before all others, one on a
    quantity before those on how well it was solved."""
    known = [v for v in case.verdicts if v.clearance is not None]
    for choice in (
        [v for v in known if v.status is Status.FAIL],
        [v for v in known if v.status is Status.PASS and v.name not in FOUND_IN_A_RUN],
    ):
        if choice:
            return max(choice, key=lambda v: v.clearance or 0.0)
    return max(known, key=lambda v: v.clearance or 0.0, default=None)


def _gain(verdict: Verdict) -> float:
    assert verdict.refined is not None
    return verdict.refined.errors[0] / verdict.refined.errors[-1]


def _plain_name(name: str) -> str:
    return name.replace("_", " ")


def _share(part: float) -> str:
    """Hundredths where they read well; else a number."""
    return percent(part) if 1e-4 <= part < 1 else plain(part, 2)


def _listed(words: list[str]) -> str:
    return " and ".join(filter(None, (", ".join(words[:-1]), *words[-1:])))
