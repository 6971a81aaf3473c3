"""How far two solvers are apart also where they are not compared: what is left out is shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

NAME = "apart_everywhere"  # by which the page finds the table
TITLE = "Both solvers everywhere, also where they are not compared"
NOWHERE = "–"


@dataclass(frozen=True)
class Apart:
    """Differences along a line under one load.

    load        in words
    x           places, dimensionless
    difference  of both solvers there, dimensionless
    left_out    places that are not compared, by the reason; the first that fits counts
    """

    load: str
    x: Field
    difference: Field
    left_out: dict[str, Mask]

    @property
    def judged(self) -> float | None:
        """The largest difference where they are compared; None if they are nowhere."""
        somewhere = np.any(list(self.left_out.values()), axis=0)
        if np.all(somewhere):
            return None
        return float(np.max(self.difference, where=~somewhere, initial=0.0))

    @property
    def largest(self) -> tuple[float, float, str]:
        """The largest difference where they are not, its place, and why they are not."""
        somewhere = np.any(list(self.left_out.values()), axis=0)
        if not np.any(somewhere):
            return 0.0, 0.0, NOWHERE
        at = int(np.argmax(np.where(somewhere, self.difference, -1.0)))
        why = next(reason for reason, mask in self.left_out.items() if mask[at])
        return float(self.difference[at]), float(self.x[at]), why


def apart_everywhere(lines: Sequence[Apart], what: str, over: str, x_name: str) -> Table:
    """A row per load; the note says the largest difference that no verdict sees.

    what    what differs, and over: what it is divided by
    x_name  what places are told in
    """
    worst = lines[int(np.argmax([line.largest[0] for line in lines]))]
    value, at, why = worst.largest
    side = float(worst.x[1] - worst.x[0])
    return Table(
        name=NAME,
        title=TITLE,
        columns=("load", f"largest difference of {what} over {over}, compared", "left out",
                 f"at x / {x_name}", "left out, since it is"),
        rows=tuple(_row(line) for line in lines),
        note=f"Left out of the comparison of {what} is what lies {listed(list(worst.left_out))}. "
        f"There both are apart by up to {plain(value, 2)} {over}: {why}, at x = {plain(at, 2)} "
        f"{x_name}, at {worst.load}; places are {plain(side, 2)} {x_name} apart.", units=NONE
    )  # fmt: skip


def _row(line: Apart) -> tuple[str, ...]:
    value, at, why = line.largest
    place = NOWHERE if why == NOWHERE else plain(at, 2)
    compared = NOWHERE if line.judged is None else plain(line.judged, 2)
    return line.load, compared, plain(value, 2), place, why


def listed(parts: list[str]) -> str:
    """With commas, and a word before the last."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
