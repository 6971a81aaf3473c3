"""`slipstick stress`: displacement and stress below the surface."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.scene_options import SetOption
from slipstick.cli.solver_option import SolverName, SolverOption

if TYPE_CHECKING:
    from contact_results.files.stress_extremes import RegionalExtreme
    from contact_results.files.surface_state import SurfaceState
    from contact_scene import Body
    from semi_analytical import Result
    from semi_analytical.frf.depth import Level
    from semi_analytical.stress import SubsurfaceField


def stress(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RUN_DIR|SCENE",
            help="Output of 'slipstick run', or a scene file to solve first.",
            show_default=False,
        ),
    ],
    output: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="DIR", help="Where the results go; made if absent."),
    ],
    step: Annotated[
        int | None,
        typer.Option(
            "--step",
            metavar="N",
            min=1,
            show_default=False,
            help="Loading step at the end of which the stress is taken; the last if absent.",
        ),
    ] = None,
    depths: Annotated[
        str | None,
        typer.Option(
            "--depths",
            metavar="Z,Z,...",
            show_default=False,
            help="Depths such as '0,0.1 mm,0.2 mm'; fitted to contact and layers if absent. Both "
            "sides of every interface are always there.",
        ),
    ] = None,
    indenter: Annotated[
        bool, typer.Option("--indenter", help="The indenter instead of the body; z points up.")
    ] = False,
    volume: Annotated[
        bool, typer.Option("--volume", help="Write the whole volume as VTU too, not only y = 0.")
    ] = False,
    figures: Annotated[
        bool, typer.Option("--figures/--no-figures", help="Draw figures, or leave them out.")
    ] = True,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
) -> None:
    """Stress in layers and substrate: maxima, sections, lines, and both sides of interfaces.

    Writes stress.json, tables (CSV), the section y = 0 for ParaView (VTU) and figures into DIR.
    """
    _refuse_file_in_the_way(output)
    if _is_on_section(source, solver):
        from slipstick.cli.section_stress import stress_on_section

        if depths is not None or volume:
            raise typer.BadParameter("finite elements give the stress at their nodes in one plane: "
                                     "leave --depths and --volume out")  # fmt: skip
        if source.is_dir() and overrides:
            raise typer.BadParameter("--set changes a scene, and this is a run that was solved")
        stress_on_section(
            source, output, step, solver, overrides or [], indenter=indenter, figures=figures
        )
        return
    from contact_results.files.stress_extremes import extremes
    from semi_analytical.stress import interfaces, subsurface

    state = _state(source, step, overrides or []).with_margin()
    which, body, sign = ("indenter", state.indenter, -1) if indenter else ("body", state.body, 1)
    if not body.deforms:
        raise typer.BadParameter(f"the {which} is rigid: there is no stress in it")
    levels = _levels(body, depths, state.contact_radius)
    shear = None if state.shear is None else sign * state.shear
    field = subsurface(body, state.grid, state.pressure, shear, levels)
    sides = interfaces(body)
    found = extremes(field, sides)
    _write(state, which, field, sides, found, output, figures, volume)
    _print(found, output)


def _is_on_section(source: Path, solver: SolverName) -> bool:
    """Whether finite elements solve the scene, or have solved the run."""
    if not source.is_dir():
        return solver.is_fem
    from contact_results.section.stress_state import is_section_run

    return is_section_run(source)


def _refuse_file_in_the_way(output: Path) -> None:
    for place in (output, *output.parents):
        if place.exists() and not place.is_dir():
            raise typer.BadParameter(f"{place} is a file; --output needs a directory")


def _state(source: Path, step: int | None, overrides: list[str]) -> SurfaceState:
    from contact_results.files.surface_state import NoSuchState, state_of_result, state_of_run

    try:
        if source.is_dir():
            if overrides:
                raise typer.BadParameter("--set changes a scene, and this is a run that was solved")
            return state_of_run(source, step)
        return state_of_result(_solved(source, overrides), step)
    except NoSuchState as error:
        raise typer.BadParameter(str(error)) from None


def _solved(scene: Path, overrides: list[str]) -> Result:
    from contact_scene import read_scene_file
    from semi_analytical import plan, solve_discretised
    from slipstick.cli.progress import solve_progress

    contents = read_scene_file(scene, overrides)
    asked = contents.semi_analytical
    decided = plan(contents.scene, asked.path_accuracy)
    with solve_progress(decided.increments) as observe:
        return solve_discretised(contents.scene, asked, progress=observe, plan=decided)


def _levels(body: Body, depths: str | None, contact_radius: float) -> tuple[Level, ...]:
    """What was asked for and both sides of every interface, downward."""
    from semi_analytical.frf.stack import stack_of
    from semi_analytical.stress import default_depths, interfaces
    from semi_analytical.stress.levels import levels_of

    if depths is None:
        return default_depths(body, contact_radius)
    asked = [_length(text) for text in depths.split(",")]
    try:
        levels = levels_of(stack_of(body), asked)
    except ValueError as error:
        raise typer.BadParameter(f"--depths: {error}") from None
    sides = [side for pair in interfaces(body) for side in pair]
    return tuple(sorted({*levels, *sides}, key=lambda level: (level.depth, level.layer)))


def _length(text: str) -> float:
    """A plain number in metres, or a number with a unit."""
    from pydantic import TypeAdapter, ValidationError

    from contact_scene.quantity import Length

    try:
        return float(text)
    except ValueError:
        pass
    try:
        return TypeAdapter(Length).validate_python(text)
    except ValidationError as error:
        reason = error.errors()[0]["msg"]
        raise typer.BadParameter(f"--depths: {reason}") from None


def _write(
    state: SurfaceState,
    which: str,
    field: SubsurfaceField,
    sides: tuple[tuple[Level, ...], ...],
    found: tuple[RegionalExtreme, ...],
    output: Path,
    figures: bool,
    volume: bool,
) -> None:
    from contact_results.files.stress_mesh import SECTION, VOLUME, write_mesh
    from contact_results.files.stress_tables import (
        SUMMARY,
        write_axis,
        write_maxima,
        write_stress_summary,
    )

    section = field.along_x()
    # Last to come and first to go: a directory with a summary is complete.
    (output / SUMMARY).unlink(missing_ok=True)
    write_maxima(found, output)
    write_axis(section, len(sides), output)
    write_mesh(section, output / SECTION)
    if volume:
        write_mesh(field, output / VOLUME)
    if figures:
        from contact_results.figures.stress_plot import write_stress_figures

        title = f"{state.title or 'Stress'}: {which}, step {state.step}"
        write_stress_figures(section, sides, output, title)
    write_stress_summary(state, which, field, found, output)


def _print(found: tuple[RegionalExtreme, ...], output: Path) -> None:
    from contact_scene.engineering_units import engineering_unit, quantity
    from slipstick.cli.terminal import print_table

    unit = engineering_unit(max(abs(e.at.value) for e in found), "Pa")
    columns = ("region", "measure", f"largest\n{unit.name}", "x\n", "y\n", "depth\n")
    rows = (
        (
            e.region,
            e.measure,
            f"{e.at.value / unit.size:.5g}",
            *(quantity(length, "m") for length in (e.at.x, e.at.y, e.at.level.depth)),
        )
        for e in found
    )
    print_table(columns, rows, numbers=True)
    typer.echo(f"results in {output}")
