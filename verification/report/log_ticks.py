"""Labelled places of a logarithmic axis: some, whatever it spans, and never too many."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.ticker import Locator, MaxNLocator

FEWEST, MOST = 3, 8
# Within a decade, the sparsest first.
PARTS = ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0))


class LogTicks(Locator):
    """Powers of ten where there are enough of them, and parts of a decade where there are not."""

    def __init__(self, most: int = MOST) -> None:
        self.most = most

    def __call__(self) -> list[float]:
        low, high = sorted(self.axis.get_view_interval())  # type: ignore[union-attr]
        return log_ticks(low, high, self.most)


def log_ticks(low: float, high: float, most: int = MOST) -> list[float]:
    """Two to `most` round numbers from `low` to `high`, both positive."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    whole = last - first + 1
    if whole > most:
        step = math.ceil(whole / most)
        start = -(-first // step) * step  # so that 1 is among them wherever it is on the axis
        return [10.0**n for n in range(start, last + 1, step) if low <= 10.0**n <= high]
    decades = 10.0 ** np.arange(first, last + 1)
    found: list[float] = []
    for parts in PARTS:
        every = sorted(float(f"{decade * part:.6g}") for decade in decades for part in parts)
        found = [tick for tick in every if low <= tick <= high]
        if len(found) >= FEWEST:
            return found
    if len(found) > 1:
        return found
    even = MaxNLocator(FEWEST).tick_values(low, high)  # so narrow that the axis is all but even
    return [float(tick) for tick in even if low <= tick <= high]
