"""Contacts without friction that are unloaded: nothing of the way there is left."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from contact_scene import Body, FiniteElementDiscretisation, LoadStep, Scene
from semi_analytical import SurfaceGrid
from verification.cases.fem_levels import allowed as allowed_of_elements
from verification.cases.fem_levels import because as because_of_elements
from verification.closed_forms.hertz import PointContact
from verification.judging.case import Case, Comparison, Level, Quantity, Required
from verification.judging.ladder import meshed
from verification.judging.refinement import part_of_a_cell
from verification.judging.run import SOLVER_TOLERANCE, Run, SectionRun, per_radius
from verification.observed.end_state import approach, contact_radius, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.hertz import SOURCE
from verification.problems.layered_scene import coated, film, rigid_ball
from verification.problems.paper_scene import HERTZ, NORMAL_FORCE, STEEL
from verification.problems.reference import closed_form

PART = (27.5 / 32.5) ** 3  # about 0.6; of 32 elements the edge is then in the middle of one
UNLOADED = PointContact.under_load(PART * NORMAL_FORCE, HERTZ.radius, HERTZ.contact_modulus)
SMALLER = UNLOADED.contact_radius / HERTZ.contact_radius
ENERGY = 0.4 * UNLOADED.load * UNLOADED.approach
SIZES = {Level.QUICK: (128, 32), Level.STANDARD: (256, 64), Level.FULL: (512, 128)}
ASKED = (
    "asked of hertz_point on 128 x 128 cells; on other cells per radius what the order {:g} makes "
    "of it"
)
DOWN = LoadStep(normal_force=PART * NORMAL_FORCE)
BALL = Scene(
    title="Ball on a half-space, pressed and unloaded",
    indenter=paper.paraboloid(STEEL),
    body=Body(material=STEEL),
    loading=(LoadStep(normal_force=NORMAL_FORCE), DOWN),
)
COATED = {
    way: Scene(
        title=f"Rigid ball on a coated body, {way}",
        indenter=rigid_ball(),
        body=coated(film(2.0, 1.0)),
        loading=loading,
    )
    for way, loading in {
        "pressed and unloaded": (LoadStep(normal_force=NORMAL_FORCE), DOWN),
        "pressed by the smaller force": (DOWN,),
    }.items()
}
WORK = "Hertz 1882: W ~ δ^(3/2), so that ∫W dδ is 2/5 of W δ"


def hertz_unloading(level: Level = Level.QUICK) -> Case:
    """The case, on finer discretisations at higher levels."""
    return hertz_unloading_on(*SIZES[level])


def hertz_unloading_on(cells: int, elements: int) -> Case:
    """The case on a square grid of so many cells, and with so many elements per radius."""
    grid = paper.hertz_grid(cells)
    mesh = per_radius(elements, meshed(HERTZ.contact_radius, elements))
    surface = Run(f"{cells}x{cells}", BALL, grid)
    section = SectionRun(f"{elements} elements per radius", BALL, mesh)
    back, once = (_coated(way, scene, grid, mesh) for way, scene in COATED.items())
    return Case(
        name="hertz_unloading",
        title="Unloaded without friction",
        problem=(
            f"The paper's ball pressed by 1 kN and unloaded to {PART:.3f} kN. Without friction "
            "the contact is again Hertz's, with approach, radius, pressure and energy of the "
            "smaller force. A coated body is unloaded likewise, and compared with itself pressed "
            "by that force at once."
        ),
        runs=(surface, section, *back, *once),
        quantities=(
            *_quantities(surface.label, _on_cells(cells)),
            *_quantities(section.label, _on_elements(elements)),
            _energy(surface.label, _stored, 2 * _on_cells(cells)["approach"][0]),
            _energy(section.label, _stored, 2 * _on_elements(elements)["approach"][0]),
        ),
        comparisons=tuple(
            Comparison(
                "path_independence", "difference of pressure and approach from those of the "
                "smaller force at once", (one.label, other.label), _difference,
                10 * SOLVER_TOLERANCE,
                "residuals of two solves, which tractions answer a few times over",
                "without friction a contact has no memory",
            )
            for one, other in zip(back, once, strict=True)
        ),
    )  # fmt: skip


Allowed = dict[str, tuple[float, str]]


def _coated(
    way: str, scene: Scene, grid: SurfaceGrid, mesh: FiniteElementDiscretisation
) -> tuple[Run | SectionRun, ...]:
    """By both solvers."""
    return Run(f"coated, {way}", scene, grid), SectionRun(f"coated, {way}, elements", scene, mesh)


def _on_cells(cells: int) -> Allowed:
    """By quantity: what is allowed, and why."""
    finer = 128 / (cells * SMALLER)
    return {
        "peak_pressure": (1.5e-4 * finer**2, ASKED.format(2)),
        "approach": (5e-5 * finer**2, ASKED.format(2)),
        "contact_radius": (
            part_of_a_cell(0.1, cells, paper.WINDOW_PER_RADIUS) / SMALLER,
            "a tenth of a cell, as for hertz_point",
        ),
    }


def _on_elements(elements: int) -> Allowed:
    there = round(elements * SMALLER)
    return {
        "peak_pressure": (allowed_of_elements(1e-4, there, 2), because_of_elements(2)),
        "approach": (allowed_of_elements(1e-4, there, 2), because_of_elements(2)),
        "contact_radius": (
            min(2e-3, allowed_of_elements(5e-4, there, 1)),
            "as for fem_hertz: the edge is known to a thirtieth of an element",
        ),
    }


def _quantities(run: str, allowed: Allowed) -> tuple[Quantity, ...]:
    measured = (
        ("approach", "approach after unloading", "m", approach, UNLOADED.approach),
        ("contact_radius", "contact radius after unloading", "m", contact_radius,
         UNLOADED.contact_radius),
        ("peak_pressure", "largest pressure after unloading", "Pa", peak_pressure,
         UNLOADED.peak_pressure),
    )  # fmt: skip
    return tuple(
        Quantity(
            name, meaning, unit, run, measure, closed_form(value, SOURCE), Required(*allowed[name])
        )
        for name, meaning, unit, measure, value in measured
    )


def _energy(run: str, measure: Callable[[Any], float], allowed: float) -> Quantity:
    return Quantity(
        "elastic_energy", "energy stored in both bodies after unloading", "J", run, measure,
        closed_form(ENERGY, WORK), Required(allowed, "twice what is allowed of the approach"),
    )  # fmt: skip


def _stored(result: Any) -> float:
    return float(result.steps[-1].elastic_energy)


def _difference(one: Any, other: Any) -> float:
    """Of the ends of two histories: Σ|Δp|/Σp, and approach."""
    a, b = one.steps[-1], other.steps[-1]
    pressure = abs(a.pressure - b.pressure).sum() / b.pressure.sum()
    return max(float(pressure), abs(a.approach / b.approach - 1))
