"""What settings are compared by: counted work, which every run repeats, or the clock's seconds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from verification.cases.outcome import Status
from verification.cases.table import Table
from verification.report.numbers import plain
from verification.studies.running.study import Statement
from verification.studies.work_precision.charts import SERIES
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.point import (
    TARGETS,
    Cost,
    Point,
    cheapest,
    dependable,
    operations,
    seconds,
)

ASKED = 0.001  # what the answer is given for
MILLION = 1e6

# The points of a quantity, by contact and name.
Everything = Mapping[tuple[str, str], tuple[Point, ...]]


@dataclass(frozen=True)
class Price:
    """A cost and how it is written.

    words  what is counted, for a sentence
    note   under every table
    """

    cost: Cost
    scale: float
    unit: str
    words: str
    note: str

    def text(self, point: Point) -> str:
        """What a setting costs."""
        return f"{plain(self.cost(point) / self.scale, 2)} {self.unit}"


WORK = Price(
    operations,
    MILLION,
    "Mop",
    "counted work",
    "Millions of counted operations, the same at every run, set-up of exact coefficients left out, "
    "and the setting; – where no setting that was tried reaches it.",
)
CLOCK = Price(
    seconds,
    1.0,
    "s",
    "CPU time",
    "CPU seconds, and the setting; – where no setting that was tried reaches it.",
)


def statements_in(price: Price, everything: Everything) -> tuple[Statement, ...]:
    """What the accuracy that is asked for costs, quantity by quantity."""
    return tuple(
        Statement(
            claim=f"{quantity_title(*key)} to {percent(ASKED)}",
            outcome=None,
            measured=_cheapest_text(price, dependable(points)),
        )
        for key, points in everything.items()
    )


def answer_in(price: Price, everything: Everything) -> str:
    """For how many quantities that accuracy is reached, by which methods, at which cost."""
    best = [cheapest(dependable(points), ASKED, price.cost) for points in everything.values()]
    reached = [point for point in best if point is not None]
    if not reached:
        return f"No setting that was tried reaches {percent(ASKED)}."
    counts = {name: sum(p.method == name for p in reached) for name in SERIES}
    parts = [f"{name} for {count}" for name, count in counts.items() if count]
    dearest = max(reached, key=price.cost)
    return (
        f"{percent(ASKED)} is reached for {len(reached)} of {len(best)} quantities, in at most "
        f"{price.text(dearest)}; cheapest by {price.words}: {', '.join(parts)}."
    )


def tables_in(price: Price, everything: Everything) -> tuple[Table, ...]:
    """The cheapest setting of every method for every target, a table for every quantity."""
    return tuple(_table(price, key, points) for key, points in everything.items())


def reached(points: Sequence[Point], target: float) -> bool:
    """Whether some setting, and all finer ones of its curve, has an error of at most `target`."""
    return any(point.error <= target for point in dependable(points))


def percent(part: float) -> str:
    """A target."""
    return f"{100 * part:g} %"


def quantity_title(contact: str, quantity: str) -> str:
    """Of a quantity on a contact, for people."""
    problem = CONTACTS[contact]
    return f"{problem.title}: {problem.errors[quantity]}"


def solved(found: int, asked: int) -> Statement:
    """Whether every setting has a record."""
    return Statement(
        claim="every setting is solved",
        outcome=Status.PASS if found == asked else Status.FAIL,
        measured=f"{found} of {asked}",
    )


def _cheapest_text(price: Price, points: Sequence[Point]) -> str:
    best = cheapest(points, ASKED, price.cost)
    if best is None:
        least = min(points, key=lambda p: p.error)
        return f"not reached; the least error is {plain(least.error, 2)} ({least.method})"
    return f"{best.method}, {best.setting}: {price.text(best)}"


def _table(price: Price, key: tuple[str, str], points: Sequence[Point]) -> Table:
    steady = dependable(points)
    names = [*SERIES, *sorted({p.method for p in points} - set(SERIES))]
    rows = [
        (name, *(_cell(price, [p for p in steady if p.method == name], t) for t in TARGETS))
        for name in names
        if any(point.method == name for point in points)
    ]
    return Table(
        title=f"Cheapest setting by {price.words}, {quantity_title(*key)}",
        columns=("method", *(percent(target) for target in TARGETS)),
        rows=tuple(rows),
        note=price.note,
    )


def _cell(price: Price, points: Sequence[Point], target: float) -> str:
    best = cheapest(points, target, price.cost)
    return "–" if best is None else f"{price.text(best)}: {best.setting}"
