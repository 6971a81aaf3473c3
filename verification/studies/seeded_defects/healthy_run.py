"""One healthy contact through the judgements of the harness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from contact_scene.description import Description
from verification.defects.healthy_contacts import FAMILIES
from verification.judging.case import Derived
from verification.judging.judgement import judge
from verification.judging.outcome import Status
from verification.judging.run import AnyRun
from verification.judging.verdicts import expanded_uncertainty

SEED = 20


class Sample(Description):
    """A quantity beside its reference; errors relative to the quantity's scale."""

    quantity: str
    error: float | None
    allowed: float
    uncertainty: float | None
    """Expanded, U = 2u, before it is capped; null where the tolerance is not derived."""


class HealthyRecord(Description):
    """What the harness says of a healthy contact."""

    samples: tuple[Sample, ...]
    verdicts: int
    failed: tuple[str, ...]
    inconclusive: int


@dataclass(frozen=True)
class HealthyRun:
    """A contact of a family by the number of its draw."""

    record_type: ClassVar[type[Description]] = HealthyRecord
    family: str
    draw: int

    @property
    def name(self) -> str:
        """For files."""
        return f"{self.family.replace('_', '-')}-{self.draw:03d}"

    def compute(self) -> HealthyRecord:
        """Solve it on all its grids and judge it."""
        number = list(FAMILIES).index(self.family)
        case = FAMILIES[self.family](np.random.default_rng((SEED, number, self.draw)))
        results: dict[str, Any] = {}

        def solve(run: AnyRun) -> Any:
            results[run.label] = run.solve()
            return results[run.label]

        outcome = judge(case, solve)
        verdicts = {verdict.name: verdict for verdict in outcome.verdicts}
        samples = []
        for quantity in case.quantities:
            verdict = verdicts.get(quantity.name)
            if verdict is None:
                continue
            uncertainty = None
            if isinstance(quantity.tolerance, Derived):
                whole = expanded_uncertainty(quantity, quantity.tolerance, case, results)
                uncertainty = whole / verdict.scale
            samples.append(
                Sample(
                    quantity=quantity.name,
                    error=verdict.error,
                    allowed=verdict.allowed,
                    uncertainty=uncertainty,
                )
            )
        return HealthyRecord(
            samples=tuple(samples),
            verdicts=len(outcome.verdicts),
            failed=tuple(v.name for v in outcome.verdicts if v.status is Status.FAIL),
            inconclusive=outcome.count(Status.INCONCLUSIVE),
        )
