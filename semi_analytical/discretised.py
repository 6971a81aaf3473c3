"""Semi-analytical solver with variable discretisation, for runs, error estimates and refinement.

The variable parameters are the grid of cells, the increments and the tolerance.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil
from typing import Any, ClassVar, Self

import numpy as np

from contact_scene import SurfaceDiscretisation
from contact_scene.contact_features import (
    EDGE,
    PEAK,
    ROOT,
    SMOOTH,
    Features,
    has_cusp,
    is_singular,
)
from contact_scene.discretised import (
    SHARES_OF_SMALL,
    Discretisation,
    DiscretisedSolver,
    Fineness,
    Pairs,
    Refinement,
    Share,
    Work,
    coarse_tolerance,
)
from contact_scene.quantities.stated_error import (
    Part,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.reading.scene_text import MAX_STEPS_SHOWN
from semi_analytical import memory
from semi_analytical.default_grid import align_to_edges, discretise
from semi_analytical.edge.corrected import EdgeReport
from semi_analytical.edge.film import film_law
from semi_analytical.edge.fit import WIDE
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid
from semi_analytical.increment_counts import WITHOUT_SLIP
from semi_analytical.operator.domain import WINDOW
from semi_analytical.operator.transforms import fast_length
from semi_analytical.plan import Coupling, Plan, plan
from semi_analytical.resolution import resolution, resolution_at, unresolved_pressure
from semi_analytical.solve import solve_discretised, solve_within

# Cells over the contact radius in the solves for the increment error. The effect of increments on
# 24² and on 64² cells differs by at most 7 %.
PER_RADIUS = 11
# Cells along the shorter side of the largest small grid: a third of them are 10, with 4 to 5 per
# contact radius on a fitted window. A contact needs 4.
SMALL = 32
# Smallest contact, in cells for its radius, in which the slip amplitude is fitted at the edge.
FITTED_SLIP = 7.0
# Largest height of a random surface over its root mean square, exceeded at 0.1 % of the positions.
HIGHEST = 3.0
# Cells along the shorter side of the first level: 11 per radius on a fitted window.
FIRST_CELLS = 24
# Requested relative increment error of the shear on the first level.
FIRST_PATH_ACCURACY = 4e-2
MAX_CELLS = 16384
# Scalars to which the remaining error of the approach in the edge correction applies.
MOTIONS = "approach", "normal_force", "tilt", "moment", "elastic_energy", "input_work"
# Factor and largest number of enlargements of a fitted window whose edge the contact reaches.
ROOM = 1.25
MAX_ENLARGEMENTS = 5
# Unknowns whose work equals the overhead of an operation. Measured on the scenes of
# `tests/test_cost_estimate.py`: 9000 to 27 000.
CELL_OVERHEAD = 128.0**2


@dataclass(frozen=True)
class CellSolver(DiscretisedSolver):
    """Semi-analytical solver of one scene, with variable grid, increments and tolerance.

    discretisation  settings of the scene file: window if prescribed, ratio of the cells along the
                    sides, tolerance of the first level
    chosen_plan     plan of a solved result (modelled effects and increments); None for the plan
                    made of the scene
    """

    discretisation: SurfaceDiscretisation
    chosen_plan: Plan | None = None

    table: ClassVar[str] = "semi_analytical"
    settings: ClassVar[type[Discretisation]] = SurfaceDiscretisation
    part: ClassVar[Part] = "cells"
    cells: ClassVar[str] = "cells"
    most: ClassVar[float] = MAX_CELLS

    @classmethod
    def of(cls, result: Result) -> Self:
        return cls(result.scene, SurfaceDiscretisation(), replace(result.plan, areas="last"))

    @property
    def plan(self) -> Plan:
        """Plan of a solve: modelled physical effects, and increments of each load step.

        The plan is that of the solved result, if there is one. Otherwise it is made from the scene,
        with the increments of the first refinement level.
        """
        return self.chosen_plan or plan(self.scene, FIRST_PATH_ACCURACY, self.discretisation.edge)

    @cached_property
    def run_plan(self) -> Plan:
        return plan(self.scene, self.discretisation.path_accuracy, self.discretisation.edge)

    def run(self, progress: Any = None, store: Any = None) -> Result:
        return solve_discretised(self.scene, self.discretisation, progress, self.run_plan, store)

    def run_fineness(self) -> Fineness:
        grid = discretise(self.scene, self.discretisation)
        return Fineness(grid, self.run_plan.increments, self.discretisation.tolerance)

    def describe_space(self) -> Pairs:
        left_open = [
            name for name in ("cells", "window") if getattr(self.discretisation, name) is None
        ]
        chosen = f" ({' and '.join(left_open)} chosen)" if left_open else ""
        yield "grid", _grid_text(discretise(self.scene, self.discretisation)) + chosen

    def describe_work(self) -> Pairs:
        if any(step.path_matters for step in self.run_plan.path):
            accuracy = f"{self.discretisation.path_accuracy:.3g}"
            yield "path accuracy", f"{accuracy}, for load steps without prescribed increments"

    def increment_reasons(self) -> Sequence[tuple[str, str, str]]:
        """Return load step, number of increments and reason of this number, as texts for a table.

        The first load steps are listed. The sequence is empty if no load step has an increment
        error or grows without slip.
        """
        path = self.run_plan.path
        if not any(step.path_matters or step.why == WITHOUT_SLIP for step in path):
            return ()
        shown = [
            (str(number), str(step.count), step.why)
            for number, step in enumerate(path[:MAX_STEPS_SHOWN], start=1)
        ]
        return shown if len(path) <= MAX_STEPS_SHOWN else [*shown, ("…", "", "")]

    def describe_result(self, result: Result) -> Pairs:
        yield "grid", _grid_text(result.grid)

    def solve(self, fineness: Fineness, progress: Any = None, store: Any = None) -> Result:
        """Solve the scene on a grid of surface cells.

        If the contact reaches the border of the window, the scene is solved on a larger window with
        cells of equal size, at most `MAX_ENLARGEMENTS` times. A window that is prescribed or that
        is the extent of a height map is not enlarged. Raises the errors of the last solve, such as
        ContactAtWindowEdge.

        fineness  grid, increments and tolerance
        progress  function that is called after every increment, or None
        store     checkpoint store of the solve, or None
        """
        grids, decided = [fineness.space], self.plan.cut_into(fineness.increments)
        decided = decided if fineness.edges else replace(decided, edge="off")
        if not self.scene.indenter.is_even:  # half of an even number of points
            decided = replace(decided, symmetry=WINDOW)
        fitted = self.discretisation.window is None and self.scene.indenter.extent is None
        for _ in range(MAX_ENLARGEMENTS if fitted else 0):
            cells, (hx, hy) = scale_cells(grids[-1].cells, ROOM), grids[-1].spacing
            grids.append(SurfaceGrid(cells, (cells[0] * hx, cells[1] * hy)))  # strips keep hy
        return solve_within(self.scene, grids, fineness.tolerance, progress, decided, store)

    def space_of(self, result: Result) -> SurfaceGrid:
        return result.grid

    def coarser(self, result: Result, share: float, more: int) -> SurfaceGrid:
        """Return a grid with other cells on the window of a result, for its error estimate.

        The numbers of cells are increased to even numbers.

        result  result whose errors are estimated
        share   fraction of the cells of the result along a side
        more    number of cells added along each side
        """
        nx, ny = (2 * ceil(share * n / 2) + more if n > 1 else 1 for n in result.grid.cells)
        return align_to_edges(self.scene, SurfaceGrid((nx, ny), result.grid.window))

    def shares_of(self, space: SurfaceGrid) -> Sequence[Share]:
        """Return the coarse solves in the cells: on small grids, a coarser and a finer one.

        A third or half of few cells would not resolve the contact, and less often its stick zone.
        The finer solve takes about twice the time of the run.
        """
        least = space.cells[0] if space.of_strips else min(space.cells)
        return SHARES_OF_SMALL if least <= SMALL else self.shares

    def few(self, coarse: Fineness, result: Result) -> Fineness:
        """Return the discretisation of the coarse solves that measure the increment error.

        The grid has at most about half of the result's cells along a side, and at most about 11
        cells (`PER_RADIUS`) per contact radius, which suffice to measure the effect of increments.
        The edge correction is off, because it has no effect on the shear of later increments.

        coarse  discretisation with the cells of a coarse solve
        result  result whose errors are estimated
        """
        most = max(step.contact for step in resolution(result))
        few = self.coarser(result, min(PER_RADIUS / max(most, 1.0), 1 / 2), 0)
        tolerance = max(coarse.tolerance, coarse_tolerance(PER_RADIUS))
        return replace(coarse, space=few, tolerance=tolerance, edges=False)

    def cell_sides(self, result: Result) -> tuple[float, ...]:
        grid = result.grid
        return grid.spacing[:1] if grid.of_strips else grid.spacing

    def unknowns(self, result: Result) -> int:
        nx, ny = result.grid.cells
        return nx * ny * (3 if result.plan.shear else 1)

    def record_entry(self, space: SurfaceGrid) -> Mapping[str, Any]:
        return {"cells": space.cells}

    def neglected_errors(self, result: Result) -> Mapping[str, float]:
        return {PEAK: HIGHEST * unresolved_pressure(result)}

    def measure_features(self, result: Result, end: Increment) -> Features:
        indenter, coupled = self.scene.indenter, result.plan.coupling is not Coupling.NONE
        cells, report = resolution_at(result, end), end.edge_report
        if report is not None and report.cause is not None:
            report = None
        # The fit assumes the square-root pressure edge of a half-space, over more cells than the
        # layer is thick.
        thin = cells.layer is not None and cells.layer < WIDE.reach
        law = thin and not coupled and film_law(self.scene.body, indenter, result.grid.spacing)
        sliding = end.status is ContactStatus.GROSS_SLIDING
        hides = sliding and _may_hide_stick(end)
        ridge = report is not None and report.ridge
        fitted = report is not None and (not thin or bool(law))
        largest_order = SMOOTH if fitted or not is_singular(indenter) else EDGE
        if indenter.rim is not None:
            largest_order = ROOT
        return Features(
            contact=cells.contact,
            layer=cells.layer,
            wave=cells.wave,
            stick=cells.stick,
            annulus=0.0 if hides else cells.annulus,
            fitted=fitted,
            stick_fitted=_fits_stick(result.plan, report),
            slip_fitted=report is not None and cells.contact >= FITTED_SLIP,
            largest_order=largest_order,
            infinite=is_singular(indenter),
            cusp=coupled or has_cusp(indenter),
            peak_by_edge=ridge or _distance_of_peak_to_edge(end) < cells.contact / 2,
            slides=sliding and not hides,
            left={} if report is None else _remaining_edge_errors(report),
        )

    def first_space(self) -> SurfaceGrid:
        grid = discretise(self.scene, self.discretisation)
        least = grid.cells[0] if grid.of_strips else min(grid.cells)
        cells = scale_cells(grid.cells, FIRST_CELLS / least)
        return align_to_edges(self.scene, SurfaceGrid(cells, grid.window))

    def refine_space(self, space: SurfaceGrid, by: Refinement) -> SurfaceGrid:
        cells = scale_cells(space.cells, by.get(self.part, 1.0))
        return align_to_edges(self.scene, SurfaceGrid(cells, space.window))

    def work(self, fineness: Fineness) -> Work:
        nx, ny = fineness.space.cells
        tractions = 3 if self.plan.shear else 1
        return Work(nx * ny * tractions, sum(fineness.increments), CELL_OVERHEAD)

    def memory(self, fineness: Fineness) -> int:
        return memory.estimated_bytes(fineness.space, self.plan.cut_into(fineness.increments))

    def stress_memory(self, fineness: Fineness) -> int:
        if not self.scene.body.deforms:
            return 0
        from semi_analytical.stress.field import bytes_below_contact

        return memory.LIBRARIES + memory.SCIPY + bytes_below_contact(fineness.space)


def _fits_stick(plan: Plan, report: EdgeReport | None) -> bool:
    """Return true if the edge of the stick zone is fitted within cells, by the edge correction or,
    for coupled bodies, `stick_area`. In torsion the errors of that fit converge with order 1."""
    if plan.coupling is not Coupling.NONE:
        return not plan.torsion
    return report is not None and report.stick is not None


def _remaining_edge_errors(report: EdgeReport) -> Mapping[str, float]:
    """Return the relative errors of scalars, by name,
    from the error at which the edge correction stops."""
    stick = report.stick or report.radius  # without a border of stick it is that of the contact
    return {
        **dict.fromkeys(MOTIONS, report.response),
        "contact_radius": report.radius,
        "contact_area": 2 * report.radius,
        "stick_radius": stick,
        "stick_area": 2 * stick,
        PEAK: report.peak,
    }


def _distance_of_peak_to_edge(end: Increment) -> float:
    """Compute the distance of the largest pressure from the contact edge, in cells.
    A maximum near the edge converges with a lower order."""
    place = np.unravel_index(np.argmax(end.pressure), end.pressure.shape)
    offsets = np.argwhere(~end.in_contact) - place
    return float(np.sqrt(np.min(np.sum(offsets**2, axis=1))))


def _may_hide_stick(end: Increment) -> bool:
    """Return true if a stick zone smaller than a cell is possible although all cells slip.

    It is possible if the smallest slip increment of a cell is at most half of the largest slip
    increment of the adjacent cells. Error estimates of slip are then unreliable. It is impossible
    at the friction limit under force control, where the slip is undefined.
    """
    if end.slip_increment is None:
        return False
    slip = np.hypot(*np.asarray(end.slip_increment)) * end.in_contact
    # The edge correction may add cells to the contact in which no slip was solved.
    i, j = np.unravel_index(np.argmin(np.where(slip > 0, slip, np.inf)), slip.shape)
    around = slip[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2]
    return bool(2 * slip[i, j] <= np.max(around))


def scale_cells(cells: tuple[int, int], factor: float) -> tuple[int, int]:
    """Multiply the numbers of cells of a grid along x and y by a factor.

    Used for finer grids and for larger windows. The products are increased to even numbers whose
    halves have no prime factor above 5. Fourier transforms of such numbers of cells are fast. One
    row of strips remains one row.

    cells   numbers of cells along x and y
    factor  factor of both numbers
    """
    nx, ny = (2 * fast_length(ceil(round(factor * n, 6) / 2)) for n in cells)
    return nx, 1 if cells[1] == 1 else ny


def _grid_text(grid: SurfaceGrid) -> str:
    """Return the text of cells and window of a grid, such as "64 x 64 cells on 2 x 2 mm"."""
    (nx, ny), (Lx, Ly) = grid.cells, grid.window
    if grid.of_strips:
        return f"{nx} strips on {engineering_unit(Lx, 'm').text(Lx)}"
    length = engineering_unit(max(Lx, Ly), "m")
    return f"{nx} x {ny} cells on {Lx / length.size:.4g} x {length.text(Ly)}"
