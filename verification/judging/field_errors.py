"""Errors of a field at the end of a step against the exact one, by either solver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from verification import norms
from verification.norms import cell_means
from verification.observed import ring_errors
from verification.observed.end_state import is_corrected
from verification.observed.ring_errors import judged_within
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.paper_scene import FRICTION
from verification.problems.problem import OVER_PEAK, Problem
from verification.quantities import shear_of

Field = NDArray[np.float64]
AT_EDGE = 0.1  # contact radii to each side of a stick edge


def _exact(result: Any, end: Any, exact: Callable[..., Field], problem: Problem) -> Field:
    """Return the exact field at the centres of cells, or its cell means if edges are corrected."""
    x, y = result.grid.coordinates()
    if not is_corrected(end):
        return problem.on_surface(exact, x, y)
    sides = np.full_like(x, result.grid.spacing[0]), np.full_like(x, result.grid.spacing[1])
    return cell_means(lambda x, y: problem.on_surface(exact, x, y), x, y, sides)


def pressure_l1(result: Any, step: int, problem: Problem) -> float:
    """Return Σ|p - p_exact| / Σ p_exact over all cells [1]."""
    end = result.steps[step]
    return norms.relative_l1(
        end.pressure, _exact(result, end, problem.ends[step].pressure, problem)
    )


def pressure_l2(result: Any, step: int, problem: Problem) -> float:
    """Relative L2 error of the pressure over all cells, or over the rings, linear between [1]."""
    end, exact = result.steps[step], problem.ends[step].pressure
    if hasattr(result, "grid"):
        return norms.relative_l2(end.pressure, _exact(result, end, exact, problem))
    return ring_errors.relative_l2(end, end.pressure, exact, problem.radius)


def largest_pressure_error(result: Any, step: int, problem: Problem) -> float:
    """Return the largest error of the pressure of rings away from the edge, over p_H [1]."""
    end, exact = result.steps[step], problem.ends[step]
    within = judged_within(result.discretisation.elements_per_radius) * problem.radius
    error = ring_errors.largest_error(end, end.pressure, exact, exact.pressure, 0.0, within)
    return error / problem.scale(OVER_PEAK)


def shear_error(result: Any, step: int, problem: Problem) -> float:
    """Return Σ|q - q_exact| / Σµp over all cells [1].

    On rings it is the ratio of the integrals, with the shear along the load."""
    end, exact = result.steps[step], problem.ends[step].shear
    if hasattr(result, "grid"):
        known = _exact(result, end, exact, problem)
        return norms.shear_error(shear_of(end), known, FRICTION * end.pressure)
    along = end.shear_along_load
    return ring_errors.relative_l1(end, along, exact, problem.radius) / FRICTION


def away_from_edges(r: Field, judged: float, edges: Sequence[float], radius: float) -> NDArray[Any]:
    """Mark radii within a part of the contact radius and away from the stick edges.

    The shear has a cusp at a stick edge."""
    smooth = r <= judged * radius
    for edge in edges:
        smooth &= np.abs(r - edge) > AT_EDGE * radius
    return smooth


def shear_around_error(result: Any, step: int, problem: Problem) -> float:
    """Return the largest error of the circumferential shear away from the edges, over µp_H [1]."""
    end, exact = result.steps[step], problem.ends[step]
    within = judged_within(result.discretisation.elements_per_radius)
    smooth = away_from_edges(end.radii, within, [exact.stick_radius], problem.radius)
    error = np.abs(end.shear_circumferential[smooth] - exact.shear(end.radii[smooth]))
    return float(np.max(error) / problem.scale(OVER_LIMIT))
