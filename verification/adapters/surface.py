"""Our semi-analytical method as anybody's code: scene in, numbers and cells out."""

from __future__ import annotations

from math import sqrt

import numpy as np

from contact_scene import SurfaceDiscretisation
from contact_scene.discretisation import EdgeCorrection
from contact_scene.solver_errors import NotConverged
from semi_analytical import Increment, Result, SurfaceGrid, solve_discretised
from verification.adapters.own_numbers import given_up, in_increments, number, scene_of
from verification.adapters.surface_places import COMPONENTS, stress_at, under_a_patch
from verification.challenge.answer import Answer, Field, Key, Solver, Vector
from verification.challenge.python_api import Posed
from verification.observed.radial_profile import along_radii, outward
from verification.quantities import shear_of

ON_CELLS = Solver("slipstick, semi-analytical")
WITH_EDGES = Solver("slipstick, edges inside the cells", sampling="cell")
COARSEST = 32
INCREMENTS = 10  # on the coarsest, of steps that name none
TOLERANCE = 1e-8


def answer(posed: Posed, level: int) -> Answer:
    """On COARSEST, twice as many, … cells a side; raises what `solve` raises."""
    return _answer(posed, level, "off")


def answer_with_edges(posed: Posed, level: int) -> Answer:
    """The same with the edge of the contact inside the cells, where the plan knows how."""
    return _answer(posed, level, "last")


def _answer(posed: Posed, level: int, edge: EdgeCorrection) -> Answer:
    if "indenter" not in posed.scene:
        return under_a_patch(posed)
    cells = COARSEST * 2**level
    on = SurfaceDiscretisation(
        cells=(cells, cells), window=(posed.window, posed.window), tolerance=TOLERANCE, edge=edge
    )
    try:
        result = solve_discretised(in_increments(scene_of(posed), INCREMENTS * 2**level), on)
    except NotConverged as error:
        return given_up(posed, cells // 3, error)
    grid = result.grid
    scalars = {
        key: value for key in posed.asked if (value := _number(posed, key, result)) is not None
    }
    x, y = grid.coordinates()
    fields, points = {}, {}
    for quantity, step in posed.fields:
        end = result.steps[step - 1]
        contact = end.pressure > 0
        area = np.full(int(np.sum(contact)), grid.cell_area)
        traction = _traction(quantity, end, grid)[contact]
        fields[quantity, step] = Field(x[contact], y[contact], traction, area)
    for key, places in posed.places.items():
        points[key] = _at(places, key, result)
    return Answer(sqrt(grid.cell_area), scalars, fields, unknowns=cells**2, points=points)


def _traction(quantity: str, end: Increment, grid: SurfaceGrid) -> Vector:
    x, y = grid.coordinates()
    q_x, q_y = shear_of(end)
    r = np.hypot(x, y)
    of = {"pressure": end.pressure, "shear_x": q_x, "shear_radial": outward(shear_of(end), grid)}
    of["shear_around"] = (x * q_y - y * q_x) / np.where(r > 0, r, 1.0)
    return np.asarray(of[quantity])


def _at(places: Vector, key: Key, result: Result) -> Vector:
    """Tractions at radii of a round contact, or stress below the surface."""
    quantity, end, grid = key[0], result.steps[key[1] - 1], result.grid
    if quantity.startswith("stress"):
        return stress_at(result, end, places)[COMPONENTS.index(quantity.removeprefix("stress_"))]
    along = along_radii(_traction(quantity, end, grid), grid, np.hypot(*places[:, :2].T))
    return np.asarray(np.mean(along, axis=1))


def _number(posed: Posed, key: Key, result: Result) -> float | None:
    quantity, end, grid = key[0], result.steps[key[1] - 1], result.grid
    if quantity.startswith("semi_axis"):
        x, y = grid.coordinates()
        axes = [float(np.sum(end.pressure * s**2) / np.sum(end.pressure)) for s in (x, y)]
        return sqrt(5 * axes["xy".index(quantity[-1])])  # of a half-ellipsoid: <x²> = a²/5
    if quantity == "central_pressure":
        i, j = (n // 2 for n in grid.cells)
        return float(np.mean(end.pressure[i - 1 : i + 1, j - 1 : j + 1]))
    return number(posed, key, result.steps)
