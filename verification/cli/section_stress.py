"""`slipstick stress` of a result of finite elements."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from verification.cli.solver_option import SolverName

if TYPE_CHECKING:
    from fem_reference import Result
    from verification.run_output.section.stress_planes import Extreme


def stress_on_section(
    source: Path,
    output: Path,
    step: int | None,
    solver: SolverName,
    overrides: list[str],
    *,
    indenter: bool,
    figures: bool,
) -> None:
    """Stress of a run, or of a scene that is solved first; values at the nodes of a mesh.

    Raises what `fem_reference.stress.subsurface` raises.
    """
    from fem_reference.stress import subsurface
    from verification.run_output.section.stress_files import write_section_stress
    from verification.run_output.section.stress_planes import StressPlane, extremes
    from verification.run_output.section.stress_state import (
        section_state_of_result,
        section_state_of_run,
    )
    from verification.run_output.surface_state import NoSuchState

    try:
        if source.is_dir():
            state = section_state_of_run(source, step)
        else:
            state = section_state_of_result(_solved(source, solver, overrides), step)
    except NoSuchState as error:
        raise typer.BadParameter(str(error)) from None
    which, body = ("indenter", state.indenter) if indenter else ("body", state.body)
    if not body.deforms:
        raise typer.BadParameter(f"the {which} is rigid: there is no stress in it")
    field = subsurface(body, state.tractions, state.discretisation, upper=indenter)
    plane = StressPlane.of(field)
    found = extremes(plane, body)
    write_section_stress(plane, state, body, which, found, output)
    if figures:
        from verification.run_output.section.stress_plot import write_section_stress_figures

        title = f"{state.title or 'Stress'}: {which}, step {state.step}"
        write_section_stress_figures(plane, state.tractions.loaded_radius, output, title)
    _print(found, output)


def _solved(scene: Path, solver: SolverName, overrides: list[str]) -> Result:
    from contact_scene import read_scene_file
    from verification.cli.section_run import solve_on_section
    from verification.run_output.timing import Stopwatch

    return solve_on_section(read_scene_file(scene, overrides), solver, Stopwatch())


def _print(found: tuple[Extreme, ...], output: Path) -> None:
    from verification.cli.terminal import print_table
    from verification.run_output.engineering_units import engineering_unit, quantity

    unit = engineering_unit(max(abs(e.value) for e in found), "Pa")
    columns = ("region", "measure", f"largest\n{unit.name}", "x\n", "depth\n")
    rows = (
        (e.region, e.measure, f"{e.value / unit.size:.5g}", quantity(e.x, "m"),
         quantity(e.depth, "m"))
        for e in found
    )  # fmt: skip
    print_table(columns, rows, numbers=True)
    typer.echo(f"results in {output}")
