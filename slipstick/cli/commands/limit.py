"""Command `slipstick limit`: find the load factors at which stresses meet their strengths."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated

import typer

from contact_results.directory.json_record import write_record
from contact_results.number_text import number_text, uncertainty
from contact_scene import read_scene_file
from contact_scene.quantities.per_length import shown_unit
from contact_scene.reading.engineering_units import engineering_unit
from slipstick.cli.options import (
    SceneArgument,
    SetOption,
    SolverOption,
    directory,
    optional,
    print_input_warnings,
)
from slipstick.cli.terminal import print_message, print_pairs, print_table
from slipstick.critical_load import (
    MAX_FACTOR,
    CriticalLoad,
    CriticalLoads,
    Strength,
    critical_loads,
)
from slipstick.solvers.names import SolverName

FILE = "limit.json"


def limit(
    scene: SceneArgument,
    output: Annotated[
        Path | None,
        directory("Directory that receives limit.json; created if missing. Default: no file."),
    ] = None,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    step: Annotated[
        int | None,
        optional(
            "--step",
            metavar="N",
            min=1,
            help="Load step at whose end the stress is compared with the strength. Default: all.",
        ),
    ] = None,
    up_to: Annotated[
        float,
        typer.Option(
            "--up-to",
            metavar="FACTOR",
            min=1.0,
            help="Search load factors up to this one and down to its inverse.",
        ),
    ] = MAX_FACTOR,
    error: Annotated[
        bool,
        typer.Option(
            "--error/--no-error", help="State an error for every load factor, or omit the errors."
        ),
    ] = True,
) -> None:
    """Find the load factors at which stresses first meet their strengths.

    Materials with yield_strength (von Mises) or tensile_strength (largest principal stress) and
    layers with interface_strength (shear, tension) are compared. All loads and prescribed
    displacements of the history are multiplied by the load factor, and the scene is solved at
    several factors. The table begins with the smallest load factor.
    """
    contents = read_scene_file(scene, overrides or ())
    print_input_warnings(contents)
    steps = len(contents.loading)
    if step is not None and step > steps:
        raise typer.BadParameter(f"there is no step {step}; the scene has steps 1 to {steps}")
    found = critical_loads(
        contents,
        solver.value,
        step=step,
        max_factor=up_to,
        errors=error,
        progress=_print_solve,
    )
    if output is not None:
        write_record(output / FILE, found)
    factors = found.load_factors
    span = f"{factors[0]:.4g} to {factors[-1]:.4g} times the loads"
    print_pairs([("solver", solver.value), ("solves", f"{len(factors)}, {span}")])
    columns = _columns(found, line=contents.indenter.is_line)
    print_table(columns, list(zip(*columns.values(), strict=True)), numbers=True)
    for text in _reasons(found):
        typer.echo(f"  {text}")
    if output is not None:
        typer.echo(f"results in {output}")


def _print_solve(factor: float, ratios: Mapping[Strength, float]) -> None:
    """Print the largest ratio of a stress to its strength after a solve."""
    if ratios:
        first = max(ratios, key=lambda one: ratios[one])
        where = f"{first.measure} of {first.shown_region}"
        print_message(f"{factor:.4g} times the loads: {where} at {ratios[first]:.4g} of its limit")


def _columns(found: CriticalLoads, *, line: bool) -> dict[str, list[str]]:
    """Return the table of critical loads, as columns by heading.

    line  True for a line contact
    """
    limits = found.limits
    stress = engineering_unit(max(one.strength for one in limits), "Pa")
    unit = shown_unit("N", line=line)
    force = engineering_unit(max(one.normal_force or 0.0 for one in limits), unit)
    places = [abs(x) for one in limits for x in (one.x, one.y, one.depth) if x is not None]
    length = engineering_unit(max(places, default=0.0), "m")
    return {
        "region": [_region(one) for one in limits],
        "measure": [one.measure for one in limits],
        f"strength\n{stress.name}": [f"{one.strength / stress.size:.5g}" for one in limits],
        "load\nfactor": [_factor(one) for one in limits],
        f"normal force\n{force.name}": [_number(one.normal_force, force.size) for one in limits],
        "step": [_number(one.step, 1) for one in limits],
        **{
            f"{name}\n{length.name}": [_number(getattr(one, name), length.size) for one in limits]
            for name in ("x", "y", "depth")
        },
    }


def _region(one: CriticalLoad) -> str:
    """Return the region of a critical load; that of the indenter is marked."""
    if one.body == "body":
        return one.region
    return one.body if one.region == "body" else f"{one.body}, {one.region}"


def _factor(one: CriticalLoad) -> str:
    """Return the text of a load factor with its error, or of the searched range without it."""
    if one.load_factor is not None:
        return number_text(one.load_factor, uncertainty(one.error), 1.0)
    return f"> {one.below:.4g}" if one.below is not None else f"< {one.above:.4g}"


def _number(value: float | None, unit: float) -> str:
    """Return the text of a number in a unit; a dash without a number."""
    return "–" if value is None else f"{value / unit + 0.0:.4g}"


def _reasons(found: CriticalLoads) -> Iterator[str]:
    """Yield one line for each reason why a load factor is absent or its error is unreliable."""
    for one in found.limits:
        name = f"{one.measure} of {_region(one)}"
        if one.reason:
            yield f"{name}: {one.reason}"
        if one.error is not None and one.error.reason:
            yield f"? {name}: {one.error.reason}"
