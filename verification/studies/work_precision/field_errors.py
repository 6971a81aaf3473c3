"""Norms of fields in which every method is asked for what its values mean: cells for means over
cells, with or without edges inside them, rings of the radial solver for the values there, finite
elements for what is linear between theirs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import radial
from contact_results.surface import Surface, surface_of
from semi_analytical import SurfaceGrid
from verification import norms
from verification.cell_means import round_means
from verification.judging import field_errors
from verification.judging.observable import error_norm
from verification.problems.paper_scene import FRICTION
from verification.problems.problem import Problem
from verification.quantities import shear_of

Field = NDArray[np.float64]


def pressure_l2(result: Any, step: int, problem: Problem) -> float:
    """Relative L2 error of the pressure [1]."""
    end, exact = result.steps[step], problem.ends[step].pressure
    if hasattr(result, "grid"):
        known = _means(exact, result.grid)
        return norms.relative_l2(end.pressure, known)
    if not isinstance(result, radial.Result):
        return field_errors.pressure_l2(result, step, problem)
    surface = surface_of(result)
    p, part = surface.scalar(end, "pressure"), np.sqrt(surface.weights)
    assert p is not None
    return norms.relative_l2(part * p, part * exact(_radii(surface)))


def shear_l1(result: Any, step: int, problem: Problem) -> float:
    """Σ|q - q_exact| / Σµp [1]."""
    end, exact = result.steps[step], problem.ends[step].shear
    if hasattr(result, "grid"):
        known = _means(exact, result.grid)
        return norms.shear_error(shear_of(end), known, FRICTION * end.pressure)
    if not isinstance(result, radial.Result):
        return field_errors.shear_error(result, step, problem)
    surface = surface_of(result)
    q, p, areas = surface.vector(end, "shear"), surface.scalar(end, "pressure"), surface.weights
    assert q is not None
    assert p is not None
    return norms.shear_error(areas * q, areas * exact(_radii(surface)), areas * FRICTION * p)


def _means(exact: Callable[[Field], Field], grid: SurfaceGrid) -> Field:
    x, y = grid.coordinates()
    return round_means(exact, x, y, grid.spacing)


def _radii(surface: Surface) -> Field:
    return np.hypot(*surface.positions)


PRESSURE = error_norm("pressure", "pressure over the {domain}, L2", pressure_l2, norm="L2")
SHEAR = error_norm("shear", "{sum}|q - q_exact| / {sum}µp{when}", shear_l1, "Σµp")
