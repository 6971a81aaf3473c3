"""What an accuracy costs with every method: one table from the many of the study of it."""

from __future__ import annotations

from statistics import median

from verification.exhibits.chart import Chart
from verification.exhibits.numbers import EXTRAPOLATED, NOT_REACHED, plain
from verification.exhibits.table import NONE, Table
from verification.running.record import StudyRecord
from verification.running.row import value_of
from verification.running.study import Conclusion
from verification.studies.work_precision.price import WORK
from verification.studies.work_precision.price_rows import (
    COST,
    at_target,
    by_quantity,
    cheapest_row,
    cost_text,
    is_reached,
)

TARGET = 0.001
THOUSAND = 1000.0


def price_table(conclusion: Conclusion, unit: str) -> Table | None:
    """Quantities by methods; None where the study has no prices.

    unit  of the costs, to end the title with; empty where every cost has its unit
    """
    rows = at_target(conclusion.rows, TARGET)
    if not rows:
        return None
    methods = tuple(dict.fromkeys(str(row.parameters["method"]) for row in rows))
    costs = {title: {row.parameters["method"]: cost_text(row) for row in prices}
             for title, prices in by_quantity(rows)}  # fmt: skip
    return Table(
        title=f"The cheapest setting that reaches {100 * TARGET:g} %{unit}",
        columns=("quantity", *methods),
        rows=tuple((title, *(of.get(name, "") for name in methods)) for title, of in costs.items()),
        note=f"{EXTRAPOLATED} where no setting that was tried reaches it, and the cost follows "
        f"from the order of those that were; {NOT_REACHED} where it does not; empty where the "
        "method was not tried. The settings themselves, and those for 10 %, 1 % and 0.01 %, stand "
        "in the study's own tables.",
        units=dict.fromkeys(methods, "s") if unit else NONE,
    )


def telling_chart(conclusion: Conclusion) -> Chart | None:
    """The diagram of the quantity that most methods get to the target; else the first one."""
    by_name = {chart.name: chart for chart in conclusion.charts}
    ranked = []
    for _, prices in by_quantity(at_target(conclusion.rows, TARGET)):
        reached, chart = sum(map(is_reached, prices)), str(prices[0].parameters["chart"])
        if reached and chart in by_name:
            ranked.append((reached, by_name[chart]))
    best = max(ranked, key=lambda pair: pair[0], default=None)
    return next(iter(conclusion.charts), None) if best is None else best[1]


def cost_sentence(record: StudyRecord) -> str:
    """For how many quantities the target is reached and what the cheapest setting takes, by counted
    work and by the clock if it was looked at; empty where the study has no prices."""
    counted = _spans(record.conclusion)
    if not counted:
        return ""
    timed = record.provenance.timed
    clock = "" if timed is None else _spans(timed)
    told = f"{counted}; by the clock, {clock.partition(': ')[2]}" if clock else counted
    return f"{told} (level {record.level})"


def _spans(conclusion: Conclusion) -> str:
    """Quantities that are had to the target, with the median and the largest of the least costs."""
    quantities = list(by_quantity(at_target(conclusion.rows, TARGET)))
    best = [row for _, rows in quantities if (row := cheapest_row(rows)) is not None]
    if not best:
        return ""
    costs = [value_of(row, COST) for row in best]
    unit = best[0].units[COST]
    return (
        f"an error of {100 * TARGET:g} % is had for {len(best)} of {len(quantities)} quantities: "
        f"{amount(median(costs), unit)} in the median, {amount(max(costs), unit)} at most"
    )


def amount(cost: float, unit: str) -> str:
    """A cost in a sentence: `138 million operations`, `0.16 s`."""
    if unit != WORK.unit:
        return f"{plain(cost, 2)} {unit}"
    many, word = (THOUSAND, "billion") if cost >= THOUSAND else (1.0, "million")
    return f"{plain(cost / many, 3)} {word} operations"
