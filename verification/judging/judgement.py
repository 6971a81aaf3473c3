"""Solution of the runs of a verification case, and collection of its verdicts and charts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.quantities.stated_error import ErrorStatus, StatedErrors
from contact_scene.quantities.summary import EffectSummary
from contact_scene.reading.scene_text import describe
from contact_scene.solver_errors import SolverError
from verification.judging.case import Case, Derived, Finding, Quantity
from verification.judging.outcome import (
    IMBALANCE,
    VIOLATION,
    CaseOutcome,
    FindingRecord,
    RunRecord,
    SceneRecord,
    Verdict,
)
from verification.judging.run import (
    BY_DEFAULT,
    OTHER_NORMS,
    OVER_ANGLES,
    OVER_RINGS,
    AnyRun,
    RadiiRun,
    Run,
    SectionRun,
)
from verification.judging.verdicts import (
    finite,
    judge_order,
    judge_quantity,
    judge_residuals,
    judge_worst,
    unsolved,
)
from verification.observed.contact_state import Imbalance
from verification.observed.laws import Observed, observed
from verification.quantities import largest_residual

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
            case, violated, VIOLATION, "largest violation of a law of contact and friction in any "
            "increment of the {runs} run(s); it is in this one"
            + _exclusion_text("slip", found, results),
            "gap, overlap, friction, slip against shear, forces, moments and energy lost, found "
            "again in the fields",
            WITHIN, lambda run: run.laws,
        ),
        judge_worst(
            case, missing, IMBALANCE, "largest part of the energy that any increment cannot "
            "account for of the {runs} run(s); it is in this one{where}"
            + _exclusion_text("energy", found, results),
            "first law: work put in is stored, dissipated or left open by the increment",
            f"residuals within the tolerance move the energy by a few times as much; {WITHIN}",
            lambda run: run.energy,
            {label: f", {e.terms}" for label, e in missing.items() if isinstance(e, Imbalance)},
        ),
    )  # fmt: skip


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


Results = Mapping[str, Any]
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
        findings=tuple(_measure_finding(f, results) for f in case.findings if f.run in results),
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
        run.label: _solver_errors(run, results[run.label])
        for run in case.runs
        if run.label in judged and (not isinstance(run, Run) or run.edge == BY_DEFAULT)
    }


def _solver_errors(run: AnyRun, result: Any) -> StatedErrors:
    if isinstance(run, Run):
        from contact_errors.on_cells import CellSolver

        return CellSolver.stated_errors(result)
    if isinstance(run, RadiiRun):
        from contact_errors.on_radii import RingSolver

        return RingSolver.stated_errors(result)
    from contact_errors.on_elements import ElementSolver

    return ElementSolver.stated_errors(result)


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
    measured = [q for q in case.quantities if _required_runs(q) <= results.keys()]
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


def _measure_finding(finding: Finding, results: Results) -> FindingRecord:
    return FindingRecord(
        name=finding.name,
        run=finding.run,
        meaning=finding.meaning,
        unit=finding.unit,
        value=finite(finding.measure(results[finding.run])),
        remark=finding.remark,
    )


def _run_record(run: AnyRun, case: Case, result: Any) -> RunRecord:
    grid = run.grid if isinstance(run, Run) else None
    mesh = run.discretisation if isinstance(run, SectionRun) else None
    return RunRecord(
        label=run.label,
        cells=grid.cells if grid else None,
        window=grid.window if grid else None,
        elements_per_radius=mesh.elements_per_radius if mesh else None,
        rings=run.rings if isinstance(run, RadiiRun) else None,
        method=run.method if isinstance(run, SectionRun) else None,
        problem=run.problem,
        planned=_planned_run(run, case),
        tolerance=run.tolerance,
        increments=len(result.increments),
        iterations=sum(increment.iterations for increment in result.increments),
        convolutions=sum(i.convolutions for i in result.increments) if grid else 0,
        factorizations=sum(i.factorizations for i in result.increments) if mesh else 0,
        largest_residual=finite(largest_residual(result)),
        edge_change=max(i.edge_change or 0.0 for i in result.increments) if grid else 0.0,
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
