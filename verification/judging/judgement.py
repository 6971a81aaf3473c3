"""Solution of the runs of a verification case, and judgement of its numbers.

Measured numbers are compared with references and tolerances.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from contact_errors import coarse_solves
from contact_results.solvers import solver_of
from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.quantities.stated_error import ErrorStatus, StatedErrors
from contact_scene.quantities.summary import EffectSummary
from contact_scene.reading.scene_text import describe
from contact_scene.solver_errors import SolverError
from verification.convergence.observed_order import (
    ORDER_OFF,
    ORDER_WIDTH,
    by_size,
    numerical_uncertainty,
    observed_order,
)
from verification.judging.case import (
    OTHER_NORMS,
    OVER_ANGLES,
    OVER_RINGS,
    AnyRun,
    Case,
    Derived,
    Order,
    Quantity,
    Required,
    Run,
    computed_error,
)
from verification.judging.outcome import (
    IMBALANCE,
    RESIDUAL,
    SOLVED,
    VIOLATION,
    CaseOutcome,
    OrderRecord,
    RunRecord,
    SceneRecord,
    Status,
    Verdict,
    finite,
    status_of_difference,
)
from verification.judging.tested_parameters import dimensionless_parameters
from verification.observed.contact_state import Imbalance
from verification.observed.observed_laws import Observed, observed
from verification.problems.problem import NUMERICAL, ROUNDING, ReferenceKind, identity
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
        status=status_of_difference(error, allowed, reference.uncertainty / scale),
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
    off, allowance = 0.0, ""
    if study.not_yet is not None:
        off = study.not_yet.allowance
        allowance = f", here {off:g}, as {study.not_yet.because}"
    kept: bool | None = False
    found: dict[str, Any] = {"value": None, "error": None, "allowed": ORDER_OFF}
    if known:
        observed = observed_order(sizes, errors)
        kept = observed.keeps(study.expected, off)
        found = {
            "value": observed.order,
            "error": abs(observed.order - study.expected),
            "allowed": observed.may_be_off_by(study.expected, off),
            "interval": observed.half_width,
            "margin": observed.margin,
        }
    runs = ""
    if not study.apart and len(errors) < len(study.levels):
        runs = f", each the root mean square of {len(study.levels) / len(errors):.3g} runs"
    return Verdict(
        name=study.name,
        run=f"{study.levels[0]} to {study.levels[-1]}",
        runs=study.levels,
        meaning=f"order of convergence: {study.meaning}",
        unit="",
        reference=study.expected,
        reference_kind=ReferenceKind.THEORY,
        source=study.because,
        scale=1.0,
        scale_name="1",
        tolerance_kind="order",
        because=f"an order passes where it is at 95 % no lower than {ORDER_OFF} below what is "
        f"promised{allowance}, and not known to be as much higher; it is "
        f"judged where its 95 % interval is no wider than ± {ORDER_WIDTH}; "
        f"{len(errors)} {'changes' if study.apart else 'levels'}{runs}",
        status=Status.of(kept),
        order=OrderRecord(
            of=study.of,
            meaning=study.meaning,
            solver=case.run(study.levels[0]).solver,
            refined=study.refined,
            sizes=tuple(sizes),
            errors=tuple(errors) if known else (),
        ),
        **found,
    )


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
        case,
        found,
        RESIDUAL,
        "largest residual of any increment of the {runs} run(s); it is in this one",
        "the equations of contact and friction, evaluated afresh after every increment",
        "every increment ends within the tolerance that was asked for",
        lambda run: run.tolerance,
    )


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
    worst. Numbers that are round-off are equal.

    case     verification case
    found    numbers, by label of the run
    name     name of the verdict
    meaning  description, with placeholders {runs} for the number of runs and {where} for the place
    source   law or equation that predicts zero
    because  reason for the accepted values
    allowed  function from a run to its accepted value
    where    place of the number in the run, by label of the run
    """

    def share(label: str) -> float:
        """Number over its accepted value; 0 if it is round-off."""
        limit = allowed(case.run(label))
        return 0.0 if found[label] < min(ROUNDING, limit) else found[label] / limit

    ratio = {label: share(label) for label in found}
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
        SOLVED,
        meaning,
        where,
        math.nan,
        "every run of a case has a solution",
        tolerance,
        f"a {what} without a result cannot be judged",
    )


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
    zero = computed_error(
        name,
        meaning,
        run,
        lambda: value,
        identity(0.0, source),
        Required(allowed, because),
        "dimensionless",
    )
    return _make_verdict(zero, value, "required", allowed)


def _run_spacings(case: Case, levels: tuple[str, ...]) -> list[float]:
    return [case.run(label).spacing for label in levels]


WITHIN = (
    f"on cells and elements within {OTHER_NORMS:g} times the tolerance, as the norms of the solver "
    f"are others; on radii within what sums over rings and angles leave: "
    f"{OVER_RINGS:g}, or {OVER_ANGLES:g} where the solver interpolates between angles"
)


def judge_laws(case: Case, results: Mapping[str, Any]) -> tuple[Verdict, ...]:
    """Judge the laws of contact and friction, and the energy balance, in the results of all runs.

    Returns one verdict on the largest violation of a law, and one on the largest energy imbalance.
    Each number is compared with the tolerance of its run.

    case     verification case
    results  results of the solved runs, by label of the run
    """
    found = {run.label: observed(results[run.label]) for run in case.runs if run.label in results}
    violated = {label: laws.violation for label, laws in found.items()}
    missing = {label: laws.imbalance for label, laws in found.items()}
    return (
        judge_worst(
            case,
            violated,
            VIOLATION,
            "largest violation of a law of contact and friction in any "
            "increment of the {runs} run(s); it is in this one"
            + _exclusion_text("slip", found, results),
            "gap, overlap, friction, slip against shear, forces, moments and energy lost, found "
            "again in the fields",
            WITHIN,
            lambda run: run.laws,
        ),
        judge_worst(
            case,
            missing,
            IMBALANCE,
            "largest part of the energy that any increment cannot "
            "account for of the {runs} run(s); it is in this one{where}"
            + _exclusion_text("energy", found, results),
            "first law: work put in is stored, dissipated or left open by the increment",
            f"residuals within the tolerance move the energy by a few times as much; {WITHIN}",
            lambda run: run.energy,
            {
                label: f", {part.terms}"
                for label, part in missing.items()
                if isinstance(part, Imbalance) and part > ROUNDING
            },
        ),
    )


def _exclusion_text(what: str, found: Mapping[str, Observed], results: Mapping[str, Any]) -> str:
    """Describe in how many increments slip or energy could not be fully compared, and why.

    The text is added to the verdict on the laws.

    what     "slip" or "energy"
    found    evaluated laws, by label of the run
    results  results of the solved runs, by label of the run
    """
    total = sum(len(results[label].increments) for label in found)
    counts = sum((getattr(laws, f"of_{what}") for laws in found.values()), Counter[str]())
    return "".join(
        f"; {what} is not fully compared in {count} of {total} increments, as {reason}"
        for reason, count in counts.items()
    )


Solve = Callable[[AnyRun], Any]

# Keys in the description of a scene file that concern the discretisation or the title.
DISCRETISATION = ("title", "cells", "window", "tolerance", "path accuracy")


def judge(case: Case, solve: Solve = lambda run: run.solve()) -> CaseOutcome:
    """Solve all runs of a verification case and judge its quantities, orders and checks.

    A run for which the solver fails becomes a failed verdict. Quantities of that run are left out.

    case   verification case
    solve  function that solves one run
    """
    results: dict[str, Any] = {}
    failures: list[Verdict] = []
    for run in case.runs:
        try:
            results[run.label] = solve(run)
        except SolverError as error:
            failures.append(unsolved(run, str(error)))
    return CaseOutcome(
        name=case.name,
        title=case.title,
        problem=case.problem,
        scenes=_describe_scenes(case, results),
        runs=tuple(_run_record(r, case, results[r.label]) for r in case.runs if r.label in results),
        verdicts=(*failures, *_judge_case(case, results)),
        charts=case.charts(results) if case.charts and not failures else (),
        limits=case.limits,
        equations=case.equations,
        no_order=case.no_order,
    )


def stated_errors(case: Case, results: Mapping[str, Any]) -> dict[str, StatedErrors]:
    """Compute the error estimates that the solvers state for the runs of a case, by label of the
    run.

    Only runs on which the case judges a registered scalar are included. Runs on cells with another
    than the default edge correction are left out, because users do not run them.

    case     verification case
    results  results of the solved runs, by label of the run
    """
    judged = {q.run for q in case.quantities if q.scalar is not None} & results.keys()
    return {
        run.label: coarse_solves.stated_errors(results[run.label])
        for run in case.runs
        if run.label in judged and run.as_users
    }


def with_uncertainty(quantity: Quantity, case: Case, results: dict[str, Any]) -> Quantity:
    """Return a quantity whose numerical reference has an uncertainty.

    The reference is the last measured run. Its difference from a solve with half the cells,
    elements or rings and equal increments bounds its error, if this falls with first or higher
    order. The bound is the expanded uncertainty.

    quantity  measured number, which is a difference of two runs
    case      case of the quantity
    results   results of the solved runs, by label of the run; a coarse solve is added to them
    """
    if quantity.reference.uncertainty or quantity.reference.kind not in NUMERICAL:
        return quantity
    label = quantity.labels[-1]
    coarse = quantity.coarse or f"{label}, half as fine"
    if coarse not in results:
        solver = solver_of(results[label])
        space = solver.coarser(results[label], 1 / 2, 0)
        results[coarse] = solver.solve(replace(solver.fineness_of(results[label]), space=space))
    bound = quantity.measure(results[coarse], results[label])
    known = replace(quantity.reference, uncertainty=max(bound / COVERAGE, ROUNDING))
    return replace(quantity, reference=known)


def error_of(quantity: Quantity, errors: StatedErrors | None) -> float | None:
    """Return the error that the solver states for a judged number, in the unit of the number.

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


def _judge_case(case: Case, results: Results) -> tuple[Verdict, ...]:
    solved = dict(results)
    measured = [
        with_uncertainty(q, case, solved)
        for q in case.quantities
        if _required_runs(q) <= results.keys()
    ]
    stated = stated_errors(case, results)
    studied = [study for study in case.orders if set(study.levels) <= results.keys()]
    return (
        *(judge_quantity(q, case, results, error_of(q, stated.get(q.run))) for q in measured),
        *(judge_order(study, case, results) for study in studied),
        *([judge_residuals(case, results), *judge_laws(case, results)] if results else []),
    )


def _required_runs(quantity: Quantity) -> set[str]:
    """Return the labels of all runs that must be solved for the verdict on a quantity.

    A tolerance that is derived from refinement also needs the runs of all levels.
    """
    levels = quantity.tolerance.levels if isinstance(quantity.tolerance, Derived) else ()
    return {*quantity.labels, *levels}


def _run_record(run: AnyRun, case: Case, result: Any) -> RunRecord:
    # Fields that not every solver has, for those that lack them.
    own = {"cells": None, "window": None, "convolutions": 0, **run.record(result)}
    return RunRecord(
        label=run.label,
        problem=run.problem,
        planned=_planned_run(run, case),
        tolerance=run.tolerance,
        increments=len(result.increments),
        iterations=sum(increment.iterations for increment in result.increments),
        largest_residual=finite(largest_residual(result)),
        parameters=dimensionless_parameters(run.scene, result) if run.as_users else {},
        **own,
    )


def _planned_run(run: AnyRun, case: Case) -> str | None:
    """Return the label of the run that solves the same scene with the effects that the solver
    chooses.

    A run may switch physical effects on that the scene does not need. The result is None if the
    given run does not, or if the case has no counterpart.
    """
    if not isinstance(run, Run) or run.effects is None:
        return None
    same = (one for one in case.runs if replace(run, label=one.label, effects=None) == one)
    return next((one.label for one in same), None)


def _describe_scenes(case: Case, results: Results) -> tuple[SceneRecord, ...]:
    """Describe each scene of a case in words, with the physical effects that the solver computes.

    case     verification case
    results  results of the solved runs, by label of the run; other scenes are left out
    """
    records: dict[Scene, SceneRecord] = {}
    for run in case.runs:
        if run.label in results and run.scene not in records:
            effects = results[run.label].plan.effects
            lines = describe(run.scene, SurfaceDiscretisation())
            records[run.scene] = SceneRecord(
                title=run.scene.title,
                lines=tuple(line for line in lines if line[0] not in DISCRETISATION),
                effects=tuple(EffectSummary(name=e.name, on=e.on, why=e.why) for e in effects),
            )
    return tuple(records.values())
