"""A requested accuracy of one number of a drawn scene, and its true error at the last level."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any
from zlib import crc32

import numpy as np

from contact_errors.adaptive_refinement import Levels, RefinementLevel, refine
from contact_errors.coarse_solves import Fineness
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import ElementSolver
from contact_scene.accuracy import BOUND, LARGEST_TENSION, AccuracyRequest
from contact_scene.solver_errors import SolverError
from verification.problems.drawn.drawing import logarithmic
from verification.problems.drawn.families import FAMILIES
from verification.problems.drawn.known_scene import CELLS, KnownScene, Truth
from verification.running.row import CaseRecord, parameters_of
from verification.studies.error_coverage.coverage import CERTAIN

SHARES = (2e-4, 0.1)
# Work of the largest level: cells times increments, and elements over the radius times increments.
MAX_CELLS, MAX_ELEMENTS = 1_500_000, 3_000
ASKED, REACHED, TRUE = "asked", "reached", "true"


@dataclass(frozen=True)
class LimitedLevels(Levels):
    """Levels up to a largest work."""

    most: float = np.inf

    def too_large(self, fineness: Fineness) -> str | None:
        sizes = self.solver.shown(fineness.space).values()
        if np.prod([*sizes]) * sum(fineness.increments) > self.most:
            return "the next level takes more work than the study allows"
        return super().too_large(fineness)


@dataclass(frozen=True)
class RequestCase:
    """A request by the place where it is drawn."""

    seed: int
    number: int

    @property
    def name(self) -> str:
        return f"request-{self.seed}-{self.number}"

    def compute(self) -> CaseRecord:
        """Refine until the request is met, and compare with the reference."""
        family, known, quantity, share = self._drawn()
        truths = [truth for truth in known.truths if truth.quantity == quantity]
        record = CaseRecord(
            parameters=parameters_of(self) | {"family": family, "quantity": quantity},
            measures={ASKED: share},
        )
        asked: Any = known.fineness.asked
        if known.fineness.solver == CELLS:
            stress_at = truths[0].step if quantity == LARGEST_TENSION else None
            on_cells = CellSolver(known.scene, asked, stress=stress_at is not None)
            levels = LimitedLevels(on_cells, stress_at, most=MAX_CELLS)
        else:
            levels = LimitedLevels(ElementSolver(known.scene, asked), most=MAX_ELEMENTS)
        try:
            made = refine(levels, AccuracyRequest(**{quantity: share}))
        except SolverError as error:
            return record.model_copy(update={"words": {"outcome": f"refused: {error}"}})
        largest = max(abs(truth.reference.value) for truth in truths)
        found = [_found(truth, made.level) for truth in truths]
        errors = [abs(f - t.reference.value) for f, t in zip(found, truths, strict=True)]
        measures = {REACHED: made.accuracy.reached[quantity], TRUE: max(errors) / largest}
        outcome = "met" if made.accuracy.met else f"stopped: {made.accuracy.stopped}"
        return record.model_copy(
            update={"measures": record.measures | measures, "words": {"outcome": outcome}}
        )

    def _drawn(self) -> tuple[str, KnownScene, str, float]:
        """Draw scenes until one has a number with a reference certain enough for the request."""
        rng = np.random.default_rng([self.seed, crc32(b"request"), self.number])
        while True:
            family = str(rng.choice([*FAMILIES]))
            share, known = logarithmic(rng, *SHARES), FAMILIES[family].known(rng)
            fit = [*dict.fromkeys(_certain(known, share))]
            if fit:
                return family, known, fit[int(rng.integers(len(fit)))], share


def _found(truth: Truth, level: RefinementLevel) -> float:
    found = truth.read(level.values)
    return np.inf if found is None else found


def _certain(known: KnownScene, share: float) -> Iterator[str]:
    """Quantities that can be requested, with references certain enough at all their steps."""

    def uncertain(truth: Truth) -> float:
        return truth.reference.uncertainty / abs(truth.reference.value)

    for quantity in dict.fromkeys(truth.quantity for truth in known.truths):
        of_it = [truth for truth in known.truths if truth.quantity == quantity]
        stressed = quantity == LARGEST_TENSION and known.fineness.solver != CELLS
        if quantity in BOUND and not stressed and max(map(uncertain, of_it)) <= CERTAIN * share:
            yield quantity
