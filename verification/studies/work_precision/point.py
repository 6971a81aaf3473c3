"""Points of a work–precision diagram, the Pareto line, and the cheapest that is good enough."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

TARGETS = (0.1, 0.01, 0.001, 0.0001)


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
    happens to change sign does not count as accurate."""
    found: list[Point] = []
    curves: dict[tuple[str, str], list[Point]] = {}
    for point in points:
        curves.setdefault((point.method, point.curve), []).append(point)
    for curve in curves.values():
        worst = 0.0
        for point in sorted(curve, key=lambda p: -p.fineness):
            worst = max(worst, point.error)
            found.append(replace(point, error=worst))
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
