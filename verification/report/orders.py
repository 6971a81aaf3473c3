"""Observed orders of convergence of a whole report, in one table."""

from __future__ import annotations

from dataclasses import dataclass

from verification.judging.outcome import CaseOutcome, Verdict
from verification.running.report_record import Report


@dataclass(frozen=True)
class ObservedOrder:
    """An order that was judged, with its case."""

    case: CaseOutcome
    verdict: Verdict

    @property
    def quantity(self) -> str:
        """What was followed, in a word or two where the record has one."""
        order = self.verdict.order
        return self.detail if order is None else order.of

    @property
    def detail(self) -> str:
        """What was followed, exactly."""
        order = self.verdict.order
        return self.verdict.meaning if order is None else order.meaning or self.verdict.meaning

    @property
    def sort_key(self) -> tuple[str, str]:
        """Quantities together, solvers in a fixed order."""
        order = self.verdict.order
        return (self.verdict.name, "") if order is None else (order.of, order.solver)


def observed_orders(report: Report) -> list[ObservedOrder]:
    """Every judged order, by quantity and solver."""
    found = [
        ObservedOrder(case, verdict)
        for case in report.cases
        for verdict in case.verdicts
        if verdict.tolerance_kind == "order"
    ]
    return sorted(found, key=lambda one: one.sort_key)
