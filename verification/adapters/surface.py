"""Our semi-analytical method as anybody's code: scene in, numbers and cells out."""

from __future__ import annotations

from math import sqrt

import numpy as np

from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.discretisation import EdgeCorrection
from semi_analytical import Increment, SurfaceGrid, solve_discretised
from verification.challenge.answer import Answer, Field, Key, Solver
from verification.challenge.door import Posed

ON_CELLS = Solver("slipstick, semi-analytical")
WITH_EDGES = Solver("slipstick, edges inside the cells", sampling="cell")
COARSEST = 32
TOLERANCE = 1e-8


def answer(posed: Posed, level: int) -> Answer:
    """On COARSEST, twice as many, … cells a side; raises what `solve` raises."""
    return _answer(posed, level, "off")


def answer_with_edges(posed: Posed, level: int) -> Answer:
    """The same with the edge of the contact inside the cells, where the plan knows how."""
    return _answer(posed, level, "last")


def _answer(posed: Posed, level: int, edge: EdgeCorrection) -> Answer:
    cells = COARSEST * 2**level
    on = SurfaceDiscretisation(
        cells=(cells, cells), window=(posed.window, posed.window), tolerance=TOLERANCE, edge=edge
    )
    result = solve_discretised(Scene.model_validate(posed.scene), on)
    grid = result.grid
    scalars: dict[Key, float] = {}
    for quantity, step in posed.asked:
        value = _scalar(quantity, result.steps[step - 1], grid)
        if quantity == "energy_per_cycle":
            first = min(s for q, s in posed.asked if q == "shift_x") + 3
            before, after = (result.steps[s - 1].dissipated_energy for s in (first, step))
            value = None if before is None or after is None else after - before
        if value is not None:
            scalars[quantity, step] = value
    x, y = grid.coordinates()
    fields = {}
    for quantity, step in posed.fields:
        end = result.steps[step - 1]
        contact = end.pressure > 0
        traction = end.pressure if quantity == "pressure" or end.shear is None else end.shear[0]
        area = np.full(int(np.sum(contact)), grid.cell_area)
        fields[quantity, step] = Field(x[contact], y[contact], traction[contact], area)
    return Answer(sqrt(grid.cell_area), scalars, fields, unknowns=cells**2)


def _scalar(quantity: str, end: Increment, grid: SurfaceGrid) -> float | None:
    if quantity == "shift_x":
        return None if end.tangential_shift is None else end.tangential_shift[0]
    if quantity.startswith("semi_axis"):
        x, y = grid.coordinates()
        axes = [float(np.sum(end.pressure * s**2) / np.sum(end.pressure)) for s in (x, y)]
        return sqrt(5 * axes["xy".index(quantity[-1])])  # of a half-ellipsoid: <x²> = a²/5
    if quantity == "central_pressure":
        i, j = (n // 2 for n in grid.cells)
        return float(np.mean(end.pressure[i - 1 : i + 1, j - 1 : j + 1]))
    found = getattr(end, quantity, None)
    return None if found is None else float(found)
