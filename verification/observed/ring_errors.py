"""Tractions interpolated between rings and between cells, their error norms, and numbers of a step.

Verification cases judge these numbers at the end of the last or of a given load step.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from scipy.ndimage import map_coordinates

from contact_scene.array_types import Field
from semi_analytical.grid import SurfaceGrid

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    Result: TypeAlias = semi_analytical.Result | fem_reference.Result
    from fem_reference import Increment


def central_pressure(result: Any, step: int = -1) -> float:
    """Return the pressure on the contact axis at the end of a load step [force/length²].

    Below a stiff thin coating this pressure is not the largest. On finite elements the result is
    the value at the first ring. On cells the result is the mean of the cells nearest to the axis.
    With the edge correction the result is the value p₀ of the parabola p₀ - c r² through the means
    of these cells and the next ones.

    step  index of the load step
    """
    end = result.steps[step]
    pressure = end.pressure
    if not hasattr(result, "grid"):
        return float(pressure[0])
    r = np.hypot(*result.grid.coordinates())
    first = r < 1.01 * r.min()
    if not is_corrected(end):
        return float(np.mean(pressure[first]))
    second = ~first & (r < 1.01 * r[~first].min())
    near, far = float(np.mean(pressure[first])), float(np.mean(pressure[second]))
    squares = float(np.mean(r[first] ** 2)), float(np.mean(r[second] ** 2))
    return near + (near - far) * squares[0] / (squares[1] - squares[0])


def is_corrected(increment: Any) -> bool:
    """Determine if the edge correction was applied to the tractions of an increment on cells.

    The result is False for increments of other solvers.
    """
    report = getattr(increment, "edge_report", None)
    return report is not None and report.cause is None


SHOWN = 1.1  # largest radius of charts and integrals, in contact radii
IN_ELEMENT = 40  # integration points per element


def at_radii(increment: Increment, traction: Field, r: Field) -> Field:
    """Interpolate a traction of a finite element increment from the rings to radii r.

    The square of the traction is interpolated linearly in r², which is nearly exact for a square
    root at the contact edge. The sign is kept.

    increment  increment with the radii of the rings
    traction   values at the rings (rings,) [force/length²]
    r          radii, of any shape [length]
    """
    squared = np.interp(np.square(r), increment.radii**2, np.sign(traction) * traction**2)
    return np.asarray(np.sign(squared) * np.sqrt(np.abs(squared)))


def between_rings(increment: Increment, radius: float) -> Field:
    """Return integration points between the rings of finite elements, 40 per element [length].

    increment  increment with the radii of the rings
    radius     contact radius; the points extend to 1.1 times this radius [length]
    """
    judged = increment.radii[:-1] < SHOWN * radius
    starts, sides = increment.radii[:-1][judged], np.diff(increment.radii)[judged]
    parts = (np.arange(IN_ELEMENT) + 0.5) / IN_ELEMENT
    return np.asarray((starts[:, None] + sides[:, None] * parts).ravel())


def relative_l2(
    increment: Increment, traction: Field, exact: Callable[[Field], Field], radius: float
) -> float:
    """Compute the relative L2 error √∫(traction - exact)² r dr / √∫ exact² r dr of a traction [1].

    The computed traction is linear between the rings of the finite elements.

    increment  increment with the radii of the rings
    traction   values at the rings (rings,) [force/length²]
    exact      exact traction as a function of the radius
    radius     contact radius; the integrals extend to 1.1 times this radius [length]
    """
    r = between_rings(increment, radius)
    known, weight = exact(r), _weight(increment, r)
    error = np.interp(r, increment.radii, traction) - known
    return float(np.sqrt(np.sum(error**2 * weight) / np.sum(known**2 * weight)))


def relative_l1(
    increment: Increment, traction: Field, exact: Callable[[Field], Field], radius: float
) -> float:
    """Compute the L1 error ∫|traction - exact| r dr / ∫p r dr of a traction over the pressure p
    [1].

    For a shear error relative to µp the caller divides the result by the friction coefficient.

    increment  increment with the radii of the rings and the pressure
    traction   values at the rings (rings,) [force/length²]
    exact      exact traction as a function of the radius
    radius     contact radius; the integrals extend to 1.1 times this radius [length]
    """
    r = between_rings(increment, radius)
    error = np.interp(r, increment.radii, traction) - exact(r)
    pressure, weight = np.interp(r, increment.radii, increment.pressure), _weight(increment, r)
    return float(np.sum(np.abs(error) * weight) / np.sum(pressure * weight))


def _weight(increment: Increment, r: Field) -> Field:
    """Return the weight of integrals over dr: r, or 1 in a line contact.

    Fields of another program, which are judged too, are of bodies of revolution.
    """
    return np.ones_like(r) if getattr(increment, "is_line", False) else r


def judged_within(elements: int) -> float:
    """Return the fraction of the contact radius within which finite element tractions are judged.

    The fraction is 0.9, or less on coarse meshes, where the edge ripple of the last five elements
    extends further inward.

    elements  number of elements per contact radius
    """
    return min(0.9, 1 - 5 / elements)


DIRECTIONS = 16


def outward(shear: Field, grid: SurfaceGrid) -> Field:
    """Compute the radial component (nx, ny) of a shear field (2, nx, ny) on cells, positive
    outwards.
    """
    x, y = grid.coordinates()
    r = np.hypot(x, y)
    return np.asarray((shear[0] * x + shear[1] * y) / np.where(r > 0, r, 1.0))


def along_radii(field: Field, grid: SurfaceGrid, r: Field) -> Field:
    """Interpolate a field on cells to given distances from the contact axis, in 16 directions.

    The result has the shape (distances, directions). The square of the field is interpolated,
    because it is nearly linear at the contact edge.

    field  values (nx, ny), not negative, falling as a square root towards the edge of the contact
    r      distances from the axis [length]
    """
    angle = (np.arange(DIRECTIONS) + 0.5) * 2 * np.pi / DIRECTIONS
    x, y = r[:, None] * np.cos(angle), r[:, None] * np.sin(angle)
    at = [(x - grid.x[0]) / grid.spacing[0], (y - grid.y[0]) / grid.spacing[1]]
    return np.asarray(np.sqrt(map_coordinates(np.maximum(field, 0.0) ** 2, at, order=1)))
