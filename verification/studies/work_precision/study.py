"""Study of work and precision: error against CPU seconds of every solution method."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from contact_scene.quantities.residuals import worst
from verification.exhibits.chart import (
    NONE,
    Chart,
    Look,
    Points,
    Table,
    log_chart,
    plain,
    point_curves,
)
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    found,
    judged,
    solved,
    value_of,
)
from verification.studies.work_precision.setting import CONTACTS, Method, PrecisionCase, all_cases

TARGETS = (0.1, 0.01, 0.001, 0.0001)
ASKED = 0.001  # the target of the answer
REACHED = 0.01  # what some setting must reach at every level, for every quantity
FLOOR = 1e-9  # of what can be drawn on a logarithmic axis
REMARKS = (
    "A setting counts as accurate to what the finer ones of its curve keep: an error that happens "
    "to change sign earns nothing. The finest of a curve has none above it.",
    "Edges are put inside the cells at the end of every step, or, where bodies couple, in every "
    "increment; energies and shifts stay those of cells, so that no loop was run so. The radial "
    "solver is asked for what it has no closed form of.",
    "An error norm of a field means the edge, where pressure is a square root. Every method is "
    "asked for what its values mean: cells for means over cells, with edges inside them or not, "
    "the radial solver for values at its rings, finite elements for what is linear between theirs.",
    "Seconds are CPU seconds of one thread, the median of up to five runs, each with an empty "
    "cache; imports do not count. They are of the machine and the moment that the provenance "
    "names, and are no verdict.",
)


@dataclass(frozen=True)
class Point:
    """Represent error and cost of one setting of a solution method.

    curve     key of the curve; settings of one curve differ in fineness only
    setting   setting in words
    fineness  number of cells or elements along a length
    error     relative error, not negative
    seconds   CPU time [s]
    """

    method: str
    curve: str
    setting: str
    fineness: int
    error: float
    seconds: float


def points_of(
    known: Mapping[PrecisionCase, CaseRecord], contact: str, quantity: str
) -> tuple[Point, ...]:
    """Return error and cost of all settings on one contact whose records have the given error.

    known     records by case
    quantity  name of the error
    """
    return tuple(
        Point(
            case.method.value, f"{case.tolerance:g} {case.penalty:g} {case.increments}", case.text,
            case.fineness, abs(value_of(record, quantity)), record.seconds,
        )
        for case, record in known.items()
        if case.contact == contact and quantity in record.measures
    )  # fmt: skip


def dependable(points: Iterable[Point]) -> tuple[Point, ...]:
    """Replace the error of each point by the largest error of all points of its curve as fine or
    finer.

    A coarse setting may have a small error by chance, because the error changes sign. An error that
    is NaN makes all coarser points NaN.
    """
    found: list[Point] = []
    largest: dict[tuple[str, str], float] = {}
    for point in sorted(points, key=lambda p: -p.fineness):
        curve = point.method, point.curve
        largest[curve] = worst(largest.get(curve, 0.0), point.error)
        found.append(replace(point, error=largest[curve]))
    return tuple(found)


def pareto(points: Iterable[Point]) -> tuple[Point, ...]:
    """Return the points (error, CPU time) for which no other point has both a smaller error and
    cost.

    They are the Pareto front, in ascending order of cost.
    """
    line: list[Point] = []
    for point in sorted(points, key=lambda p: (p.seconds, p.error)):
        if not line or point.error < line[-1].error:
            line.append(point)
    return tuple(line)


def cheapest(points: Iterable[Point], target: float) -> Point | None:
    """Return the setting with the least CPU time whose error is at most `target`; None if there is
    none.
    """
    return next((point for point in pareto(points) if point.error <= target), None)


def cases(settings: Settings) -> tuple[PrecisionCase, ...]:
    """Return the solves of all contacts, methods and settings of the level of the study."""
    return all_cases(settings.level)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Judge that a method reaches 1 % for every quantity, and report the cheapest settings."""
    known = found(cases(settings), records)
    everything = {
        (contact.name, quantity): dependable(points)
        for contact in CONTACTS.values()
        for quantity in contact.errors
        if (points := points_of(known, contact.name, quantity))
    }
    best = {key: cheapest(points, ASKED) for key, points in everything.items()}
    missed = [_meaning(*key) for key, p in everything.items() if cheapest(p, REACHED) is None]
    had = len(everything) - len(missed)
    reached = Statement(
        claim=f"every quantity is had to {_percent(REACHED)}",
        outcome=judged(not missed and bool(everything)),
        measured=f"{had} of {len(everything)}" + (f"; not {'; '.join(missed)}" if missed else ""),
        because="some setting of some method of ours, and all finer ones of its curve",
    )
    good = [point for point in best.values() if point is not None]
    most = f", in at most {_cost(max(good, key=lambda p: p.seconds))}" if good else ""
    return Conclusion(
        statements=(
            solved("every setting is solved", len(known), len(cases(settings))),
            reached,
            *(
                Statement(
                    claim=f"{_meaning(*key)} to {_percent(ASKED)}",
                    outcome=None,
                    measured="not reached" if p is None else f"{p.method}, {_setting(p)}",
                )
                for key, p in best.items()
            ),
        ),
        answer=f"{_percent(ASKED)} is reached for {len(good)} of {len(best)} quantities{most}.",
        tables=tuple(_table(*key, points) for key, points in everything.items()),
        charts=tuple(_chart(*key, points) for key, points in everything.items()),
        remarks=(
            *REMARKS,
            *(f"Reference, {c.title}: {c.problem.source}." for c in CONTACTS.values()),
        ),
    )


def _by_method(points: tuple[Point, ...]) -> Iterator[tuple[str, list[Point]]]:
    for method in Method:
        yield method.value, [p for p in points if p.method == method.value]


def _table(contact: str, quantity: str, points: tuple[Point, ...]) -> Table:
    rows = (
        (method, *(_setting(cheapest(own, target)) for target in TARGETS))
        for method, own in _by_method(points)
        if own
    )
    return Table(
        title=f"Cheapest setting by CPU time, {_meaning(contact, quantity)}",
        columns=("method", *map(_percent, TARGETS)),
        rows=tuple(rows),
        note="CPU seconds, and the setting; – where no setting that was tried reaches it.",
        units=NONE,
    )


def _chart(contact: str, quantity: str, points: tuple[Point, ...]) -> Chart:
    def drawn(points: Iterable[Point]) -> Points:
        return [(p.seconds, max(p.error, FLOOR)) for p in pareto(points)]

    meaning = CONTACTS[contact].errors[quantity]
    lines = [(method, drawn(own)) for method, own in _by_method(points)]
    return log_chart(
        f"precision_{contact}_{quantity}",
        _meaning(contact, quantity),
        f"Error of the {meaning} against CPU seconds, set-up included, of the best settings of "
        "every method; thin black dashes are the Pareto line of all of them.",
        "CPU seconds",
        "relative error",
        point_curves(lines) + point_curves([("Pareto line", drawn(points))], Look.BOUND),
    )


def _meaning(contact: str, quantity: str) -> str:
    return CONTACTS[contact].meaning(quantity)


def _setting(point: Point | None) -> str:
    return "–" if point is None else f"{_cost(point)}: {point.setting}"


def _cost(point: Point) -> str:
    return f"{plain(point.seconds, 2)} s"


def _percent(part: float) -> str:
    return f"{100 * part:g} %"


STUDY = Study(
    name="work-precision",
    title="What accuracy costs",
    question="Which method and which setting reach an accuracy in the least time, and what does "
    "0.1 % cost with each of them?",
    cases=cases,
    conclude=conclude,
)
