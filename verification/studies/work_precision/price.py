"""What settings are compared by: counted work, which every run repeats, or the clock's seconds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from verification.exhibits.numbers import EXTRAPOLATED, NOT_REACHED, plain
from verification.exhibits.table import Table
from verification.judging.outcome import Status
from verification.running.study import Statement
from verification.studies.work_precision.charts import SERIES
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.point import (
    TARGETS,
    Beyond,
    Cost,
    Point,
    beyond,
    cheapest,
    dependable,
    operations,
    seconds,
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
        return self._with_unit(self.cost(point))

    def guess(self, setting: Beyond) -> str:
        """What a setting would cost that was not tried."""
        return f"{EXTRAPOLATED} {self._with_unit(setting.cost)}"

    def _with_unit(self, cost: float) -> str:
        return f"{plain(cost / self.scale, 2)} {self.unit}"


WORK = Price(
    operations,
    MILLION,
    "Mop",
    "counted work",
    "Millions of counted operations, the same at every run, set-up of exact coefficients left out, "
    "and the setting; " + NOTE.format(mark=EXTRAPOLATED),
)
CLOCK = Price(
    seconds,
    1.0,
    "s",
    "CPU time",
    "CPU seconds, and the setting; " + NOTE.format(mark=EXTRAPOLATED) + " The codes of the last "
    "rows were run in turn with our own, at another time than the rest: compare them with that.",
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
    settings = [point for point in best if point is not None]
    if not settings:
        return f"No setting that was tried reaches {percent(ASKED)}."
    counts = {name: sum(p.method == name for p in settings) for name in SERIES}
    parts = [f"{name} for {count}" for name, count in counts.items() if count]
    dearest = max(settings, key=price.cost)
    return (
        f"{percent(ASKED)} is reached for {len(settings)} of {len(best)} quantities, in at most "
        f"{price.text(dearest)}; cheapest of ours by {price.words}: {'; '.join(parts)}. "
        f"By method, of the quantities that it was tried on: {_by_method(everything)}."
    )


def _by_method(everything: Everything) -> str:
    """How often every method reaches the accuracy that is asked for."""
    tried = {
        name: [[p for p in points if p.method == name] for points in everything.values()]
        for name in SERIES
    }
    counts = [
        (name, sum(reached(p, ASKED) for p in found if p), sum(bool(p) for p in found))
        for name, found in tried.items()
    ]
    return "; ".join(f"{name}: {good} of {asked}" for name, good, asked in counts if asked)


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
        text = f"not reached; the least error is {plain(least.error, 2)} ({least.method})"
        further = beyond(points, ASKED, price.cost)
        return text if further is None else f"{text}; {_further_text(price, further)}"
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
    if best is not None:
        who = f" ({best.curve})" if best.method == OTHERS else ""
        return f"{price.text(best)}{who}: {best.setting}"
    further = beyond(points, target, price.cost)
    return NOT_REACHED if further is None else _further_text(price, further)


def _further_text(price: Price, further: Beyond) -> str:
    return (
        f"{price.guess(further)}: extrapolated to {further.fineness:.0f} cells or elements "
        f"by order {plain(further.order, 2)}"
    )
