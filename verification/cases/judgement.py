"""Solving a case and judging what came out."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import semi_analytical
from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.summary import EffectSummary
from verification.cases.case import (
    Case,
    Derived,
    Finding,
    OrderOfConvergence,
    Quantity,
    ReferenceKind,
    Run,
)
from verification.cases.outcome import (
    CaseOutcome,
    FindingRecord,
    RunRecord,
    SceneRecord,
    Status,
    Verdict,
)
from verification.cli.scene_text import describe
from verification.convergence import numerical_uncertainty, observed_order
from verification.quantities import largest_residual

if TYPE_CHECKING:
    from semi_analytical import Increment, Result

Results = Mapping[str, "Result"]
Solve = Callable[[Run], "Result"]

# An order is known well enough to be judged if its interval is no wider than this; an observed
# order may differ from the expected one by as much.
ORDER_WIDTH = 0.25
DISCRETISATION = ("cells", "window", "tolerance")
COVERAGE = 2.0  # standard uncertainties in a tolerance


def solve_run(run: Run, progress: Callable[[Increment], None] | None = None) -> Result:
    """Solve one run of a case with the semi-analytical solver."""
    return semi_analytical.solve(run.scene, run.grid, run.tolerance, progress=progress)


def judge(case: Case, solve: Solve = solve_run) -> CaseOutcome:
    """Solve all runs of a case and judge its quantities.

    A run that the solver gives up is a failed verdict, and so is everything measured on it.
    """
    results: dict[str, Result] = {}
    failures: list[Verdict] = []
    for run in case.runs:
        try:
            results[run.label] = solve(run)
        except semi_analytical.SolverError as error:
            failures.append(_unsolved(run, str(error)))
    solved = not failures
    return CaseOutcome(
        name=case.name,
        title=case.title,
        problem=case.problem,
        scenes=_scenes(case, results),
        runs=tuple(_run_record(run, results[run.label]) for run in case.runs if run.label in results),
        verdicts=(
            *failures,
            *(_judge_quantity(q, case, results) for q in case.quantities if _has(q, results)),
            *(_judge_order(o, case, results) for o in case.orders if solved),
            *(_judge_residual(run, results[run.label]) for run in case.runs if run.label in results),
        ),
        findings=tuple(_measure_finding(f, results) for f in case.findings if f.run in results),
        charts=case.charts(results) if case.charts and solved else (),
        limits=case.limits,
    )


def _has(quantity: Quantity, results: Results) -> bool:
    levels = quantity.tolerance.levels if isinstance(quantity.tolerance, Derived) else ()
    return all(label in results for label in (quantity.run, *levels))


def _judge_quantity(quantity: Quantity, case: Case, results: Results) -> Verdict:
    reference, tolerance = quantity.reference, quantity.tolerance
    value = quantity.measure(results[quantity.run])
    scale = abs(reference.value) if quantity.scale is None else quantity.scale
    if isinstance(tolerance, Derived):
        kind, allowed = "derived", _derived_tolerance(quantity, tolerance, case, results, scale)
    else:
        kind, allowed = "required", tolerance.allowed
    error = abs(value - reference.value) / scale
    return Verdict(
        name=quantity.name,
        run=quantity.run,
        meaning=quantity.meaning,
        unit=quantity.unit,
        value=_finite(value),
        reference=reference.value,
        reference_kind=reference.kind,
        source=reference.source,
        error=_finite(error),
        allowed=allowed,
        scale_name=quantity.scale_name,
        tolerance_kind=kind,
        because=tolerance.because,
        status=Status.PASS if error <= allowed else Status.FAIL,  # NaN compares as a failure
    )


def _derived_tolerance(
    quantity: Quantity, tolerance: Derived, case: Case, results: Results, scale: float
) -> float:
    values = [quantity.measure(results[label]) for label in tolerance.levels]
    if not all(map(math.isfinite, values)):
        return tolerance.cap
    u_num = numerical_uncertainty(_spacings(case, tolerance.levels), values, tolerance.order)
    return min(tolerance.cap, COVERAGE * math.hypot(u_num, quantity.reference.uncertainty) / scale)


def _judge_order(study: OrderOfConvergence, case: Case, results: Results) -> Verdict:
    errors = [study.error(results[label]) for label in study.levels]
    known = all(math.isfinite(error) and error > 0 for error in errors)
    observed = observed_order(_spacings(case, study.levels), errors) if known else None
    difference = math.nan if observed is None else abs(observed.order - study.expected)
    if observed is not None and observed.half_width > ORDER_WIDTH:
        status = Status.INCONCLUSIVE
    else:
        status = Status.PASS if difference <= ORDER_WIDTH else Status.FAIL
    return Verdict(
        name=study.name,
        run=f"{study.levels[0]} to {study.levels[-1]}",
        meaning=study.meaning,
        unit="",
        value=None if observed is None else observed.order,
        reference=study.expected,
        reference_kind="theory",
        source=study.because,
        error=_finite(difference),
        allowed=ORDER_WIDTH,
        scale_name="1",
        tolerance_kind="order",
        because=f"an order is judged when its 95 % interval is within ± {ORDER_WIDTH}",
        status=status,
        interval=None if observed is None else observed.half_width,
    )


def _judge_residual(run: Run, result: Result) -> Verdict:
    residual = largest_residual(result)
    return Verdict(
        name="largest_residual",
        run=run.label,
        meaning="largest residual of any kind at the end of any increment",
        unit="",
        value=_finite(residual),
        reference=0.0,
        reference_kind=ReferenceKind.IDENTITY,
        source="the equations of contact, evaluated afresh at the end of every increment",
        error=_finite(residual),
        allowed=run.tolerance,
        scale_name="dimensionless",
        tolerance_kind="required",
        because="every increment ends within the tolerance that was asked for",
        status=Status.PASS if residual <= run.tolerance else Status.FAIL,
    )


def _unsolved(run: Run, message: str) -> Verdict:
    return Verdict(
        name="solved",
        run=run.label,
        meaning=f"the solver gave up: {message}",
        unit="",
        value=None,
        reference=1.0,
        reference_kind=ReferenceKind.IDENTITY,
        source="every run of a case has a solution",
        error=None,
        allowed=run.tolerance,
        scale_name="dimensionless",
        tolerance_kind="required",
        because="a run without a result cannot be judged",
        status=Status.FAIL,
    )


def _measure_finding(finding: Finding, results: Results) -> FindingRecord:
    return FindingRecord(
        name=finding.name,
        run=finding.run,
        meaning=finding.meaning,
        unit=finding.unit,
        value=_finite(finding.measure(results[finding.run])),
        remark=finding.remark,
    )


def _run_record(run: Run, result: Result) -> RunRecord:
    return RunRecord(
        label=run.label,
        cells=run.grid.cells,
        window=run.grid.window,
        tolerance=run.tolerance,
        increments=len(result.increments),
        iterations=sum(increment.iterations for increment in result.increments),
        convolutions=int(sum(increment.convolutions for increment in result.increments)),
        largest_residual=_finite(largest_residual(result)),
    )


def _scenes(case: Case, results: Results) -> tuple[SceneRecord, ...]:
    """The scenes of a case, each once, with what the solver planned for them."""
    records: dict[Scene, SceneRecord] = {}
    for run in case.runs:
        if run.label in results and run.scene not in records:
            effects = results[run.label].plan.effects
            records[run.scene] = SceneRecord(
                lines=_scene_lines(run.scene),
                effects=tuple(EffectSummary(name=e.name, on=e.on, why=e.why) for e in effects),
            )
    return tuple(records.values())


def _scene_lines(scene: Scene) -> tuple[tuple[str, str], ...]:
    """What the scene says, without the discretisation: a case has its own grids."""
    lines = describe(scene, SurfaceDiscretisation())
    return tuple((word, text) for word, text in lines if word not in DISCRETISATION)


def _spacings(case: Case, levels: tuple[str, ...]) -> list[float]:
    return [max(case.run(label).grid.spacing) for label in levels]


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
