"""Coarse solves of one result, each made once and recorded."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, field
from math import log
from typing import Any

from contact_errors.error_formula import Comparison
from contact_errors.values import Values, values_of
from contact_results.cycles import fretting_cycles
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import Companion

# A step with fewer increments is compared with many, as halves of few do not converge regularly.
FEW, MANY = 4, (32, 8)


@dataclass(frozen=True)
class CoarseSolves:
    """Coarse solves of a result.

    made   records of the solves
    known  their results by key, None without one
    """

    result: Any
    made: list[Companion] = field(default_factory=list)
    known: dict[Hashable, Any] = field(default_factory=dict)

    def values(self, result: Any) -> tuple[Values, ...]:
        """Numbers at the ends of the load steps."""
        return values_of(result, fretting_cycles(result))

    def solved(self, key: Hashable, solve: Callable[[], Any], record: Companion) -> Any:
        """Result of a coarse solve; None for a refused one."""
        if key in self.known:
            return self.known[key]
        try:
            found = solve()
        except SolverError as error:
            found = None
            self.made.append(record.model_copy(update={"refused": str(error)}))
        else:
            spent = {"iterations": sum(i.iterations for i in found.increments)}
            if getattr(found.increments[0], "convolutions", None) is not None:
                spent["convolutions"] = sum(i.convolutions for i in found.increments)
            self.made.append(record.model_copy(update=spent))
        self.known[key] = found
        return found

    def compared(self, part: Any, found: Any, ratio: float, order: float | None = None,
                 base: Any = None) -> Iterator[Comparison]:  # fmt: skip
        """Compare a coarse solve, if it has a result, with the run or another base."""
        if found is not None and ratio != 1:
            values = self.values(base or self.result)
            yield Comparison(part, values, self.values(found), [ratio] * len(values), order)

    def by_increments(
        self, matters: Sequence[bool], solve: Callable[[tuple[int, ...]], Any]
    ) -> Iterator[Comparison]:
        """Compare other increments with those of the run, both on one coarse discretisation.

        solve  a coarse solve with these increments; None for a refused one
        """
        counts = self.result.plan.increments
        base = solve(counts) if any(matters) else None
        if base is not None:
            for others in dict.fromkeys(recounted(counts, matters)):
                found = solve(others)
                if found is not None:
                    values = self.values(base), self.values(found)
                    factors = ratios(counts, others, matters)
                    yield Comparison("increments", *values, factors, order=1.0)


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
