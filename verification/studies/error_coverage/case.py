"""A drawn scene solved as `slipstick run` solves it, and what is wrong beside what it states."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import fem_reference
import semi_analytical
from contact_errors import on_cells, on_elements
from contact_errors.values import values_of
from contact_results.cycles import fretting_cycles
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import StatedError
from verification.problems.drawn.families import drawn
from verification.problems.drawn.known_scene import CELLS, STRESSES, KnownScene, Truth
from verification.running.row import CaseRecord, Row, Value, parameters_of
from verification.studies.error_coverage.stress_maxima import stress_maxima

WRONG, STATED, UNCERTAIN = "wrong", "stated", "uncertain"


@dataclass(frozen=True)
class CoverageCase:
    """A scene by the place where it is drawn."""

    family: str
    seed: int
    number: int

    @property
    def name(self) -> str:
        return f"{self.family}-{self.seed}-{self.number}"

    def compute(self) -> CaseRecord:
        """One part for every number that is known."""
        known = drawn(self.family, self.seed, self.number)
        started = time.process_time()
        kind: dict[str, Value] = {
            "homogeneous": known.homogeneous,
            "friction": known.scene.friction is not None,
            "loop": known.loops,
            "solver": known.fineness.solver,
        }
        record = CaseRecord(
            parameters=parameters_of(self) | kind,
            measures={"per_radius": known.fineness.per_radius},
        )
        try:
            parts = tuple(_judged(known))
        except SolverError as error:
            return record.model_copy(update={"words": {"refused": str(error)}})
        seconds = time.process_time() - started
        return record.model_copy(update={"parts": parts, "seconds": seconds})


def _judged(known: KnownScene) -> Iterator[Row]:
    """Rows of what the run gives of the truths that have a size: shares of zero tell nothing."""
    result, errors = _run(known)
    steps = values_of(result, fretting_cycles(result))
    stressed = {truth.step for truth in known.truths if truth.quantity in STRESSES}
    stresses = {step: stress_maxima(result, step) for step in sorted(stressed)}
    for truth in known.truths:
        if truth.reference.value == 0:
            continue
        if truth.quantity in STRESSES:
            found, stated = stresses[truth.step][truth.quantity]
            yield judged(truth, found, stated)
        elif (found_here := truth.read(steps)) is not None:
            stated_here = errors[truth.step - 1].get(truth.quantity)
            yield judged(truth, found_here, stated_here)


def judged(truth: Truth, found: float, stated: StatedError | None) -> Row:
    """A number beside its truth and its error, over the truth; of a vector the x component."""
    size = abs(truth.reference.value)
    error = None if stated is None or stated.error is None else float(np.ravel(stated.error)[0])
    return Row(
        parameters={"quantity": truth.quantity, "kind": truth.kind, "step": truth.step},
        measures={
            WRONG: abs(found - truth.reference.value) / size,
            STATED: None if error is None else error / size,
            UNCERTAIN: truth.reference.uncertainty / size,
        },
        words={"status": "not stated" if stated is None else str(stated.status)},
    )


def _run(known: KnownScene) -> tuple[Any, Sequence[Mapping[str, StatedError]]]:
    """A result, and what is stated of the ends of its steps."""
    asked: Any = known.fineness.asked
    if known.fineness.solver == CELLS:
        result = semi_analytical.solve_discretised(known.scene, asked)
        return result, on_cells.stated_errors(result).steps
    method = fem_reference.Method.COMPLEMENTARITY
    on_sections = fem_reference.solve(known.scene, asked, method)
    return on_sections, on_elements.stated_errors(on_sections).steps
