"""Verdicts of a verification case: measured numbers are compared with references and tolerances."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from verification.convergence.observed_order import (
    ORDER_OFF,
    ORDER_WIDTH,
    by_size,
    numerical_uncertainty,
    observed_order,
)
from verification.judging.case import (
    Case,
    Derived,
    Order,
    Quantity,
    Required,
)
from verification.judging.outcome import (
    RESIDUAL,
    SOLVED,
    OrderRecord,
    Status,
    Verdict,
    order_status,
)
from verification.judging.run import AnyRun
from verification.problems.problem import ReferenceKind, identity
from verification.quantities import largest_residual

Results = Mapping[str, Any]

# Coverage factor: number of standard uncertainties in a tolerance.
COVERAGE = 2.0


def judge_quantity(
    quantity: Quantity, case: Case, results: Results, stated: float | None = None
) -> Verdict:
    """Judge a number against its reference.

    A value that is not finite fails. A tolerance that is derived from refinement is computed first.

    quantity  measured number, reference and tolerance
    case      case of the quantity
    results   results of the solved runs, by label of the run
    stated    error estimate of the solver for the value, in the unit of the value; None if there is
              none
    """
    tolerance = quantity.tolerance
    if isinstance(tolerance, Derived):
        u = expanded_uncertainty(quantity, tolerance, case, results) / _error_scale(quantity)
        kind, allowed = "derived", min(tolerance.cap, u)
    else:
        kind, allowed = "required", tolerance.allowed
    value = quantity.measure(*(results[label] for label in quantity.labels))
    known = None if stated is None else stated + quantity.reference.uncertainty
    covered = None if known is None else abs(value - quantity.reference.value) <= known
    return _make_verdict(quantity, value, kind, allowed).model_copy(
        update={"stated_error": stated, "covered": covered}
    )


def _error_scale(quantity: Quantity) -> float:
    """Return the number by which the error of a quantity is divided, in the unit of the quantity.

    The number is the scale that the case defines, else the magnitude of the reference.
    """
    return abs(quantity.reference.value) if quantity.scale is None else quantity.scale


def _make_verdict(quantity: Quantity, value: float, kind: str, allowed: float) -> Verdict:
    reference, scale = quantity.reference, _error_scale(quantity)
    error = abs(value - reference.value) / scale
    return Verdict(
        name=quantity.name,
        run=quantity.run,
        runs=quantity.labels,
        meaning=quantity.meaning,
        unit=quantity.unit,
        value=finite(value),
        reference=reference.value,
        reference_kind=reference.kind,
        source=reference.source,
        reference_uncertainty=reference.uncertainty or None,
        error=finite(error),
        allowed=allowed,
        scale=scale,
        scale_name=quantity.scale_name,
        tolerance_kind=kind,
        because=quantity.tolerance.because,
        status=Status.PASS if error <= allowed else Status.FAIL,  # NaN compares as a failure
    )


def expanded_uncertainty(
    quantity: Quantity, tolerance: Derived, case: Case, results: Results
) -> float:
    """Compute the expanded uncertainty 2 √(u_num² + u_ref²) of a measured number, in its unit.

    u_num is the numerical uncertainty, estimated from the values on several refinement levels.
    u_ref is the uncertainty of the reference. The result is infinite if a value is not finite.

    quantity   measured number with its reference
    tolerance  refinement levels and expected order of convergence
    case       case of the quantity
    results    results of the solved runs, by label of the run
    """
    values = [quantity.measure(results[label]) for label in tolerance.levels]
    if not all(map(math.isfinite, values)):
        return math.inf
    u_num = numerical_uncertainty(_run_spacings(case, tolerance.levels), values, tolerance.order)
    return COVERAGE * math.hypot(u_num, quantity.reference.uncertainty)


def judge_order(study: Order, case: Case, results: Results) -> Verdict:
    """Judge an observed order of convergence against the expected order.

    The verdict is INCONCLUSIVE if the 95 % interval of the observed order is too wide. The verdict
    is a failure if an error is zero or not finite.

    study    expected order, and the error whose decrease is observed
    case     case of the order
    results  results of the solved runs, by label of the run
    """
    sizes, errors = _sizes_and_errors(study, case, results)
    known = all(math.isfinite(error) and error > 0 for error in errors)
    observed = observed_order(sizes, errors) if known else None
    difference = math.nan if observed is None else abs(observed.order - study.expected)
    off = 0.0 if study.not_yet is None else study.not_yet.allowance
    kept = False if observed is None else observed.keeps(study.expected, off)
    runs = "" if study.apart or len(errors) == len(study.levels) else (
        f", each the root mean square of {len(study.levels) / len(errors):.3g} runs"
    )  # fmt: skip
    return Verdict(
        name=study.name,
        run=f"{study.levels[0]} to {study.levels[-1]}",
        runs=study.levels,
        meaning=f"order of convergence: {study.meaning}",
        unit="",
        value=None if observed is None else observed.order,
        reference=study.expected,
        reference_kind=ReferenceKind.THEORY,
        source=study.because,
        error=finite(difference),
        allowed=ORDER_OFF if observed is None else observed.may_be_off_by(study.expected, off),
        scale=1.0,
        scale_name="1",
        tolerance_kind="order",
        because=f"an order passes where it is at 95 % no lower than {ORDER_OFF} below what is "
        f"promised{_asymptotic_text(study)}, and not known to be as much higher; it is "
        f"judged where its 95 % interval is no wider than ± {ORDER_WIDTH}; "
        f"{len(errors)} {'changes' if study.apart else 'levels'}{runs}",
        status=order_status(kept),
        interval=None if observed is None else observed.half_width,
        margin=None if observed is None else observed.margin,
        order=OrderRecord(
            of=study.of,
            meaning=study.meaning,
            solver=case.run(study.levels[0]).solver,
            refined=study.refined,
            sizes=tuple(sizes),
            errors=tuple(errors) if known else (),
        ),
    )


def _asymptotic_text(study: Order) -> str:
    known = study.not_yet
    return "" if known is None else f", here {known.allowance:g}, as {known.because}"


def _sizes_and_errors(
    study: Order, case: Case, results: Results
) -> tuple[list[float], list[float]]:
    """Return the discretisation sizes h, coarse to fine, and the errors or changes at these sizes.

    The sizes are cell or element sides, or the sizes that an order of changes defines. Runs of one
    size are combined by the root mean square of their errors.
    """
    levels = [results[label] for label in study.levels]
    if study.size is not None:
        pairs = list(zip(levels, levels[study.apart :], strict=False))
        return [study.size(one) for one, _ in pairs], [study.error(*pair) for pair in pairs]
    return by_size(_run_spacings(case, study.levels), [study.error(level) for level in levels])


def judge_residuals(case: Case, results: Results) -> Verdict:
    """Judge the largest residual of all increments of all solved runs of a case.

    The residual is that of the contact and friction equations. It is compared with the tolerance of
    its run.
    """
    found = {r.label: largest_residual(results[r.label]) for r in case.runs if r.label in results}
    return judge_worst(
        case, found, RESIDUAL, "largest residual of any increment of the {runs} run(s); it is in "
        "this one", "the equations of contact and friction, evaluated afresh after every increment",
        "every increment ends within the tolerance that was asked for", lambda run: run.tolerance,
    )  # fmt: skip


def judge_worst(
    case: Case,
    found: Mapping[str, float],
    name: str,
    meaning: str,
    source: str,
    because: str,
    allowed: Callable[[AnyRun], float],
    where: Mapping[str, str] = MappingProxyType({}),
) -> Verdict:
    """Judge the worst of several numbers that should be zero, one number for each run.

    The worst number has the largest ratio to the accepted value of its run. NaN counts as the
    worst.

    case     verification case
    found    numbers, by label of the run
    name     name of the verdict
    meaning  description, with placeholders {runs} for the number of runs and {where} for the place
    source   law or equation that predicts zero
    because  reason for the accepted values
    allowed  function from a run to its accepted value
    where    place of the number in the run, by label of the run
    """
    ratio = {label: value / allowed(case.run(label)) for label, value in found.items()}
    worst = max(ratio, key=lambda label: (math.isnan(ratio[label]), ratio[label]))
    said = meaning.format(runs=len(found), where=where.get(worst, ""))
    return _judge_zero(name, said, worst, found[worst], source, allowed(case.run(worst)), because)


def unsolved(run: AnyRun, message: str) -> Verdict:
    """Create the failed verdict on a run that the solver did not solve, with the message of the
    solver.
    """
    return lost(run.label, f"the solver gave up: {message}", "run", run.tolerance)


def lost(where: str, meaning: str, what: str, tolerance: float = 1.0) -> Verdict:
    """Create the failed verdict on a run or case that has no result.

    where      label of the run, or name of the case
    meaning    description of the failure
    what       "run" or "case"
    tolerance  tolerance that the verdict shows
    """
    return _judge_zero(
        SOLVED, meaning, where, math.nan, "every run of a case has a solution", tolerance,
        f"a {what} without a result cannot be judged",
    )  # fmt: skip


def _judge_zero(
    name: str, meaning: str, run: str, value: float, source: str, allowed: float, because: str
) -> Verdict:
    """Judge a dimensionless number that the equations require to be zero.

    name     name of the verdict
    meaning  description of the number
    run      label of the run on which the number was measured
    value    measured number
    source   law or equation that predicts zero
    allowed  largest accepted value
    because  reason for the accepted value
    """
    zero = Quantity(
        name, meaning, "", run, lambda: value, identity(0.0, source), Required(allowed, because),
        1.0, "dimensionless", runs=(),
    )  # fmt: skip
    return _make_verdict(zero, value, "required", allowed)


def finite(value: float) -> float | None:
    """Convert a number to the form stored in records: None in place of NaN and infinity."""
    return float(value) if math.isfinite(value) else None


def _run_spacings(case: Case, levels: tuple[str, ...]) -> list[float]:
    return [case.run(label).spacing for label in levels]
