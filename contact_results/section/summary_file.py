"""`summary.json` of a result on a section: the same keys as for every solver."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from contact_results.directory.file_names import SUMMARY
from contact_results.section.fretting_cycles import SectionCycle, section_cycles
from contact_scene.linear_theory import beyond_linear_theory
from contact_scene.summary import (
    EffectSummary,
    Residuals,
    RunSummary,
    StepSummary,
    dump_summary,
)
from fem_reference import Increment, Method, Result
from fem_reference.energy import elastic_energy, input_work


def solver_name(method: Method) -> str:
    """What a summary calls the solver."""
    return f"fem_reference.{method.value}"


def write_section_summary(result: Result, method: Method, directory: Path) -> None:
    """Write the summary; equal results give equal bytes."""
    text = dump_summary(section_summary(result, method))
    (directory / SUMMARY).write_text(text, encoding="utf-8")


def section_summary(result: Result, method: Method) -> RunSummary:
    """The record that all solvers share. What a section does not have is null: cells, window,
    convolutions, and the elastic energy of paths with shear."""
    closed = {cycle.cycle.end: cycle for cycle in section_cycles(result)}
    worked = zip(result.increments, input_work(result.increments), strict=True)
    return RunSummary(
        title=result.scene.title,
        solver=solver_name(method),
        tolerance=result.discretisation.tolerance,
        effects=tuple(EffectSummary(name=e.name, on=e.on, why=e.why) for e in result.plan.effects),
        steps=tuple(
            _step_summary(result, list(within), closed.get(step))
            for step, within in groupby(worked, lambda pair: pair[0].step)
        ),
        remarks=beyond_linear_theory(result.scene, result.steps),
    )


def _step_summary(
    result: Result,
    within: Sequence[tuple[Increment, float | None]],
    cycle: SectionCycle | None,
) -> StepSummary:
    """The state at the end of a step, the cost of its increments taken together."""
    end, work = within[-1]
    increments = [increment for increment, _ in within]
    return StepSummary(
        normal_force=end.normal_force,
        approach=end.approach,
        contact_area=end.contact_area,
        contact_radius=end.contact_radius,
        peak_pressure=end.peak_pressure,
        tangential_force=end.tangential_force,
        tangential_shift=end.tangential_shift,
        torque=end.torque,
        twist=end.twist,
        stick_area=end.stick_area,
        stick_radius=end.stick_radius,
        dissipated_energy=end.dissipated_energy,
        elastic_energy=elastic_energy(result.scene, result.plan, end),
        input_work=work,
        **_cycle_keys(cycle),
        residuals=Residuals.model_validate(
            {name: getattr(end.residuals, name) for name in Residuals.model_fields}
        ),
        iterations=sum(i.iterations for i in increments),
        factorizations=sum(i.factorizations for i in increments),
        status=end.status,
    )


def _cycle_keys(cycle: SectionCycle | None) -> dict[str, Any]:
    """The keys of a step that closes a cycle; none of them for others."""
    if cycle is None:
        return {}
    return {
        "cycle_start": cycle.cycle.start,
        "energy_per_cycle": cycle.dissipated_energy,
        "slip_amplitude": cycle.slip_amplitude,
        "ruiz_f1": cycle.ruiz_f1,
    }
