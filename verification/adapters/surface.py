"""Adapter of the semi-analytical solver to the challenges."""

from __future__ import annotations

from math import sqrt

import numpy as np
from scipy.interpolate import RectBivariateSpline

from contact_scene import RIGID, Body, SurfaceDiscretisation
from contact_scene.discretisation import EdgeCorrection
from contact_scene.solver_errors import NotConverged
from semi_analytical import Increment, Result, SurfaceGrid, solve_discretised
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.stress import subsurface
from verification.adapters.own_numbers import given_up, in_increments, number, scene_of
from verification.challenge.answer import Answer, Field, Key, Solver, Vector
from verification.challenge.python_api import Posed
from verification.observed.ring_errors import along_radii, outward
from verification.quantities import shear_of

COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
# Names of displacement by traction in the challenge, and of the influence coefficients.
MOVED = {
    "u_z_by_pressure": "zz", "u_x_by_shear_x": "xx", "u_y_by_shear_y": "yy",
    "u_x_by_shear_y": "xy", "u_z_by_shear_x": "zx",
}  # fmt: skip


def stress_at(result: Result, end: Increment, places: Vector) -> Vector:
    """Compute the stress components (6, n) at points below the surface [force/length²].

    Values at the cell centres are interpolated by cubic splines.

    end     state at the end of a load step
    places  coordinates of the points (n, 3) [length]
    """
    grid = result.grid
    depths, of = np.unique(places[:, 2], return_inverse=True)
    field = subsurface(result.scene, grid, end.pressure, shear_of(end), list(depths)).stress
    return np.array(
        [
            [
                float(RectBivariateSpline(grid.x, grid.y, field[level, n])(x, y)[0, 0])
                for (x, y, _), level in zip(places, of, strict=True)
            ]
            for n in range(6)
        ]
    )


def under_a_patch(posed: Posed) -> Answer:
    """Compute displacements by a uniform traction on a square patch, for a challenge.

    The patch is a cell and the points are centres of other cells, so that the displacements are
    influence coefficients.
    """
    side, traction = (posed.scene["patch"][name] for name in ("side", "traction"))
    body = Body.model_validate(posed.scene["body"])
    points: dict[Key, Vector] = {}
    for key, places in posed.places.items():
        i, j = np.rint(places[:, :2].T / side).astype(int)
        offsets = int(i.max()) + 1, int(np.abs(j).max()) + 1
        K = getattr(
            influence_coefficients(body, Body(material=RIGID), (side, side), offsets), MOVED[key[0]]
        )
        odd = np.where(key[0] == "u_x_by_shear_y", np.sign(j), 1)
        points[key] = traction * odd * K[i, np.abs(j)]
    return Answer(side, unknowns=1, points=points)


ON_CELLS = Solver("slipstick, semi-analytical")
WITH_EDGES = Solver("slipstick, edges inside the cells", sampling="cell")
COARSEST = 32
INCREMENTS = 10  # on the coarsest level, of load steps that prescribe none
TOLERANCE = 1e-8


def answer(posed: Posed, level: int) -> Answer:
    """Solve a challenge with 32 cells per side, doubled at each level, without edge correction.

    Raises the errors of the semi-analytical solver, except that a history that does not converge is
    reported in the answer.
    """
    return _answer(posed, level, "off")


def answer_with_edges(posed: Posed, level: int) -> Answer:
    """Solve a challenge on cells, with the edge correction of the pressure where it is supported.

    The grids are those of `answer`.
    """
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
    """Evaluate a traction at the radii of points of a round contact, or a stress component at
    points.

    places  coordinates of the points [length]
    key     name of the quantity and number of the load step, from 1
    """
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
