"""Pressing with friction under refinement of cells and of increments: how fast each converges."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING

from contact_scene import Body, IsotropicMaterial
from verification.convergence.cell_centres import at_centres
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.judging.case import Case, Comparison, Level
from verification.judging.order_of_convergence import Followed, OrderOfChange, Refinement
from verification.judging.run import Run
from verification.observed.changes import approach_change, increment_size
from verification.observed.end_state import approach, stick_radius
from verification.problems import paper_scene as paper
from verification.problems.indentation import Indentation
from verification.problems.reference import ReferenceKind
from verification.quantities import shear_of

if TYPE_CHECKING:
    from semi_analytical import Plan, Result

# Changes are taken over two levels: by the root of two, and between some increments and twice as
# many. Grids cut the contact differently, so that many of them tell more.
CELLS = (32, 38, 46, 54, 64, 76, 90, 108, 128, 152, 182, 214, 256)
CELLS_INCREMENTS = 20
# More move the stick edge by less than a cell each, and say nothing of smaller increments.
INCREMENTS = (2, 3, 4, 6, 8, 12, 16, 24, 32)
INCREMENTS_CELLS = 128
APART = 2
# Half of the radius sticks: the edges of stick zone and contact are as far apart as can be, and
# both far from the axis. Stick radius, contact radius and approach by superposing Spence's punches,
# δ R = 1.04015 a².
ONE = Indentation(
    {
        "mu": 0.2986, "c_over_a": 0.49972, "a_over_aH": 0.97037,
        "delta_over_deltaH": 1.04015 * 0.97037**2,
    },
    "ν = 0, µ = 0.2986",
    "half",
    Body(
        material=IsotropicMaterial(young_modulus=paper.CONTACT_MODULUS, poisson_ratio=0.0)
    ),
    "self-similar (Spence 1975), to five digits",
)  # fmt: skip
FEW, MANY, QUICK_CELLS = 8, 16, 64


def indentation_refinement(level: Level = Level.QUICK) -> Case:
    """The case: two runs at the quick level, orders above it."""
    if level is Level.QUICK:
        return indentation_refinement_on((), ())
    return indentation_refinement_on(CELLS, INCREMENTS)


def indentation_refinement_on(cells: tuple[int, ...], increments: tuple[int, ...]) -> Case:
    """The case on these square grids and with these increments; values only if there are none."""
    few, many = (_run(QUICK_CELLS, count) for count in (FEW, MANY))
    meshes = tuple(_run(count, CELLS_INCREMENTS) for count in cells)
    paths = tuple(_run(INCREMENTS_CELLS, count) for count in increments)
    unique = {run.label: run for run in (few, many, *meshes, *paths)}
    return Case(
        name="indentation_refinement",
        title="Pressing with friction under refinement",
        problem=(
            "The rigid ball on a body of ν = 0, with friction that lets half of the radius stick. "
            "The pressing is cut into more and more increments on one grid, and the grid into more "
            "and more cells with the same increments. Each leaves the error of the other, so "
            "orders are taken from the changes between neighbouring levels."
        ),
        runs=tuple(unique.values()),
        quantities=(),
        comparisons=(
            Comparison(
                "approach", f"relative error of the approach, extrapolated from {FEW} and {MANY} "
                "increments with second order",
                (few.label, many.label), _approach_error, 2e-4,
                "asked of frictional_indentation, there on 256 x 256 cells",
                ONE.source, ReferenceKind.SEMI_CLOSED,
            ),
            Comparison(
                "stick_radius", f"relative error of the stick radius, extrapolated from {FEW} and "
                f"{MANY} increments",
                (few.label, many.label), partial(stick_error, ONE), _part_of_stick(0.5),
                "half a cell: the stick edge moves by cells from increment to increment",
                ONE.source, ReferenceKind.SEMI_CLOSED,
            ),
        ),
        orders=(*_orders_in_cells(meshes), *_orders_in_increments(paths)),
        charts=lambda results: _charts(results, meshes, paths),
        limits=(
            "The stick radius scatters by a part of a cell from grid to grid: it has no order that "
            "could be judged; frictional_indentation judges its extrapolated value.",
        ),
    )  # fmt: skip


def _orders_in_cells(runs: tuple[Run, ...]) -> tuple[OrderOfChange, ...]:
    if not runs:
        return ()
    levels = tuple(run.label for run in runs)
    return (
        OrderOfChange(
            "order_of_shear_in_cells", Followed.SHEAR, Refinement.MESH,
            f"shear (L1) with {CELLS_INCREMENTS} increments", levels,
            shear_change, cell_side, 1.5,
            "square-root edges of stick zone and contact: an error of O(√h) on rings one cell wide "
            "leaves O(h^3/2) in L1", apart=APART,
        ),
    )  # fmt: skip


def _orders_in_increments(runs: tuple[Run, ...]) -> tuple[OrderOfChange, ...]:
    if not runs:
        return ()
    levels = tuple(run.label for run in runs)
    return (
        OrderOfChange(
            "order_of_approach_in_increments", Followed.APPROACH, Refinement.INCREMENTS,
            f"approach on {INCREMENTS_CELLS} x {INCREMENTS_CELLS} cells", levels,
            approach_change, increment_size, 2.0,
            "slip keeps its direction while the contact grows; what increments miss of the stick "
            "zone alternates and cancels in a mean", apart=APART,
        ),
        OrderOfChange(
            "order_of_shear_in_increments", Followed.SHEAR, Refinement.INCREMENTS,
            f"shear (L1) on {INCREMENTS_CELLS} x {INCREMENTS_CELLS} cells", levels,
            shear_change, increment_size, 1.5,
            "the shear of a ring is fixed where the stick edge passes; next to it the shear leaves "
            "the friction limit as a square root: O(√h) on bands of width h", apart=APART,
        ),
    )  # fmt: skip


def shear_change(coarse: Result, fine: Result) -> float:
    """Σ|q_coarse - q_fine| / Σµp at the centres of the coarse cells."""
    found, other = shear_of(coarse.steps[-1]), shear_of(fine.steps[-1])
    difference = found - at_centres(coarse.grid.cells, other)
    size = (difference[0] ** 2 + difference[1] ** 2) ** 0.5
    return float(size.mean() / (ONE.friction * fine.steps[-1].pressure.mean()))


def cell_side(result: Result) -> float:
    """Cell side over the contact radius of the reference."""
    return result.grid.spacing[0] / ONE.contact_radius


def _run(cells: int, increments: int) -> Run:
    """The reference's scene, cut into other increments than it names."""

    def cut(plan: Plan) -> Plan:
        return plan.cut_into((increments,))

    return Run(
        f"{cells}x{cells}, {increments} increments",
        ONE.problem(CELLS_INCREMENTS).scene,
        paper.square_grid(cells, paper.WINDOW_PER_RADIUS / 2 * ONE.contact_radius),
        effects=cut,
    )


def _approach_error(few: Result, many: Result) -> float:
    extrapolated = approach(many) + (approach(many) - approach(few)) / 3
    return abs(extrapolated / ONE.approach - 1)


def _part_of_stick(cells: float) -> float:
    """A part of a cell on the quick grid over the stick radius."""
    return cells * paper.WINDOW_PER_RADIUS / QUICK_CELLS / ONE.stick_part


def _charts(
    results: Mapping[str, Result], meshes: tuple[Run, ...], paths: tuple[Run, ...]
) -> tuple[Chart, ...]:
    if not meshes or not paths:
        return ()
    by_cells, by_increments = ([results[run.label] for run in runs] for runs in (meshes, paths))
    return (
        convergence_chart(
            "indentation_cells",
            "Smaller cells",
            f"Change on grids finer by about √2 with {CELLS_INCREMENTS} increments, against cell "
            "side.",
            [cell_side(level) for level in by_cells[:-APART]],
            {"shear (L1)": _changes(by_cells, shear_change),
             "approach": _changes(by_cells, approach_change)},
            {"shear (L1)": 1.5, "approach": 2.0},
        ),
        convergence_chart(
            "indentation_increments",
            "Smaller increments",
            f"Change by twice the increments on {INCREMENTS_CELLS} x {INCREMENTS_CELLS} cells.",
            [increment_size(level) for level in by_increments[:-APART]],
            {"shear (L1)": _changes(by_increments, shear_change),
             "approach": _changes(by_increments, approach_change)},
            {"shear (L1)": 1.5, "approach": 2.0},
            "1 / increments",
        ),
    )  # fmt: skip


def _changes(levels: list[Result], change: Callable[[Result, Result], float]) -> list[float]:
    return [change(one, other) for one, other in zip(levels, levels[APART:], strict=False)]


def stick_error(one: Indentation, few: Result, many: Result) -> float:
    """Relative error of the stick radius, extrapolated in the increments."""
    radius = 2 * stick_radius(many) - stick_radius(few)
    return abs(radius / (one.stick_part * one.contact_radius) - 1)
