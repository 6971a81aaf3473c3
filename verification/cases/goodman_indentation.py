"""Pressing with friction where shear does not act on the pressure: a closed form of the stick."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from semi_analytical import one_way
from verification.closed_forms.goodman import stick_ratio
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.table import NONE, Table
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import Run
from verification.observed.end_state import approach, contact_radius, peak_pressure, stick_radius
from verification.observed.radial_profile import outward
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import half_space, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, pressing
from verification.problems.reference import closed_form, identity
from verification.quantities import shear_of

if TYPE_CHECKING:
    from semi_analytical import Result

Results = Mapping[str, "Result"]

NU = 0.3
BETA = (1 - 2 * NU) / (2 * (1 - NU))
INCREMENTS = 40  # uniform in contact radius
MARGIN = 1.15  # half the window over the contact radius
# On 64 cells the disc of µ = 0.1 is six cells wide, and so is the slip ring of µ = 0.3.
RESOLVED = {Level.QUICK: (64, (0.2,)), Level.STANDARD: (256, (0.1, 0.2, 0.3))}
SOURCE = "Goodman 1962; Spence 1975: (a/2c) ln((a+c)/(a-c)) = (µ/β) K'(c/a)"


def goodman_indentation(level: Level = Level.QUICK) -> Case:
    """The case: friction coefficients whose stick radius the grid resolves."""
    return goodman_indentation_on(*RESOLVED[min(level, Level.STANDARD)])


def goodman_indentation_on(cells: int, frictions: tuple[float, ...]) -> Case:
    """The case on a square grid of this many cells per side."""
    runs = {mu: _run(mu, cells) for mu in frictions}
    return Case(
        name="goodman_indentation",
        title="Pressing with friction, coupled one way",
        problem=(
            "The paper's ball, rigid, pressed on bodies of the paper's E* and ν = 0.3. Pressure "
            "draws the surface towards the axis and friction resists; that shear in turn lifts "
            "or lowers the surface is left out. Then the pressure is Hertz's, and the stick disc "
            "has a closed form: a test of the history of stick and slip apart from the "
            "alternation between pressure and shear."
        ),
        runs=tuple(runs.values()),
        quantities=tuple(q for mu in frictions for q in _quantities(mu, runs[mu].label)),
        charts=lambda results: (_chart({mu: results[runs[mu].label] for mu in frictions}),),
        tables=lambda results: (_table({mu: results[runs[mu].label] for mu in frictions}),),
        limits=(
            "One-way coupling is an approximation, here computed on purpose; the full coupling is "
            "judged by the case frictional_indentation.",
        ),
    )


def _run(friction: float, cells: int) -> Run:
    title = f"Rigid ball pressed with friction, µ = {friction:g}, coupled one way"
    scene = pressed(title, rigid_ball(), half_space(NU), pressing(INCREMENTS), friction=friction)
    grid = paper.square_grid(cells, MARGIN * HERTZ.contact_radius)
    problem = f"µ = {friction:g}"
    label = f"{problem}, {cells} cells, {INCREMENTS} increments"
    return Run(label, scene, grid, effects=one_way, problem=problem)


def _quantities(friction: float, run: str) -> tuple[Quantity, ...]:
    hertz = "Hertz: the pressure is that without friction"
    return (
        Quantity(
            "approach", "approach of the bodies since first touch", "m", run, approach,
            closed_form(HERTZ.approach, hertz),
            Required(2e-4, "asked of frictional indentation"),
        ),
        Quantity(
            "peak_pressure", "largest pressure of any cell", "Pa", run, peak_pressure,
            closed_form(HERTZ.peak_pressure, hertz),
            Required(2e-3, "a cell is up to a thirtieth of the radius wide"),
        ),
        Quantity(
            "slip_limit", "largest excess of the shear over µp, over µp₀", "", run, _excess,
            identity(0.0, "Coulomb"), Required(1e-8, "the solver's tolerance"), 1.0, "µp₀",
        ),
        Quantity(
            "stick_ratio", "stick radius over contact radius", "", run, _ratio,
            closed_form(stick_ratio(friction, BETA), SOURCE),
            Required(1e-2, "asked of frictional indentation"),
        ),
    )  # fmt: skip


def _excess(result: Result) -> float:
    end, friction = result.steps[-1], result.scene.friction
    assert friction is not None
    bound = friction.limit(end.pressure)
    return float(np.max(np.hypot(*shear_of(end)) - bound) / np.max(bound))


def _ratio(result: Result) -> float:
    return stick_radius(result) / contact_radius(result)


def _table(results: Mapping[float, Result]) -> Table:
    rows = tuple(
        (
            f"{mu:g}",
            f"{_ratio(result):.4f}",
            f"{stick_ratio(mu, BETA):.4f}",
            f"{np.median([i.convolutions for i in result.increments]):.0f}",
        )
        for mu, result in results.items()
    )
    return Table(
        title="Stick radius over contact radius",
        columns=("µ", f"{INCREMENTS} increments", "closed form", "convolutions per increment"),
        rows=rows,
        note="With the full coupling the ratio is smaller: 0.1998 for µ = 0.1, 0.8959 for µ = 0.3.",
        units=NONE,
    )  # fmt: skip


def _chart(results: Mapping[float, Result]) -> Chart:
    curves = []
    for n, (mu, result) in enumerate(results.items()):
        grid, end = result.grid, result.steps[-1]
        half, row = slice(grid.cells[0] // 2, None), grid.cells[1] // 2
        r = np.hypot(grid.x[half], grid.y[row]) / HERTZ.contact_radius
        unit = mu * HERTZ.peak_pressure
        q = outward(shear_of(end), grid)[half, row] / unit
        curves.append(curve(f"µ = {mu:g}", r, q, series=n))
        edge = stick_ratio(mu, BETA)
        curves.append(curve("", [edge, edge], [0, np.sqrt(1 - edge**2)], Look.BOUND))
    radii = np.linspace(0, 1, 60)
    limit = curve("µp (Hertz)", radii, np.sqrt(1 - radii**2), Look.REFERENCE)
    return Chart(
        name="goodman_indentation",
        title="Outward shear, coupled one way",
        caption="Shear over µ times the Hertz pressure along the radius. Dashed: stick radius of "
        "the closed form; outside it the shear follows µp.",
        rows=((Panel(x_label="r / a", y_label="q / µp₀", curves=(limit, *curves), height=2.2),),),
    )
