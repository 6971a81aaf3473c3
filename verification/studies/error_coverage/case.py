"""A drawn scene, solved as `slipstick run` solves it, with its stated and true errors."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

import fem_reference
import semi_analytical
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import ElementSolver
from contact_errors.values import values_of
from contact_scene.quantities.stated_error import (
    StatedError,
    StatedErrors,
)
from contact_scene.solver_errors import SolverError
from verification.problems.drawn.families import drawn
from verification.problems.drawn.known_scene import CELLS, STRESSES, KnownScene, Truth
from verification.problems.drawn.stress_maxima import stress_maxima
from verification.running.row import CaseRecord, Row, parameters_of

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
        """Return one part for each known number."""
        known = drawn(self.family, self.seed, self.number)
        started = time.process_time()
        record = CaseRecord(
            parameters=parameters_of(self) | {"solver": known.fineness.solver},
            measures={"per_radius": known.fineness.per_radius},
        )
        try:
            parts = tuple(_judged(known))
        except SolverError as error:
            return record.model_copy(update={"words": {"refused": str(error)}})
        seconds = time.process_time() - started
        return record.model_copy(update={"parts": parts, "seconds": seconds})


def _judged(known: KnownScene) -> Iterator[Row]:
    result, errors = _run(known)
    steps = values_of(result)
    stressed = {truth.step for truth in known.truths if truth.quantity in STRESSES}
    stresses = {step: stress_maxima(result, step, errors) for step in stressed}
    for truth in known.truths:
        if truth.quantity in STRESSES:
            found, stated = stresses[truth.step][truth.quantity]
            yield judged(truth, found, stated)
        elif (found_here := truth.read(steps)) is not None:
            yield judged(truth, found_here, errors.steps[truth.step - 1].get(truth.quantity))


def judged(truth: Truth, found: float, stated: StatedError | None) -> Row:
    """Return the true and the stated error of a number over its true value."""
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


def _run(known: KnownScene) -> tuple[Any, StatedErrors]:
    """Solve a scene and state its errors."""
    asked: Any = known.fineness.asked
    if known.fineness.solver == CELLS:
        result = semi_analytical.solve_discretised(known.scene, asked)
        return result, CellSolver.stated_errors(result)
    method = fem_reference.Method.COMPLEMENTARITY
    on_sections = fem_reference.solve(known.scene, asked, method)
    return on_sections, ElementSolver.stated_errors(on_sections)
