"""What each solver took, in CPU seconds and over the radial one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median

from verification.cases.both_solvers.sides import CELLS, ELEMENTS, RADIAL
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table

Clock = Mapping[str, float]
ORDER = (RADIAL, CELLS, ELEMENTS)


def cost_table(clocks: Mapping[tuple[str, ...], Clock], columns: Sequence[str]) -> Table:
    """CPU seconds of the finer solve of every side, and their ratio.

    clocks  by what names a scene, in the columns
    """
    return Table(
        title="CPU seconds of three solvers, and their ratio",
        columns=(*columns, *ORDER, f"ratio {' : '.join(ORDER)}"),
        rows=tuple(
            (*scene, *(plain(clock[side], 2) for side in ORDER), ratio(clock))
            for scene, clock in clocks.items()
        ),
        note="Of the finer of both solves of a side, with an empty cache, on one thread.",
        units=dict.fromkeys(ORDER, "s"),
    )


def ratio(clock: Clock) -> str:
    """Over the radial one."""
    return " : ".join("1" if side == RADIAL else plain(clock[side] / clock[RADIAL], 2)
                      for side in ORDER)  # fmt: skip


def middle(clocks: Sequence[Clock]) -> Clock:
    """The median of every side's seconds."""
    return {side: median(clock[side] for clock in clocks) for side in ORDER}
