"""What an accuracy costs with every method: one table from the many of the study of it."""

from __future__ import annotations

from dataclasses import dataclass

from verification.exhibits.chart import Chart
from verification.exhibits.numbers import EXTRAPOLATED, NOT_REACHED
from verification.exhibits.table import Table
from verification.running.study import Conclusion

TARGET = "0.1 %"
METHOD = "method"  # the first column of a table of cheapest settings
PAPERS_ROUTE = "sampled response, frozen directions"


@dataclass(frozen=True)
class Price:
    """What the target costs for one quantity, by method; only methods that were tried on it."""

    quantity: str
    costs: dict[str, str]

    @property
    def reached(self) -> int:
        """By how many methods."""
        return sum(not cost.startswith((NOT_REACHED, EXTRAPOLATED)) for cost in self.costs.values())


def prices(conclusion: Conclusion) -> tuple[Price, ...]:
    """Of every table of cheapest settings, whose title ends in the quantity after a comma."""
    found = []
    for table in conclusion.tables:
        if table.columns[0] == METHOD and TARGET in table.columns:
            column = table.columns.index(TARGET)
            # Behind the cost stands the setting; that table has it, here it would hide the costs.
            costs = {row[0]: row[column].partition(":")[0] for row in table.rows}
            found.append(Price(table.title.partition(", ")[2], costs))
    return tuple(found)


def price_table(conclusion: Conclusion, unit: str) -> Table | None:
    """Quantities by methods; None where the study has no such tables.

    unit  of the costs, to end the title with; empty where every cost has its unit
    """
    found = prices(conclusion)
    if not found:
        return None
    methods = tuple(dict.fromkeys(method for price in found for method in price.costs))
    return Table(
        title=f"The cheapest setting that reaches {TARGET}{unit}",
        columns=("quantity", *methods),
        rows=tuple(
            (price.quantity, *(price.costs.get(method, "") for method in methods))
            for price in found
        ),
        note=f"{EXTRAPOLATED} where no setting that was tried reaches it, and the cost follows "
        f"from the order of those that were; {NOT_REACHED} where it does not; empty where the "
        "method was not tried. The settings themselves, and those for 10 %, 1 % and 0.01 %, stand "
        "in the study's own tables.",
    )


def telling_chart(conclusion: Conclusion) -> Chart | None:
    """The diagram of the quantity that most methods get to the target, of those that the paper's
    own route was tried on if there are any; else the first one."""
    charts = conclusion.charts
    ranked = sorted(
        prices(conclusion), key=lambda price: (PAPERS_ROUTE not in price.costs, -price.reached)
    )
    for price in ranked:
        for chart in charts:
            if price.reached and chart.title.startswith(price.quantity):
                return chart
    return next(iter(charts), None)
