"""Increments of the coarse solves that estimate the increment error, and their ratios."""

from __future__ import annotations

from collections.abc import Sequence
from math import log

# A step with fewer increments is compared with many, as halves of few do not converge regularly.
FEW, MANY = 4, (32, 8)


def recounted(counts: Sequence[int], matters: Sequence[bool]) -> list[tuple[int, ...]]:
    """Return the increments of the two coarse solves; steps without increment error keep theirs."""
    both = [
        _pair(count) if matter else (count, count)
        for count, matter in zip(counts, matters, strict=True)
    ]
    return [tuple(pair[level] for pair in both) for level in (0, 1)]


def ratios(
    counts: Sequence[int], others: Sequence[int], matters: Sequence[bool]
) -> tuple[float, ...]:
    """Coarsening factor of the increments at the end of each step.

    A step that inherits a state takes the factor nearest to 1 among the steps so far. The factor
    is 1 where no step so far has an increment error.
    """
    found, nearest = [], 1.0
    for count, other, matter in zip(counts, others, matters, strict=True):
        ratio = count / other
        if matter and (nearest == 1 or abs(log(ratio)) < abs(log(nearest))):
            nearest = ratio
        found.append(nearest)
    return tuple(found)


def _pair(count: int) -> tuple[int, int]:
    if count < FEW:
        return MANY
    if count < 2 * FEW:
        return 4 * count, 2 * count
    return count // 2, max(FEW, count // 4)
