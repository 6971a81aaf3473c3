"""Adapters by which this program's solvers answer the challenges.

The solvers use surface cells with or without edge correction, finite elements, or rings.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi, sqrt
from typing import Any

import numpy as np
from scipy.interpolate import RectBivariateSpline

import fem_reference
import radial
from contact_scene import (
    RIGID,
    Body,
    FiniteElementDiscretisation,
    RadialDiscretisation,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.array_types import Vector
from contact_scene.discretisation import EdgeCorrection
from contact_scene.quantities.increment import State
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from semi_analytical import Increment, Result, SurfaceGrid, solve_discretised
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.stress import subsurface
from verification.challenge.requested_quantities import Answer, Field, Key, Solver
from verification.challenge.solver_process import CannotDo, Posed
from verification.observed.ring_errors import along_radii, at_radii, outward
from verification.quantities import shear_of

ON_CELLS = Solver("slipstick, semi-analytical")
WITH_EDGES = Solver("slipstick, edges inside the cells", sampling="cell")
ON_ELEMENTS = Solver("slipstick, finite elements")
ON_RADII = Solver("slipstick, radial")
# On the coarsest level: cells per side, elements over the contact radius, and rings. Fields are
# linear between rings, and scalars do not depend on them.
CELLS = 32
ELEMENTS = 16
RINGS = 32
INCREMENTS = 10  # on the coarsest level, of load steps that prescribe none
HARMONICS = 8
TOLERANCE = 1e-8


def scene_on_level(posed: Posed, level: int) -> Scene:
    """Return the contact scene of a challenge with the number of increments of a refinement level.

    Load steps without a prescribed number of increments get 10 times 2^level. Without friction the
    scene is not changed. Raises CannotDo for a challenge of prescribed tractions.

    posed  challenge without its reference
    level  refinement level, from 0
    """
    if "indenter" not in posed.scene:
        raise CannotDo("contacts only, no given tractions")
    scene = Scene.model_validate(posed.scene)
    if scene.friction is None:
        return scene
    number = INCREMENTS * 2**level
    steps = (s.model_copy(update={"increments": s.increments or number}) for s in scene.loading)
    return scene.model_copy(update={"loading": tuple(steps)})


def given_up(posed: Posed, fineness: int, error: Exception) -> Answer:
    """Return an answer without results, for a refinement level on which the solver did not
    converge.

    posed     challenge without its reference
    fineness  cells or elements over a contact radius, which is taken as a third of the window
    error     error of the solver, whose text is the reason
    """
    return Answer(posed.window / 3 / fineness, gave_up={0: str(error)})


def scalar_result(posed: Posed, key: Key, steps: Sequence[State]) -> float | None:
    """Return a number that a challenge requires from the states of a solver.

    The result is None if the solver does not provide the number.

    posed  challenge without its reference
    key    name of the quantity, and number of the load step from 1
    steps  states at the ends of all load steps
    """
    quantity, step = key
    end = steps[step - 1]
    if quantity in ("shift_x", "shift_y"):
        shift = end.tangential_shift
        return None if shift is None else float(shift["xy".index(quantity[-1])])
    if quantity in ("moment_x", "moment_y"):
        return None if end.moment is None else float(end.moment["xy".index(quantity[-1])])
    if quantity == "energy_per_cycle":
        lost = end.dissipated_energy
        before = steps[posed.since[key] - 1].dissipated_energy
        return None if lost is None or before is None else lost - before
    found = getattr(end, quantity, None)
    return None if found is None else float(found)


PER_INTERVAL = 4  # points of Gauss between two rings
TRACTIONS = {
    "pressure": "pressure",
    "shear_x": "shear_along_load",
    "shear_radial": "shear_radial",
    "shear_around": "shear_circumferential",
}


def answer_on_rings(posed: Posed, steps: Any, h: float) -> Answer:
    """Build the answer to a challenge from the results on rings, of finite elements or radial
    solver.

    Quantities that the solver does not provide are left out. Raises CannotDo if none is provided.

    posed  challenge without its reference
    steps  states at the ends of all load steps
    h      size of an element or ring [length]
    """
    scalars: dict[Key, float] = {}
    for key in posed.asked:
        value = scalar_result(posed, key, steps)
        if key[0] == "central_pressure" and np.ndim(steps[0].pressure) == 1:
            value = float(at_radii(steps[0], steps[0].pressure, np.zeros(1))[0])
        if value is not None:
            scalars[key] = value
    fields, points = {}, {}
    for key in posed.fields:
        traction = ring_traction(steps, key)
        if traction is not None:
            fields[key] = field_between_rings(steps[key[1] - 1], traction)
    for key, places in posed.places.items():
        traction = ring_traction(steps, key)
        if traction is not None:
            points[key] = at_radii(
                steps[key[1] - 1], traction, np.hypot(places[:, 0], places[:, 1])
            )
    if not scalars and not fields and not points:
        raise CannotDo("the ring results contain no stress below the surface")
    return Answer(h, scalars, fields, points=points)


def ring_traction(steps: Any, key: Key) -> Vector | None:
    """Return a traction (rings,) that a challenge requires, at the end of a load step.

    The result is None if the solver has no such traction or the traction depends on the angle.

    steps  states at the ends of all load steps
    key    name of the traction, and number of the load step from 1
    """
    found = getattr(steps[key[1] - 1], TRACTIONS.get(key[0], ""), None)
    return None if found is None or np.ndim(found) != 1 else found


def field_between_rings(end: Any, traction: Vector) -> Field:
    """Interpolate a traction from the rings to Gauss points, as the field of an answer to a
    challenge.

    The points lie between the rings in the contact. The area of each point is that of its annulus.

    end       state at the end of a load step
    traction  values at the rings (rings,) [stress]
    """
    inside = end.radii <= 1.05 * end.contact_radius
    r0 = end.radii[:-1][inside[:-1]]
    r1 = end.radii[1:][inside[:-1]]
    nodes, weights = np.polynomial.legendre.leggauss(PER_INTERVAL)
    r = (0.5 * (r0 + r1)[:, None] + 0.5 * (r1 - r0)[:, None] * nodes).ravel()
    area = 2 * pi * r * (0.5 * (r1 - r0)[:, None] * weights).ravel()
    return Field(r, np.zeros_like(r), np.interp(r, end.radii, traction), area)


def answer_on_elements(posed: Posed, level: int) -> Answer:
    """Solve a challenge with finite elements, 16 per contact radius on level 0, doubled at each
    level.

    Raises CannotDo if the finite elements do not support the scene.
    """
    elements = ELEMENTS * 2**level
    on = FiniteElementDiscretisation(elements_per_radius=elements, harmonics=HARMONICS)
    try:
        steps = fem_reference.solve(scene_on_level(posed, level), on).steps
    except UnsupportedScene as error:
        raise CannotDo(str(error)) from error
    except NotConverged as error:
        return given_up(posed, elements, error)
    end = steps[-1]
    sides = np.diff(end.radii)
    at_edge = int(np.searchsorted(end.radii, end.contact_radius))
    return answer_on_rings(posed, steps, float(sides[min(at_edge, sides.size) - 1]))


def answer_on_radii(posed: Posed, level: int) -> Answer:
    """Solve a challenge with the radial solver, with 32 rings on level 0, doubled at each level.

    Raises CannotDo if the radial solver does not support the scene.
    """
    rings = RINGS * 2**level
    try:
        on = RadialDiscretisation(rings=rings)
        steps = radial.solve(scene_on_level(posed, level), on).steps
    except UnsupportedScene as error:
        raise CannotDo(str(error)) from error
    except NotConverged as error:
        return given_up(posed, rings, error)
    return answer_on_rings(posed, steps, steps[-1].contact_radius / rings)


COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
# Names of displacement by traction in the challenge, and of the influence coefficients.
MOVED = {
    "u_z_by_pressure": "zz",
    "u_x_by_shear_x": "xx",
    "u_y_by_shear_y": "yy",
    "u_x_by_shear_y": "xy",
    "u_z_by_shear_x": "zx",
}


def stress_at(result: Result, end: Increment, places: Vector) -> Vector:
    """Compute the stress components (6, n) at n points below the surface [force/length²].

    Stresses at the cell centres are interpolated by cubic splines.

    result  result of the semi-analytical solver
    end     state at the end of a load step
    places  coordinates x, y, z of the points (n, 3) [length]
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
    """Solve a challenge of surface displacements by a uniform traction on a square, without
    contact.

    The square is one cell and the points are centres of other cells. The displacements are
    therefore influence coefficients times the traction.
    """
    side, traction = (posed.scene["patch"][name] for name in ("side", "traction"))
    body = Body.model_validate(posed.scene["body"])
    points: dict[Key, Vector] = {}
    for key, places in posed.places.items():
        i, j = np.rint(places[:, :2].T / side).astype(int)
        offsets = int(i.max()) + 1, int(np.abs(j).max()) + 1
        coefficients = influence_coefficients(body, Body(material=RIGID), (side, side), offsets)
        K = coefficients[MOVED[key[0]]]
        odd = np.where(key[0] == "u_x_by_shear_y", np.sign(j), 1)
        points[key] = traction * odd * K[i, np.abs(j)]
    return Answer(side, unknowns=1, points=points)


def answer_on_cells(posed: Posed, level: int) -> Answer:
    """Solve a challenge with the semi-analytical solver without edge correction of the pressure.

    The grid has 32 cells per side on level 0, doubled at each level. A load history that does not
    converge is reported in the answer; other errors of the solver are raised.
    """
    return _solve_on_cells(posed, level, "off")


def answer_with_edges(posed: Posed, level: int) -> Answer:
    """Solve a challenge with the semi-analytical solver with edge correction of the pressure.

    The grid has 32 cells per side on level 0, doubled at each level.
    """
    return _solve_on_cells(posed, level, "last")


def _solve_on_cells(posed: Posed, level: int, edge: EdgeCorrection) -> Answer:
    if "indenter" not in posed.scene:
        return under_a_patch(posed)
    cells = CELLS * 2**level
    on = SurfaceDiscretisation(
        cells=(cells, cells), window=(posed.window, posed.window), tolerance=TOLERANCE, edge=edge
    )
    try:
        result = solve_discretised(scene_on_level(posed, level), on)
    except NotConverged as error:
        return given_up(posed, cells // 3, error)
    grid = result.grid
    scalars = {
        key: value for key in posed.asked if (value := cell_scalar(posed, key, result)) is not None
    }
    x, y = grid.coordinates()
    fields, points = {}, {}
    for quantity, step in posed.fields:
        end = result.steps[step - 1]
        contact = end.pressure > 0
        area = np.full(int(np.sum(contact)), grid.cell_area)
        traction = cell_traction(quantity, end, grid)[contact]
        fields[quantity, step] = Field(x[contact], y[contact], traction, area)
    for key, places in posed.places.items():
        points[key] = _values_at_points(places, key, result)
    return Answer(sqrt(grid.cell_area), scalars, fields, unknowns=cells**2, points=points)


def cell_traction(quantity: str, end: Increment, grid: SurfaceGrid) -> Vector:
    """Return a traction that a challenge requires, at the cell centres (nx, ny), from the state of
    a step.

    quantity  "pressure", "shear_x", "shear_radial" or "shear_around" (circumferential)
    end       state at the end of a load step
    grid      surface grid of the result
    """
    x, y = grid.coordinates()
    q_x, q_y = shear_of(end)
    r = np.hypot(x, y)
    of = {"pressure": end.pressure, "shear_x": q_x, "shear_radial": outward(shear_of(end), grid)}
    of["shear_around"] = (x * q_y - y * q_x) / np.where(r > 0, r, 1.0)
    return np.asarray(of[quantity])


def _values_at_points(places: Vector, key: Key, result: Result) -> Vector:
    """Compute the numbers that a challenge requires at given points, from a result on cells.

    A traction is interpolated to the distance of each point from the axis and averaged over the
    angle. A stress component is computed at the points.

    places  coordinates x, y, z of the points (n, 3) [length]
    key     name of the quantity, and number of the load step from 1
    result  result of the semi-analytical solver
    """
    quantity, end, grid = key[0], result.steps[key[1] - 1], result.grid
    if quantity.startswith("stress"):
        return stress_at(result, end, places)[COMPONENTS.index(quantity.removeprefix("stress_"))]
    along = along_radii(cell_traction(quantity, end, grid), grid, np.hypot(*places[:, :2].T))
    return np.asarray(np.mean(along, axis=1))


def cell_scalar(posed: Posed, key: Key, result: Result) -> float | None:
    """Return a number that a challenge requires from a result on cells; None if the result has
    none.

    posed   challenge without its reference
    key     name of the quantity, and number of the load step from 1
    result  result of the semi-analytical solver
    """
    end = result.steps[key[1] - 1]
    known = numbers_of_pressure(end.pressure, *result.grid.coordinates())
    return known[key[0]] if key[0] in known else scalar_result(posed, key, result.steps)


def numbers_of_pressure(pressure: Vector, x: Vector, y: Vector) -> dict[str, float]:
    """Compute the numbers that a challenge requires of a pressure on an even number of cells.

    The semi-axes are those of the half-ellipsoid of equal second moments: <x²> = a²/5.

    pressure  pressure at the cells (nx, ny)
    x, y      coordinates of the cell centres (nx, ny) [length]
    """
    i, j = (n // 2 for n in pressure.shape)
    square_x, square_y = (float(np.sum(pressure * s**2) / np.sum(pressure)) for s in (x, y))
    return {
        "semi_axis_x": sqrt(5 * square_x),
        "semi_axis_y": sqrt(5 * square_y),
        "central_pressure": float(np.mean(pressure[i - 1 : i + 1, j - 1 : j + 1])),
    }
