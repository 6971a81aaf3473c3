"""Comparison of the errors that the solvers state with the actual errors of judged numbers.

A stated error covers a number if |value - reference| ≤ stated error + uncertainty of the reference.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedErrors,
)
from verification.judging.case import Case, Quantity
from verification.judging.outcome import CaseOutcome, Verdict
from verification.judging.run import BY_DEFAULT, AnyRun, RadiiRun, Run

# Smallest accepted fraction of covered numbers in a report of all cases at the full level.
LEAST_SHARE = 0.95


def stated_errors(case: Case, results: Mapping[str, Any]) -> dict[str, StatedErrors]:
    """Compute the error estimates that the solvers state for the runs of a case.

    case     verification case
    results  results of the solved runs, by label of the run

    Only runs on which the case judges a registered scalar are included. Runs on cells with another
    than the default edge correction are left out, because users do not run them. The keys of the
    returned mapping are the labels of the runs.
    """
    judged = {q.run for q in case.quantities if q.scalar is not None} & results.keys()
    return {
        run.label: _stated(run, results[run.label])
        for run in case.runs
        if run.label in judged and (not isinstance(run, Run) or run.edge == BY_DEFAULT)
    }


def _stated(run: AnyRun, result: Any) -> StatedErrors:
    if isinstance(run, Run):
        from contact_errors.on_cells import CellSolver

        return CellSolver.stated_errors(result)
    if isinstance(run, RadiiRun):
        from contact_errors.on_radii import RingSolver

        return RingSolver.stated_errors(result)
    from contact_errors.on_elements import ElementSolver

    return ElementSolver.stated_errors(result)


def error_of(quantity: Quantity, errors: StatedErrors | None) -> float | None:
    """Return the stated error of a judged number, in the unit of the number.

    The result is None if the number is no registered scalar, if the run has no stated errors, or if
    the status of the error is not ESTIMATED.

    quantity  judged quantity of a case
    errors    stated errors of the run on which the quantity is measured; None if there are none
    """
    if quantity.scalar is None or errors is None:
        return None
    name, component, step = quantity.scalar
    found = errors.steps[step].get(name)
    if found is None or found.error is None or found.status is not ErrorStatus.ESTIMATED:
        return None
    return float(np.ravel(found.error)[component])


def judged_errors(cases: tuple[CaseOutcome, ...]) -> Iterator[tuple[CaseOutcome, Verdict]]:
    """Yield all verdicts on numbers with a stated error, each together with the outcome of its
    case."""
    for case in cases:
        yield from ((case, verdict) for verdict in case.verdicts if verdict.covered is not None)


def share_covered(cases: tuple[CaseOutcome, ...]) -> float:
    """Return the fraction of the stated errors that cover the actual error, over all given cases.

    Numbers without a stated error do not count. The fraction is 1 if there are no stated errors.
    """
    found = [verdict.covered for _, verdict in judged_errors(cases)]
    return sum(map(bool, found)) / len(found) if found else 1.0
