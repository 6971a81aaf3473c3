"""`slipstick stress` of a result of finite elements."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from slipstick.cli.solver_option import SolverName

if TYPE_CHECKING:
    from contact_results.section.stress_planes import Extreme
    from fem_reference import Result


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
    from contact_results.files.surface_state import NoSuchState
    from contact_results.section.stress_files import write_section_stress
    from contact_results.section.stress_planes import StressPlane, extremes
    from contact_results.section.stress_state import (
        section_state_of_result,
        section_state_of_run,
    )
    from fem_reference.stress import subsurface

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
        from contact_results.section.stress_plot import write_section_stress_figures

        title = f"{state.title or 'Stress'}: {which}, step {state.step}"
        write_section_stress_figures(plane, state.tractions.loaded_radius, output, title)
    _print(found, output)


def _solved(scene: Path, solver: SolverName, overrides: list[str]) -> Result:
    from contact_results.directory.timing import Stopwatch
    from contact_scene import read_scene_file
    from slipstick.cli.section_run import solve_on_section

    return solve_on_section(read_scene_file(scene, overrides), solver, Stopwatch())


def _print(found: tuple[Extreme, ...], output: Path) -> None:
    from contact_scene.engineering_units import engineering_unit, quantity
    from slipstick.cli.terminal import print_table

    unit = engineering_unit(max(abs(e.value) for e in found), "Pa")
    columns = ("region", "measure", f"largest\n{unit.name}", "x\n", "depth\n")
    rows = (
        (e.region, e.measure, f"{e.value / unit.size:.5g}", quantity(e.x, "m"),
         quantity(e.depth, "m"))
        for e in found
    )  # fmt: skip
    print_table(columns, rows, numbers=True)
    typer.echo(f"results in {output}")
