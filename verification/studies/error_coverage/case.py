"""Cases of the error-coverage study: a random scene of known answer, its stated and true errors.

Each scene is solved as `slipstick run` solves it.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import betaincinv

import fem_reference
import semi_analytical
from contact_errors.error_formula import values_of
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import ElementSolver
from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
    StatedErrors,
)
from contact_scene.solver_errors import SolverError
from verification.problems.drawn.drawing import CELLS, STRESSES, KnownScene, Truth
from verification.problems.drawn.families import drawn
from verification.problems.drawn.references import stress_maxima
from verification.running.study import CaseRecord, Row, parameters_of, value_of

WRONG, STATED, UNCERTAIN = "wrong", "stated", "uncertain"


@dataclass(frozen=True)
class CoverageCase:
    """Identify a random scene by its family, the seed of the generator and its number in the
    family.
    """

    family: str
    seed: int
    number: int

    @property
    def name(self) -> str:
        return f"{self.family}-{self.seed}-{self.number}"

    def compute(self) -> CaseRecord:
        """Solve the scene and record the true and the stated error of each result whose value is
        known.

        The text of a solver error is recorded instead if the solver refuses the scene.
        """
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
    """Return the true error, the stated error and the uncertainty of the reference of one result.

    All three are divided by the reference value.

    truth   known value: quantity, load step and reference with uncertainty
    found   computed value, in the unit of the reference
    stated  error that the run states for the value; None if it states none
    """
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
    """Solve a scene with a known solution on cells or finite elements, and estimate the errors of
    its results.
    """
    asked: Any = known.fineness.asked
    if known.fineness.solver == CELLS:
        result = semi_analytical.solve_discretised(known.scene, asked)
        return result, CellSolver.stated_errors(result)
    method = fem_reference.Method.COMPLEMENTARITY
    on_sections = fem_reference.solve(known.scene, asked, method)
    return on_sections, ElementSolver.stated_errors(on_sections)


CONFIDENCE = 0.95
COVERED, COVERED_IN_ALL = 0.95, 0.97
TIMES = 10.0  # limit of stated over true error for a tight stated error
TIGHT = 0.6
CERTAIN = 0.1  # limit of the uncertainty of a reference over the stated error
MISSED = 3.0  # uncertainties above the stated error for a certain verdict
BELIEVED = str(ErrorStatus.ESTIMATED), str(ErrorStatus.EXACT)
DOUBTED = str(ErrorStatus.NOT_CONVERGED)


@dataclass(frozen=True)
class Share:
    """Represent the observed fraction `count / of`, with its Clopper-Pearson interval (1934)."""

    count: int
    of: int

    @property
    def part(self) -> float:
        """Observed fraction `count / of` [1]; 1 if nothing was counted."""
        return self.count / self.of if self.of else 1.0

    @property
    def interval(self) -> tuple[float, float]:
        """Two-sided 95 % confidence interval of the fraction: 2.5 % lie outside each end."""
        k, n, tail = self.count, self.of, (1 - CONFIDENCE) / 2
        low = float(betaincinv(k, n - k + 1, tail)) if k else 0.0
        high = float(betaincinv(k + 1, n - k, 1 - tail)) if k < n else 1.0
        return low, high

    @property
    def text(self) -> str:
        """Fraction and its 95 % interval as text, such as 0.962 [0.931, 0.981]."""
        low, high = self.interval
        return f"{self.part:.3f} [{low:.3f}, {high:.3f}]"


@dataclass(frozen=True)
class Coverage:
    """Count how many stated errors of a group of results cover the true error.

    A result is decided if the uncertainty of its reference permits a verdict.

    group       name of the group: a kind of quantity or a family of scenes
    covered     decided results with an estimated or exact error whose true error is covered
    tight       of the same results, those whose stated error is less than 10 times the true one
    apart       covered results among the decided ones with status "not converged"
    undecided   number of results whose reference is too uncertain for a verdict
    not_stated  number of results without a stated error
    """

    group: str
    covered: Share
    tight: Share
    apart: Share
    undecided: int
    not_stated: int

    @classmethod
    def of(cls, group: str, rows: Sequence[Row]) -> Coverage:
        """Count the stated errors of a group of results that cover the true error, and those that
        do not.

        group  name of the group
        rows   one row per result, with true error, stated error and uncertainty of the reference
        """
        having = [row for row in rows if row.measures[STATED] is not None]
        certain = [row for row in having if is_decided(row)]
        believed = [row for row in certain if row.words["status"] in BELIEVED]
        doubted = [row for row in certain if row.words["status"] == DOUBTED]
        return cls(
            group,
            Share(sum(map(covers, believed)), len(believed)),
            Share(sum(map(is_tight, believed)), len(believed)),
            Share(sum(map(covers, doubted)), len(doubted)),
            len(having) - len(certain),
            len(rows) - len(having),
        )


def covers(row: Row) -> bool:
    """Determine if the true error is at most the stated error plus the uncertainty of the
    reference.
    """
    return value_of(row, WRONG) <= value_of(row, STATED) + value_of(row, UNCERTAIN)


def is_tight(row: Row) -> bool:
    """Determine if the stated error of a result is less than 10 times its true error, hence not
    excessive.
    """
    return value_of(row, STATED) < TIMES * value_of(row, WRONG)


def is_decided(row: Row) -> bool:
    """Determine if the reference of a result is certain enough to judge the stated error.

    The uncertainty of the reference must be at most 0.1 of the stated error. Otherwise the true
    error must exceed the stated error by more than 3 uncertainties, so that it is certainly not
    covered.
    """
    stated, uncertain = value_of(row, STATED), value_of(row, UNCERTAIN)
    return uncertain <= CERTAIN * stated or value_of(row, WRONG) > stated + MISSED * uncertain


def grouped(rows: Iterable[tuple[str, Row]]) -> dict[str, Coverage]:
    """Count, in each group of results, how often stated errors cover true errors.

    rows  pairs of the name of a group and the row of one result
    """
    groups: dict[str, list[Row]] = {}
    for name, row in rows:
        groups.setdefault(name, []).append(row)
    return {name: Coverage.of(name, members) for name, members in groups.items()}
