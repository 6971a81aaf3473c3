"""A refinement of something in one scene: its levels, the orders that are expected, verdicts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.row import CaseRecord, Row, found
from verification.running.rules import converged
from verification.running.study import (
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    StudyCase,
)
from verification.studies.refinement import page
from verification.studies.refinement.expected import Expected
from verification.studies.refinement.fit import FEWEST_JUDGED, FEWEST_LEVELS, Fit, fits
from verification.studies.refinement.studied_scene import CannotRefine

# Enough for a verdict on orders.
LEVELS = {Level.QUICK: FEWEST_JUDGED, Level.STANDARD: FEWEST_JUDGED, Level.FULL: 6}

Levels = Callable[[Settings], Sequence[StudyCase]]


@dataclass(frozen=True)
class Refinement:
    """One thing that is refined while the others stay.

    name       of charts and files
    levels     coarse to fine; each computes a `level_row`
    expected   orders by quantity
    axis       what sizes are, for people; unit: what they are divided by
    tolerance  of the solver
    finer      how finer levels are asked for
    """

    name: str
    levels: Levels
    expected: Mapping[str, Expected]
    axis: str
    tolerance: float
    unit: Callable[[Row], float] = field(default=lambda finest: 1.0)
    finer: str = "more --levels"

    def found(self, settings: Settings, records: Records) -> tuple[CaseRecord, ...]:
        """The records of the levels, of those that have one."""
        return tuple(found(self.levels(settings), records).values())

    def fitted(self, levels: Sequence[CaseRecord]) -> tuple[Fit, ...]:
        """Orders and limits; nothing for too few levels."""
        if len(levels) < FEWEST_LEVELS:
            return ()
        return fits(levels, self.expected, self.tolerance)

    def conclusion(self, settings: Settings, records: Records) -> Conclusion:
        """What the levels that there are show."""
        levels = self.found(settings, records)
        if not levels:
            return Conclusion(statements=(_nothing_to_fit(0),))
        of = self.fitted(levels)
        judged = tuple(page.statement(fit, self._to_try(fit, settings)) for fit in of)
        judged = judged or (_nothing_to_fit(len(levels)),)
        shown = [fit.name for fit in of if not fit.is_field]
        orders = (page.order_table(of),) if of else ()
        return Conclusion(
            statements=(*judged, converged(levels, self.tolerance, f"on {len(levels)} levels")),
            tables=(*orders, page.level_table(levels, shown)),
            charts=(
                (page.error_chart(f"{self.name}_errors", self.axis, of, self.unit(levels[-1])),)
                if of
                else ()
            ),
            rows=tuple(map(page.order_row, of)),
            remarks=page.LIMITS,
        )

    def _to_try(self, fit: Fit, settings: Settings) -> str:
        """What may make an order conclusive: more levels where they are few, else finer ones."""
        if fit.levels >= FEWEST_JUDGED:
            return self.finer
        wanted = f"--levels {FEWEST_JUDGED}"
        try:
            self.levels(replace(settings, levels=FEWEST_JUDGED))
        except CannotRefine as refusal:
            return f"{wanted} with other --cells: {refusal}"
        return wanted


Further = Callable[[Settings, Records], Conclusion]


def study_of(
    refinement: Refinement, title: str, question: str, further: Further | None = None
) -> Study:
    """The study of one refinement.

    further  what else its levels show, beside orders and limits
    """

    def conclude(settings: Settings, records: Records) -> Conclusion:
        if not refinement.levels(settings):
            return Conclusion(statements=(_one_is_exact(),))
        orders = refinement.conclusion(settings, records)
        return orders if further is None else joined(further(settings, records), orders)

    return Study(
        refinement.name,
        title,
        question,
        lambda settings: tuple(refinement.levels(settings)),
        conclude,
    )


def joined(*conclusions: Conclusion) -> Conclusion:
    """One after the other; the first answer that is given."""
    return Conclusion(
        statements=tuple(s for one in conclusions for s in one.statements),
        answer=next((one.answer for one in conclusions if one.answer), ""),
        tables=tuple(t for one in conclusions for t in one.tables),
        charts=tuple(c for one in conclusions for c in one.charts),
        rows=tuple(r for one in conclusions for r in one.rows),
        remarks=tuple(dict.fromkeys(r for one in conclusions for r in one.remarks)),
    )


def count_of(settings: Settings, more: int = 0) -> int:
    """How many levels: as asked for, or so many more than usual."""
    return LEVELS[settings.level] + more if settings.levels is None else settings.levels


def _one_is_exact() -> Statement:
    return Statement(
        claim="no step depends on how finely it is cut",
        outcome=None,
        measured="one increment per step is exact: nothing was computed",
        because="'slipstick plan' says why for each step",
    )


def _nothing_to_fit(levels: int) -> Statement:
    few = levels < FEWEST_LEVELS
    return Statement(
        claim="orders of convergence",
        outcome=Status.INCONCLUSIVE if few else None,
        measured=f"{levels} levels" if few else "nothing changes by more than the tolerance",
        because=f"at least {FEWEST_LEVELS} levels are needed",
    )
