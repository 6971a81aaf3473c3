"""What settings are compared by: counted work, which every run repeats, or the clock's seconds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from verification.exhibits.numbers import EXTRAPOLATED, plain
from verification.exhibits.table import NONE, Table
from verification.running.row import Row, value_of
from verification.running.study import Statement
from verification.studies.work_precision.charts import SERIES, methods_of
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.point import (
    TARGETS,
    Cost,
    Point,
    beyond,
    cheapest,
    dependable,
    operations,
    seconds,
)
from verification.studies.work_precision.price_rows import (
    COST,
    ERROR,
    LEAST,
    Reached,
    at_target,
    by_quantity,
    cheapest_row,
    cost_text,
    is_reached,
    setting_and_cost,
)
from verification.studies.work_precision.recorded_peers import OTHERS

ASKED = 0.001  # what the answer is given for
MILLION = 1e6
NOTE = (
    "– where no setting that was tried reaches it, and none can be extrapolated; {mark} where none "
    "reaches it and the cost follows from the order in which the last errors of a curve fell."
)

# The points of a quantity, by contact and name.
Everything = Mapping[tuple[str, str], tuple[Point, ...]]


@dataclass(frozen=True)
class Price:
    """A cost and how it is written.

    chart  beginning of the names of its diagrams
    words  what is counted, for a sentence
    note   under every table
    """

    cost: Cost
    scale: float
    unit: str
    chart: str
    words: str
    note: str


WORK = Price(
    operations,
    MILLION,
    "Mop",
    "counted",
    "counted work",
    "Millions of counted operations, the same at every run, set-up of exact coefficients left out, "
    "and the setting; " + NOTE.format(mark=EXTRAPOLATED),
)
CLOCK = Price(
    seconds,
    1.0,
    "s",
    "precision",
    "CPU time",
    "CPU seconds, and the setting; " + NOTE.format(mark=EXTRAPOLATED) + " The codes of the last "
    "rows were run in turn with our own, at another time than the rest: compare them with that.",
)


def price_rows(price: Price, everything: Everything) -> tuple[Row, ...]:
    """What every target costs with every method, quantity by quantity."""
    return tuple(
        _row(price, key, target, [p for p in steady if p.method == method])
        for key, points in everything.items()
        for steady in (dependable(points),)
        for method in methods_of(steady)
        for target in TARGETS
    )


def _row(price: Price, key: tuple[str, str], target: float, points: Sequence[Point]) -> Row:
    """Of one method, whose points are dependable."""
    contact, quantity = key
    best, further = cheapest(points, target, price.cost), beyond(points, target, price.cost)
    measures: dict[str, float | None] = {COST: None, LEAST: min(p.error for p in points)}
    words = {"reached": Reached.NOT.value}
    if best is not None:
        measures |= {COST: price.cost(best) / price.scale, ERROR: best.error}
        words = {"reached": Reached.TRIED.value, "setting": best.setting}
        words |= {"code": best.curve} if best.method == OTHERS else {}
    elif further is not None:
        measures |= {COST: further.cost / price.scale, "order": further.order}
        setting = (
            f"extrapolated to {further.fineness:.0f} cells or elements "
            f"by order {plain(further.order, 2)}"
        )
        words = {"reached": Reached.BEYOND.value, "setting": setting}
    return Row(
        parameters={
            "contact": contact,
            "quantity": quantity,
            "title": quantity_title(*key),
            "method": points[0].method,
            "target": target,
            "chart": f"{price.chart}_{contact}_{quantity}",
        },
        measures=measures,
        units={COST: price.unit},
        words=words,
    )


def statements_in(rows: Iterable[Row]) -> tuple[Statement, ...]:
    """What the accuracy that is asked for costs, quantity by quantity."""
    statements = []
    for title, prices in by_quantity(at_target(rows, ASKED)):
        best = cheapest_row(prices)
        statements.append(
            Statement(
                claim=f"{title} to {percent(ASKED)}",
                outcome=None,
                measured=_not_reached(prices)
                if best is None
                else f"{best.parameters['method']}, {best.words['setting']}: {cost_text(best)}",
                about=best or _nearest(prices),
            )
        )
    return tuple(statements)


def _nearest(prices: Sequence[Row]) -> Row:
    return min(prices, key=lambda row: value_of(row, LEAST))


def _not_reached(prices: Sequence[Row]) -> str:
    nearest, further = _nearest(prices), cheapest_row(prices, Reached.BEYOND)
    text = (
        f"not reached; the least error is {plain(nearest.measures[LEAST], 2)} "
        f"({nearest.parameters['method']})"
    )
    return text if further is None else f"{text}; {setting_and_cost(further)}"


def answer_in(price: Price, rows: Sequence[Row]) -> str:
    """For how many quantities that accuracy is reached, by which methods, at which cost."""
    asked = at_target(rows, ASKED)
    best = [cheapest_row(prices) for _, prices in by_quantity(asked)]
    settings = [row for row in best if row is not None]
    if not settings:
        return f"No setting that was tried reaches {percent(ASKED)}."
    dearest = max(settings, key=lambda row: value_of(row, COST))
    counts = Counter(row.parameters["method"] for row in settings)
    tried = Counter(row.parameters["method"] for row in asked)
    good = Counter(row.parameters["method"] for row in asked if is_reached(row))
    return (
        f"{percent(ASKED)} is reached for {len(settings)} of {len(best)} quantities, in at most "
        f"{cost_text(dearest)}; cheapest of ours by {price.words}: "
        f"{'; '.join(f'{name} for {counts[name]}' for name in SERIES if counts[name])}. "
        "By method, of the quantities that it was tried on: "
        f"{'; '.join(f'{n}: {good[n]} of {tried[n]}' for n in SERIES if tried[n])}."
    )


def tables_in(price: Price, rows: Iterable[Row]) -> tuple[Table, ...]:
    """The cheapest setting of every method for every target, a table for every quantity."""
    return tuple(
        Table(
            title=f"Cheapest setting by {price.words}, {title}",
            columns=("method", *(percent(target) for target in TARGETS)),
            rows=tuple(
                (str(method), *map(setting_and_cost, costs))
                for method, costs in groupby(prices, lambda row: row.parameters["method"])
            ),
            note=price.note,
            units=NONE,
        )
        for title, prices in by_quantity(rows)
    )


def reached(points: Sequence[Point], target: float) -> bool:
    """Whether some setting, and all finer ones of its curve, has an error of at most `target`."""
    return any(point.error <= target for point in dependable(points))


def percent(part: float) -> str:
    """A target."""
    return f"{100 * part:g} %"


def quantity_title(contact: str, quantity: str) -> str:
    """Of a quantity on a contact, for people."""
    return CONTACTS[contact].meaning(quantity)
