"""Accuracy and cost over standings as one page: a line for each case, red where it became worse."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from verification.exhibits.numbers import plain
from verification.judging.change import ChangeKind
from verification.regression.baseline import COUNTERS, Recording
from verification.regression.history import Mark, Standing, marks, worst
from verification.report.templating import environment

STEP, HEIGHT, EDGE = 5.0, 26.0, 4.0  # of a line, in pixels
LEAST = 1e-6  # of what is allowed: less is drawn as this much
# Of what solves are made of, that which most of a case's time goes into.
DEAREST = ("convolutions", "factorizations", "iterations")


@dataclass(frozen=True)
class Line:
    """A number of a case over the standings, drawn to a logarithmic scale of its own.

    points  "x,y x,y ...", one string for each stretch without a gap
    red     x, y and what is said of a point where it became worse
    now     the last number, in words
    """

    points: tuple[str, ...]
    red: tuple[tuple[float, float, str], ...]
    now: str


@dataclass(frozen=True)
class CaseHistory:
    """A case in a row of the table."""

    case: str
    where: str
    accuracy: Line
    counted: str
    cost: Line
    time: Line


def render_history(standings: Sequence[Standing], level: str) -> str:
    """Self-contained HTML, readable without script."""
    found = marks(standings)
    cases = sorted({case for standing in standings for case in standing.recordings})
    return environment().get_template("history.html").render(
        level=level,
        standings=standings,
        rows=[_row(case, standings, [m for m in found if m.case == case]) for case in cases],
        marks=[(standings[mark.at], mark, *_numbers(mark)) for mark in reversed(found)],
        width=_x(len(standings) - 1) + EDGE,
        height=HEIGHT,
    )  # fmt: skip


def _row(case: str, standings: Sequence[Standing], found: Sequence[Mark]) -> CaseHistory:
    recordings = [standing.recordings.get(case) for standing in standings]
    last = next(one for one in reversed(recordings) if one is not None)
    parts = [None if one is None or (w := worst(one)) is None else w[1] for one in recordings]
    where = worst(last)
    counted = next((name for name in DEAREST if _total(last, name)), DEAREST[0])
    counts = [None if one is None else float(_total(one, counted)) for one in recordings]
    loops = [None if one is None else one.loops for one in recordings]
    dearer = [mark for mark in found if mark.kind is ChangeKind.DEARER]
    worse = [mark for mark in found if mark.kind is not ChangeKind.DEARER]
    return CaseHistory(
        case,
        "" if where is None else where[0],
        _line([None if part is None else max(part, LEAST) for part in parts], worse, standings),
        counted if _total(last, counted) else "",
        _line(counts, dearer, standings, over_first=True),
        _line(loops, (), standings, over_first=True),
    )


def _total(recording: Recording, counter: str) -> int:
    assert counter in COUNTERS
    return sum(getattr(run, counter) for run in recording.runs)


def _line(
    values: Sequence[float | None],
    found: Sequence[Mark],
    standings: Sequence[Standing],
    *,
    over_first: bool = False,
) -> Line:
    known = [value for value in values if value is not None and value > 0]
    if not known:
        return Line((), (), "–")
    low, high = math.log(min(known)), math.log(max(known))
    span = max(high - low, math.log(2.0))  # what hardly moves is drawn flat

    def y(value: float) -> float:
        part = (math.log(value) - 0.5 * (low + high)) / span + 0.5
        return round(HEIGHT - EDGE - part * (HEIGHT - 2 * EDGE), 1)

    stretches: list[list[str]] = [[]]
    for at, value in enumerate(values):
        if value is None or value <= 0:
            stretches.append([])
        else:
            stretches[-1].append(f"{_x(at):g},{y(value):g}")
    red = tuple(
        (_x(at), y(value), "; ".join(_said(mark) for mark in here) + f" ({standings[at].name})")
        for at, value in enumerate(values)
        if value and (here := [mark for mark in found if mark.at == at])
    )
    now = values[-1]
    told = "–" if now is None else plain(now, 3)
    if over_first and now is not None and len(known) > 1:
        told += f", × {now / known[0]:.2g}"
    return Line(tuple(" ".join(one) for one in stretches if one), red, told)


def _x(at: int) -> float:
    return EDGE + STEP * at


def _said(mark: Mark) -> str:
    was, now = _numbers(mark)
    return f"{mark.name} {mark.kind}: {was} → {now}"


def _numbers(mark: Mark) -> tuple[str, str]:
    """Before and after; of an error as parts of what is allowed."""
    unit = "" if mark.kind is ChangeKind.DEARER else " U"
    was, now = (f"{plain(number, 3)}{unit}" for number in (mark.was, mark.now))
    return was, now
