"""Errors of pressure and shear of a ball that is pressed onto a body with friction.

The reference is a table of tractions at a few radii. The results are those of the solver on cells
or of the finite elements.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from verification.judging.declared_case import error_norm
from verification.observed.ring_errors import along_radii, at_radii, judged_within, outward
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.problem import OVER_PEAK, Problem
from verification.quantities import shear_of

Field = NDArray[np.float64]

# Range of radii at which tractions are judged, over the contact radius. The upper limit is that of
# cells.
INNERMOST, OUTERMOST = 0.1, 0.95
# Number of cells to each side of the stick edge, where the shear has a kink.
EDGE_CELLS = 2
# Relative rounding error of the radii of a table.
ROUNDING = 1e-9


def pressure_at(result: Any, r: Field) -> Field:
    """Interpolate the computed pressure of the last load step to given radii [force/length²].

    The result has the shape (radii, directions): 16 directions on cells, one on finite elements.

    r  distances from the axis [length]
    """
    end = result.steps[-1]
    if hasattr(result, "grid"):
        return along_radii(end.pressure, result.grid, r)
    return at_radii(end, end.pressure, r)[:, None]


def shear_at(result: Any, r: Field) -> Field:
    """Interpolate the computed radial shear of the last load step to given radii [force/length²].

    Positive shear points outwards. The result has the shape (radii, directions): 16 directions on
    cells, one on finite elements.

    r  distances from the axis [length]
    """
    end = result.steps[-1]
    if hasattr(result, "grid"):
        return along_radii(outward(shear_of(end), result.grid), result.grid, r)
    return at_radii(end, end.shear_radial, r)[:, None]


def judged_radii(result: Any, problem: Problem) -> Field:
    """Select the radii of the reference table at which tractions are judged [length].

    Radii within 0.1 of the contact radius from the axis and close to the contact edge are excluded.
    On cells the limit is 0.95 of the contact radius; on finite elements it depends on the mesh.
    """
    outermost = OUTERMOST
    if not hasattr(result, "grid"):
        outermost = judged_within(result.discretisation.elements_per_radius)
    r = problem.ends[-1].radii
    part = r / problem.radius
    return np.asarray(r[(part > INNERMOST - ROUNDING) & (part < outermost + ROUNDING)])


def pressure_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest error of the pressure at the judged radii, over p_H of Hertz theory
    [1]."""
    r = judged_radii(result, problem)
    error = np.abs(pressure_at(result, r) - problem.ends[-1].pressure(r)[:, None])
    return float(np.max(error) / problem.scale(OVER_PEAK))


def shear_errors(result: Any, problem: Problem) -> tuple[Field, NDArray[np.bool_]]:
    """Compute the errors of the radial shear at the judged radii, over µp_H [1].

    Returns the largest error of all directions at each radius, and a mask of the radii that lie
    less than two cells from the edge of the stick zone. On finite elements the mask is false
    everywhere.
    """
    r, exact = judged_radii(result, problem), problem.ends[-1]
    error = np.max(np.abs(shear_at(result, r) - exact.shear(r)[:, None]), axis=1)
    width = EDGE_CELLS * result.grid.spacing[0] if hasattr(result, "grid") else 0.0
    at_edge = np.abs(r - exact.stick_part * problem.radius) < width
    return error / problem.scale(OVER_LIMIT), at_edge


def shear_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest error of the radial shear away from the stick edge, over µp_H [1]."""
    error, at_edge = shear_errors(result, problem)
    return float(np.max(error[~at_edge]))


def edge_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest error of the radial shear within two cells of the stick edge, over µp_H
    [1].

    The error is zero if the reference table has no radius there.
    """
    error, at_edge = shear_errors(result, problem)
    return float(np.max(error, where=at_edge, initial=0.0))


PRESSURE = error_norm(
    "pressure", "largest error of the pressure from {between} of the radius, over p_H",
    pressure_error, "p_H, the peak pressure without friction",
)  # fmt: skip
SHEAR = error_norm(
    "shear", "largest error of the shear from {between} of the radius, {but}over µp_H", shear_error,
    OVER_LIMIT,
)  # fmt: skip
SHEAR_AT_EDGE = error_norm(
    "shear_at_stick_edge", "the same within two cells of the stick edge", edge_error, OVER_LIMIT
)
