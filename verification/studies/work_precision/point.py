"""Points of a work–precision diagram, the Pareto line, and the cheapest that is good enough."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from math import log

from contact_scene.residuals import worst

TARGETS = (0.1, 0.01, 0.001, 0.0001)
FEWEST_LEVELS = 3  # of a curve, for its order to be seen
LEAST_ORDER = 0.4  # below it an error does not fall, it stalls
SAME_ORDER = 0.8  # of two refinements: the last over the one before, at least
FARTHEST = 16.0  # times the finest that was tried


@dataclass(frozen=True)
class Point:
    """A setting of a method.

    curve       settings of one curve differ in fineness alone
    setting     for people
    fineness    cells or elements along a length
    error       relative, not negative
    seconds     CPU time
    operations  counted work
    """

    method: str
    curve: str
    setting: str
    fineness: int
    error: float
    seconds: float
    operations: float


Cost = Callable[[Point], float]


def seconds(point: Point) -> float:
    """What a setting costs by the clock."""
    return point.seconds


def operations(point: Point) -> float:
    """What a setting costs in counted work."""
    return point.operations


def dependable(points: Iterable[Point]) -> tuple[Point, ...]:
    """The points with errors that no finer setting of their curve exceeds: a coarse one whose error
    happens to change sign does not count as accurate, nor one whose finer is no number."""
    found: list[Point] = []
    curves: dict[tuple[str, str], list[Point]] = {}
    for point in points:
        curves.setdefault((point.method, point.curve), []).append(point)
    for curve in curves.values():
        largest = 0.0
        for point in sorted(curve, key=lambda p: -p.fineness):
            largest = worst(largest, point.error)
            found.append(replace(point, error=largest))
    return tuple(found)


def pareto(points: Iterable[Point], cost: Cost) -> tuple[Point, ...]:
    """Those that no other point beats in error and cost, cheapest first."""
    line: list[Point] = []
    for point in sorted(points, key=lambda p: (cost(p), p.error)):
        if not line or point.error < line[-1].error:
            line.append(point)
    return tuple(line)


def cheapest(points: Sequence[Point], target: float, cost: Cost) -> Point | None:
    """The least costly with an error of at most `target`; None where none has."""
    good = [point for point in points if point.error <= target]
    return min(good, key=lambda p: (cost(p), p.error), default=None)


@dataclass(frozen=True)
class Beyond:
    """A setting that was not tried, from the orders of those that were.

    fineness  cells or elements along a length
    cost      what it would take
    order     of the error in the fineness, over the last refinements
    """

    method: str
    fineness: float
    cost: float
    order: float


def beyond(points: Iterable[Point], target: float, cost: Cost) -> Beyond | None:
    """The least costly continuation of a curve to an error of `target`, by the order in which its
    last errors fell and its last costs rose; None where no curve falls steadily, or the target is
    more than FARTHEST refinements away."""
    curves: dict[tuple[str, str], list[Point]] = {}
    for point in dependable(points):
        curves.setdefault((point.method, point.curve), []).append(point)
    found = [_continued(curve, target, cost) for curve in curves.values()]
    return min((b for b in found if b is not None), key=lambda b: b.cost, default=None)


def _continued(curve: Sequence[Point], target: float, cost: Cost) -> Beyond | None:
    last = sorted(curve, key=lambda p: p.fineness)[-FEWEST_LEVELS:]
    sizes = [p.fineness for p in last]
    if len(set(sizes)) < FEWEST_LEVELS or not all(p.error > 0 and cost(p) > 0 for p in last):
        return None
    first, middle, finest = last
    early, late = _order(first, middle), _order(middle, finest)
    order = _order(first, finest)
    if order < LEAST_ORDER or late < SAME_ORDER * early:
        return None
    finer = (finest.error / target) ** (1 / order)
    if not 1 < finer <= FARTHEST:
        return None
    growth = log(cost(finest) / cost(middle)) / log(finest.fineness / middle.fineness)
    price = cost(finest) * finer ** max(growth, 0.0)
    return Beyond(finest.method, finest.fineness * finer, price, order)


def _order(coarse: Point, fine: Point) -> float:
    return log(coarse.error / fine.error) / log(fine.fineness / coarse.fineness)
