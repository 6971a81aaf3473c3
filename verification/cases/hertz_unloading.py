"""Contacts without friction that are unloaded: nothing of the way there is left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from contact_scene import LoadStep
from contact_scene.residuals import worst
from verification.cases.fem_levels import because
from verification.closed_forms.hertz import PointContact
from verification.judging.case import Case, Comparison, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import (
    Ladder,
    Rung,
    asked,
    named,
    on_cells,
    part_of_side,
    with_edge_at,
)
from verification.judging.observable import number
from verification.judging.observables import APPROACH, CONTACT_RADIUS, PEAK_PRESSURE
from verification.judging.run import SOLVER_TOLERANCE, Run
from verification.problems import paper_scene as paper
from verification.problems.hertz import BALL
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, NORMAL_FORCE, STEEL, pressing

PART = (27.5 / 32.5) ** 3  # about 0.6; of 32 elements the edge is then in the middle of one
UNLOADED = PointContact.under_load(PART * NORMAL_FORCE, HERTZ.radius, HERTZ.contact_modulus)
SMALLER = UNLOADED.contact_radius / HERTZ.contact_radius
SIZES = {Level.QUICK: (128, 32), Level.STANDARD: (256, 64), Level.FULL: (512, 128)}
ASKED = (
    "asked of hertz_point on 128 x 128 cells; on other cells per radius what the order 2 makes of "
    "it"
)
TWICE = "twice what is allowed of the approach"
DOWN = LoadStep(normal_force=PART * NORMAL_FORCE)
# Grids and meshes are laid out for the larger contact.
PRESSED_AND_UNLOADED = replace(
    BALL,
    scene=pressed(
        "Ball on a half-space, pressed and unloaded",
        paper.paraboloid(STEEL),
        BALL.scene.body,
        pressing(),
        DOWN,
    ),
    ends=(HERTZ, UNLOADED),
)
COATED = {
    way: pressed(
        f"Rigid ball on a coated body, {way}", rigid_ball(), coated(film(2.0, 1.0)), *loading
    )
    for way, loading in {
        "pressed and unloaded": (pressing(), DOWN),
        "pressed by the smaller force": (DOWN,),
    }.items()
}


ENERGY = replace(
    number("elastic_energy", "energy stored in both bodies"),
    value=lambda exact: 0.4 * exact.load * exact.approach,
    source="Hertz 1882: W ~ δ^(3/2), so that ∫W dδ is 2/5 of W δ",
)


def on_smaller(figure: float, order: float) -> Callable[[Rung], float]:
    """What a figure asked for on 128 x 128 cells, or at 64 elements per radius, becomes on those
    that the smaller contact is left with."""

    def allowed(rung: Rung) -> float:
        if isinstance(rung.run, Run):
            return figure * (128 / (rung.count * SMALLER)) ** order
        return asked(figure, order)(replace(rung, count=round(rung.count * SMALLER)))

    return allowed


def of_radius(rung: Rung) -> float:
    """As for hertz_point and fem_hertz."""
    if isinstance(rung.run, Run):
        return part_of_side(0.1)(rung) / SMALLER
    return min(2e-3, on_smaller(5e-4, 1)(rung))


ON_CELLS = (
    Within(APPROACH, on_smaller(5e-5, 2), ASKED),
    Within(CONTACT_RADIUS, of_radius, "a tenth of a cell, as for hertz_point"),
    Within(PEAK_PRESSURE, on_smaller(1.5e-4, 2), ASKED),
    Within(ENERGY, on_smaller(1e-4, 2), TWICE),
)
ON_ELEMENTS = (
    Within(APPROACH, on_smaller(1e-4, 2), because(2)),
    Within(
        CONTACT_RADIUS, of_radius,
        "as for fem_hertz: the edge is known to a thirtieth of an element",
    ),
    Within(PEAK_PRESSURE, on_smaller(1e-4, 2), because(2)),
    Within(ENERGY, on_smaller(2e-4, 2), TWICE),
)  # fmt: skip


def hertz_unloading(level: Level = Level.QUICK) -> Case:
    """The case, on finer discretisations at higher levels."""
    cells, elements = SIZES[level]
    grid = on_cells(PRESSED_AND_UNLOADED, (cells,))
    mesh = with_edge_at(PRESSED_AND_UNLOADED, (elements,))
    back, once = (_coated(way, cells, elements) for way in COATED)
    return case(
        "hertz_unloading",
        "Unloaded without friction",
        f"The paper's ball pressed by 1 kN and unloaded to {PART:.3f} kN. Without friction the "
        "contact is again Hertz's, with approach, radius, pressure and energy of the smaller "
        "force. A coated body is unloaded likewise, and compared with itself pressed by that force "
        "at once.",
        judged(grid, ON_CELLS),
        judged(mesh, ON_ELEMENTS),
        runs=tuple(run for one in (*back, *once) for run in one.runs),
        comparisons=tuple(
            Comparison(
                "path_independence", "difference of pressure and approach from those of the "
                "smaller force at once", (one.levels[0], other.levels[0]), _difference,
                10 * SOLVER_TOLERANCE,
                "residuals of two solves, which tractions answer a few times over",
                "without friction a contact has no memory",
            )
            for one, other in zip(back, once, strict=True)
        ),
    )  # fmt: skip


def _coated(way: str, cells: int, elements: int) -> tuple[Ladder, Ladder]:
    """By both solvers."""
    problem = replace(BALL, scene=COATED[way])
    return (
        named(f"coated, {way}", on_cells(problem, (cells,))),
        named(f"coated, {way}, elements", with_edge_at(problem, (elements,))),
    )


def _difference(one: Any, other: Any) -> float:
    """Of the ends of two histories: Σ|Δp|/Σp, and approach."""
    a, b = one.steps[-1], other.steps[-1]
    pressure = abs(a.pressure - b.pressure).sum() / b.pressure.sum()
    return worst(float(pressure), abs(a.approach / b.approach - 1))
