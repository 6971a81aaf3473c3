"""The study of what accuracy costs."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence

from verification.cases.chart import Chart
from verification.cases.outcome import Status
from verification.cases.table import Table
from verification.peers.recorded import (
    peer_charts,
    peer_remarks,
    peer_table,
    recorded_peers,
)
from verification.report.numbers import plain
from verification.studies.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.work_precision.charts import SERIES, time_chart, work_chart
from verification.studies.work_precision.contacts import CONTACTS, PreciseContact
from verification.studies.work_precision.families import all_cases
from verification.studies.work_precision.point import TARGETS, Point, cheapest, dependable
from verification.studies.work_precision.points import Found, points_of, setting_text
from verification.studies.work_precision.setting import Measured, PrecisionCase

ASKED = 0.001  # what the answer is given for
REACHED = 0.01  # what some setting must reach at every level, for every quantity
SHARED = (
    "Seconds are CPU seconds of one thread, the median of up to five runs, each with an empty "
    "cache: influence coefficients and condensed sections are made anew. Imports do not count.",
    "A setting counts as accurate to what the finer ones of its curve keep: an error that happens "
    "to change sign earns nothing. The finest of a curve has none above it.",
    "Operations are those of an idealised algorithm with the counted convolutions (on the whole "
    "window), factorisations (nested dissection) and dense systems.",
    "The usual route samples the frequency response at and between the cells, with the period a "
    "multiple of the window; with frozen directions it shears in ten equal increments.",
    "Extrapolation takes two grids with cells of ratio two and the order two, for peak pressure "
    "and approach.",
    "An error norm of a field means the edge, where pressure is a square root; a finite element "
    "there is compared ring by ring.",
)


def found_of(settings: Settings, records: Records) -> Found:
    """The records that there are, by case."""
    found = {case: records.get(case.name) for case in all_cases(settings.level)}
    return {case: record for case, record in found.items() if isinstance(record, Measured)}


def cases(settings: Settings) -> tuple[PrecisionCase, ...]:
    """All that has to be solved."""
    return all_cases(settings.level)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Statements, tables and diagrams."""
    found = found_of(settings, records)
    everything = {
        (contact.name, quantity): points_of(found, contact.name, quantity)
        for contact in CONTACTS.values()
        for quantity in contact.errors
    }
    everything = {key: points for key, points in everything.items() if points}
    peers = recorded_peers()
    return Conclusion(
        statements=_statements(settings, found, everything),
        answer=_answer(everything),
        tables=(
            *(_table(CONTACTS[c], q, points) for (c, q), points in everything.items()),
            peer_table(peers),
        ),
        charts=(*_charts(everything), *peer_charts(peers)),
        remarks=(
            *SHARED,
            *peer_remarks(peers),
            *(f"Reference, {c.title}: {c.source}." for c in CONTACTS.values()),
        ),
    )


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`settings.csv`: one line for every setting and quantity."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    counters = [name for name in Measured.model_fields if name != "errors"]
    table.writerow(("contact", "method", "setting", "quantity", "error", *counters))
    for case, record in found_of(settings, records).items():
        counted = [getattr(record, name) for name in counters]
        for quantity, error in record.errors.items():
            words = (case.contact, case.method.value, setting_text(case), quantity)
            table.writerow((*words, error, *counted))
    return {"settings.csv": text.getvalue()}


Everything = Mapping[tuple[str, str], tuple[Point, ...]]


def _seconds(point: Point) -> float:
    return point.seconds


def _statements(settings: Settings, found: Found, everything: Everything) -> tuple[Statement, ...]:
    asked = len(all_cases(settings.level))
    missed = [
        f"{CONTACTS[c].title}: {CONTACTS[c].errors[q]}"
        for (c, q), points in everything.items()
        if cheapest(dependable(points), REACHED, _seconds) is None
    ]
    return (
        Statement(
            claim="every setting is solved",
            outcome=Status.PASS if len(found) == asked else Status.FAIL,
            measured=f"{len(found)} of {asked}",
        ),
        Statement(
            claim=f"every quantity is had to {_percent(REACHED)}",
            outcome=Status.FAIL if missed or not everything else Status.PASS,
            measured=f"{len(everything) - len(missed)} of {len(everything)}"
            + (f"; not {'; '.join(missed)}" if missed else ""),
            because="some setting of some method of ours, and all finer ones of its curve",
        ),
        *(
            Statement(
                claim=f"{CONTACTS[c].title}: {CONTACTS[c].errors[q]} to {_percent(ASKED)}",
                outcome=None,
                measured=_cheapest_text(dependable(points)),
            )
            for (c, q), points in everything.items()
        ),
    )


def _cheapest_text(points: Sequence[Point]) -> str:
    best = cheapest(points, ASKED, _seconds)
    if best is None:
        least = min(points, key=lambda p: p.error)
        return f"not reached; the least error is {plain(least.error, 2)} ({least.method})"
    return f"{best.method}, {best.setting}: {plain(best.seconds, 2)} s"


def _answer(everything: Everything) -> str:
    best = [cheapest(dependable(points), ASKED, _seconds) for points in everything.values()]
    reached = [point for point in best if point is not None]
    if not reached:
        return f"No setting that was tried reaches {_percent(ASKED)}."
    counts = {name: sum(p.method == name for p in reached) for name in SERIES}
    parts = [f"{name} for {count}" for name, count in counts.items() if count]
    slowest = max(point.seconds for point in reached)
    return (
        f"{_percent(ASKED)} is reached for {len(reached)} of {len(best)} quantities, in at most "
        f"{plain(slowest, 2)} CPU seconds; cheapest: {', '.join(parts)}."
    )


def _table(contact: PreciseContact, quantity: str, points: Sequence[Point]) -> Table:
    steady = dependable(points)
    names = [*SERIES, *sorted({p.method for p in points} - set(SERIES))]
    rows = [
        (name, *(_cell([p for p in steady if p.method == name], target) for target in TARGETS))
        for name in names
        if any(point.method == name for point in points)
    ]
    return Table(
        title=f"Cheapest setting, {contact.title}: {contact.errors[quantity]}",
        columns=("method", *(_percent(target) for target in TARGETS)),
        rows=tuple(rows),
        note="CPU seconds, and the setting; – where no setting that was tried reaches it.",
    )


def _cell(points: Sequence[Point], target: float) -> str:
    best = cheapest(points, target, _seconds)
    return "–" if best is None else f"{plain(best.seconds, 2)} s: {best.setting}"


def _charts(everything: Everything) -> tuple[Chart, ...]:
    by_time = [time_chart(CONTACTS[c], q, points) for (c, q), points in everything.items()]
    leading = [(c.name, next(iter(c.errors))) for c in CONTACTS.values()]
    by_work = [
        work_chart(CONTACTS[c], q, everything[c, q]) for c, q in leading if (c, q) in everything
    ]
    return (*by_time, *by_work)


def _percent(part: float) -> str:
    return f"{100 * part:g} %"


STUDY = Study(
    name="work-precision",
    title="What accuracy costs",
    question="Which method and which setting reach an accuracy with the least work, and what does "
    "0.1 % cost with each of them?",
    cases=cases,
    conclude=conclude,
    exports=exports,
)
