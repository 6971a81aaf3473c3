"""Command `slipstick limit`: find the load factors at which stresses meet their strengths."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact_results.directory.json_record import write_record
from contact_results.directory.run_directory import refuse_files_above
from contact_results.number_text import number_text, uncertainty
from contact_results.solvers import SolverName
from contact_scene import read_scene_file
from contact_scene.quantities.per_length import shown_unit
from contact_scene.reading.engineering_units import quantity
from slipstick.cli.options import (
    SceneArgument,
    SetOption,
    SolverOption,
    directory,
    print_input_warnings,
)
from slipstick.cli.terminal import print_message, print_pairs, print_table
from slipstick.critical_load import CriticalLoad, critical_loads

FILE = "limit.json"
COLUMNS = (
    *("region", "measure", "strength", "load factor", "normal force"),
    *("step", "x", "y", "depth"),
)


def limit(
    scene: SceneArgument,
    output: Annotated[
        Path | None,
        directory(f"Directory that receives {FILE}; created if missing. Default: no file."),
    ] = None,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
) -> None:
    """Find the load factors at which stresses first meet their strengths.

    Strengths are keys of the scene: yield_strength (von Mises) and tensile_strength (largest
    principal stress) of materials, and interface_strength (shear, tension) of layers. All loads and
    prescribed displacements of the history are multiplied by the load factor, from 1/100 to 100,
    and the scene is solved at several factors. The smallest load factor is the first in the table.
    """
    if output is not None:
        refuse_files_above(output)
    contents = read_scene_file(scene, overrides or ())
    print_input_warnings(contents)
    found = critical_loads(
        contents,
        solver.value,
        progress=lambda factor: print_message(f"solve at {factor:.4g} times the loads"),
    )
    if output is not None:
        write_record(output / FILE, found)
    print_pairs([("solver", solver.value), ("solves", str(len(found.load_factors)))])
    unit = shown_unit("N", line=contents.indenter.is_line)
    print_table(COLUMNS, [_row(one, unit) for one in found.limits], numbers=True)
    for one in found.limits:
        if one.reason:
            typer.echo(f"  {one.measure} of {one.region}: {one.reason}")
    if output is not None:
        typer.echo(f"results in {output}")


def _row(one: CriticalLoad, unit: str) -> list[str]:
    """Return the table row of a critical load, or of the searched range without one.

    unit  SI unit of the normal force
    """
    region = one.region if one.body == "body" else f"indenter, {one.region}"
    row = [region, one.measure, quantity(one.strength, "Pa")]
    if one.load_factor is None or one.normal_force is None or one.place is None:
        beyond = f"> {one.below:.4g}" if one.below else f"< {one.above:.4g}" if one.above else "–"
        return [*row, beyond, *["–"] * 5]
    factor = number_text(one.load_factor, uncertainty(one.error), 1.0)
    places = (quantity(each, "m", 3) for each in one.place)
    return [*row, factor, quantity(one.normal_force, unit), str(one.step), *places]
