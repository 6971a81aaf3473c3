"""Error norms of computed pressure and shear fields against the exact fields of a problem.

Each function compares one field at the end of a load step. Its arguments are the result of a solver
on cells or on finite elements, the index of the load step, and the problem with the exact fields.
Verification cases judge these norms.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.ndimage import laplace

from contact_scene.array_types import Field, Mask
from verification import norms
from verification.norms import cell_means, max_norm
from verification.observed import ring_errors
from verification.observed.ring_errors import (
    along_radii,
    at_radii,
    is_corrected,
    judged_within,
    outward,
)
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.problem import FRICTION, OVER_PEAK, Problem
from verification.quantities import shear_of

# Half-width of the excluded zone around a stick edge, over the contact radius.
AT_EDGE = 0.1


def _exact_on_cells(result: Any, end: Any, exact: Callable[..., Field], problem: Problem) -> Field:
    """Evaluate an exact field (nx, ny) on the cells of a result, to compare a computed field with
    it.

    The values are those at the cell centres. If the edge correction is applied, they are means over
    the cells, because corrected tractions are means.

    result   result on cells
    end      increment at the end of the load step
    exact    exact field as a function of the distance from the axis, or of x and y
    problem  problem that the field belongs to
    """
    if is_corrected(end):
        return exact_means(result, exact, problem)
    return problem.on_surface(exact, *result.grid.coordinates())


def exact_means(result: Any, exact: Callable[..., Field], problem: Problem) -> Field:
    """Compute the means (nx, ny) of an exact field over the cells of a result.

    exact    exact field as a function of the distance from the axis, or of x and y
    problem  problem that the field belongs to
    """
    x, y = result.grid.coordinates()
    sides = np.full_like(x, result.grid.spacing[0]), np.full_like(x, result.grid.spacing[1])
    return cell_means(lambda x, y: problem.on_surface(exact, x, y), x, y, sides)


def pressure_l1(result: Any, step: int, problem: Problem) -> float:
    """Compute the L1 error Σ|p - p_exact| / Σ p_exact of the pressure [1].

    The sums extend over all cells. On finite elements they are integrals over the contact, relative
    to the computed pressure.

    result   result on cells or on finite elements
    step     index of the load step, at whose end the pressure is taken
    problem  problem with the exact pressure
    """
    end, exact = result.steps[step], problem.ends[step].pressure
    if not hasattr(result, "grid"):
        return ring_errors.relative_l1(end, end.pressure, exact, problem.radius)
    return norms.relative_l1(end.pressure, _exact_on_cells(result, end, exact, problem))


def pressure_l2(result: Any, step: int, problem: Problem) -> float:
    """Compute the relative L2 error of the pressure, √Σ(p - p_exact)² / √Σ p_exact² [1].

    On cells the sums extend over all cells. On finite elements the sums are integrals over the
    radius, and the computed pressure is linear between the rings.

    result   result on cells or on finite elements
    step     index of the load step, at whose end the pressure is taken
    problem  problem with the exact pressure
    """
    end, exact = result.steps[step], problem.ends[step].pressure
    if hasattr(result, "grid"):
        return norms.relative_l2(end.pressure, _exact_on_cells(result, end, exact, problem))
    return ring_errors.relative_l2(end, end.pressure, exact, problem.radius)


def relative_pressure_error(inner: float, outer: float) -> Callable[[Any, int, Problem], float]:
    """Return the measure of the largest pressure error |p / p_exact - 1| between two radii [1].

    The bounds exclude an infinite pressure at an apex or a rim, and the zero at a contact edge. The
    points are cells, strips or rings.

    inner, outer  bounds of the distance from the axis, over the contact radius
    """

    def measure(result: Any, step: int, problem: Problem) -> float:
        end = result.steps[step]
        on_cells = hasattr(result, "grid")
        x, y = result.grid.coordinates() if on_cells else (end.radii, np.zeros_like(end.radii))
        part = np.hypot(x, y) / problem.radius
        judged = (part >= inner) & (part < outer)
        exact = problem.on_surface(problem.ends[step].pressure, x[judged], y[judged])
        return max_norm(end.pressure[judged] / exact - 1)

    return measure


def largest_pressure_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the largest pressure error of finite elements away from the contact edge, over p_H
    [1].

    The points are the rings, or the radii of the reference if it is tabulated, up to 0.9 of the
    contact radius (less on coarse meshes). p_H is the Hertz peak pressure.

    result   finite element result
    step     index of the load step, at whose end the pressure is taken
    problem  problem with the exact pressure
    """
    end, exact = result.steps[step], problem.ends[step]
    within = judged_within(result.discretisation.elements_per_radius) * problem.radius
    tabulated = getattr(exact, "radii", None)
    r = end.radii if tabulated is None else tabulated
    found = end.pressure if tabulated is None else at_radii(end, end.pressure, r)
    return max_norm((found - exact.pressure(r))[r <= within]) / problem.scale(OVER_PEAK)


def shear_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the L1 error of the shear over the friction limit, Σ|q - q_exact| / Σµp [1].

    On cells the sums extend over all cells, and q is a vector. On finite elements the sums are
    integrals over the contact, and q is the component along the load.

    result   result on cells or on finite elements
    step     index of the load step, at whose end the shear is taken
    problem  problem with the exact shear
    """
    end, exact = result.steps[step], problem.ends[step].shear
    if hasattr(result, "grid"):
        known = _exact_on_cells(result, end, exact, problem)
        return norms.shear_error(shear_of(end), known, FRICTION * end.pressure)
    return ring_errors.relative_l1(end, end.shear_along_load, exact, problem.radius) / FRICTION


def shear_error_of_loop(result: Any, found: Any, exact: Any) -> float:
    """Compute the shear error Σ|q - q_exact| / Σµp of an increment of a fretting loop on cells [1].

    found  increment of the result
    exact  exact state of the contact, with the shear as a function of the distance from the axis
    """
    r = np.hypot(*result.grid.coordinates())
    return norms.shear_error(shear_of(found), exact.shear(r), FRICTION * found.pressure)


def away_from_edges(r: Field, judged: float, edges: Sequence[float], radius: float) -> Mask:
    """Select radii that lie inside the contact and not close to an edge of a stick zone.

    The exact shear has a cusp at the edge of a stick zone, where computed errors are large. Returns
    a mask of the shape of r.

    r       distances from the axis [length]
    judged  fraction of the contact radius up to which radii are selected
    edges   radii of the edges of the stick zones [length]
    radius  contact radius; radii within 0.1 of it from an edge are not selected [length]
    """
    smooth = r <= judged * radius
    for edge in edges:
        smooth &= np.abs(r - edge) > AT_EDGE * radius
    return smooth


def shear_around_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the largest error of the circumferential shear of a ball in torsion, over µp_H [1].

    The points are the rings inside the contact that are not close to the contact edge or to the
    edge of the stick zone. p_H is the Hertz peak pressure.

    result   finite element result
    step     index of the load step, at whose end the shear is taken
    problem  problem with the exact shear
    """
    end, exact = result.steps[step], problem.ends[step]
    within = judged_within(result.discretisation.elements_per_radius)
    smooth = away_from_edges(end.radii, within, [exact.stick_radius], problem.radius)
    error = end.shear_circumferential[smooth] - exact.shear(end.radii[smooth])
    return max_norm(error) / problem.scale(OVER_LIMIT)


# Range of radii at which tractions are compared with a table, over the contact radius. The upper
# limit is that of cells.
INNERMOST = 0.1
OUTERMOST = 0.95
# Number of cells to each side of the stick edge, where the shear has a kink.
EDGE_CELLS = 2
# Relative rounding error of the radii of a table.
ROUNDING = 1e-9


def pressure_at(result: Any, r: Field) -> Field:
    """Interpolate the computed pressure at the end of the last load step to given radii
    [force/length²].

    The result has the shape (radii, directions): 16 directions on cells, one on finite elements.
    Pressures with edge correction are means over cells, which differ from the pressure at the
    centre by h²/24 ∇²p.

    r  distances from the axis [length]
    """
    end = result.steps[-1]
    if hasattr(result, "grid"):
        excess = laplace(end.pressure) / 24 if is_corrected(end) else 0.0
        return along_radii(end.pressure - excess, result.grid, r)
    return at_radii(end, end.pressure, r)[:, None]


def shear_at(result: Any, r: Field) -> Field:
    """Interpolate the computed radial shear at the end of the last load step to radii
    [force/length²].

    Positive shear points outwards. The result has the shape (radii, directions): 16 directions on
    cells, one on finite elements.

    r  distances from the axis [length]
    """
    end = result.steps[-1]
    if hasattr(result, "grid"):
        return along_radii(outward(shear_of(end), result.grid), result.grid, r)
    return at_radii(end, end.shear_radial, r)[:, None]


def judged_radii(result: Any, problem: Problem) -> Field:
    """Select the radii of a reference table at which computed tractions are judged [length].

    Radii within 0.1 of the contact radius from the axis and close to the contact edge are excluded.
    On cells the limit is 0.95 of the contact radius; on finite elements it depends on the mesh.
    """
    outermost = OUTERMOST
    if not hasattr(result, "grid"):
        outermost = judged_within(result.discretisation.elements_per_radius)
    r = problem.ends[-1].radii
    part = r / problem.radius
    return np.asarray(r[(part > INNERMOST - ROUNDING) & (part < outermost + ROUNDING)])


def tabulated_pressure_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest error of the final pressure at the radii of a reference table, over p_H
    [1].

    Radii next to the axis and to the contact edge are excluded. p_H is the Hertz peak pressure.
    """
    r = judged_radii(result, problem)
    error = pressure_at(result, r) - problem.ends[-1].pressure(r)[:, None]
    return max_norm(error) / problem.scale(OVER_PEAK)


def radial_shear_errors(result: Any, problem: Problem) -> tuple[Field, Mask]:
    """Compute the errors of the final radial shear at the radii of a reference table, over µp_H
    [1].

    p_H is the Hertz peak pressure. Returns the largest error of all directions at each radius, and
    a mask of the radii that lie within two cells of the edge of the stick zone, at least the
    nearest. On finite elements the mask is false everywhere.
    """
    r, exact = judged_radii(result, problem), problem.ends[-1]
    error = np.max(np.abs(shear_at(result, r) - exact.shear(r)[:, None]), axis=1)
    distance, at_edge = np.abs(r - exact.stick_part * problem.radius), np.zeros(r.shape, bool)
    if hasattr(result, "grid"):
        width = max(EDGE_CELLS * result.grid.spacing[0], float(np.min(distance)))
        at_edge = distance <= width
    return error / problem.scale(OVER_LIMIT), at_edge


def radial_shear_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest error of the final radial shear, without the edge of the stick zone
    [µp_H].

    The points are the radii of a reference table that are more than two cells from the edge of the
    stick zone. On finite elements all radii are taken.
    """
    error, at_edge = radial_shear_errors(result, problem)
    return float(np.max(error[~at_edge]))


def stick_edge_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest error of the final radial shear within two cells of the stick edge
    [µp_H].

    The points are radii of a reference table, at least the radius nearest to the edge.
    """
    error, at_edge = radial_shear_errors(result, problem)
    return float(np.max(error[at_edge]))
