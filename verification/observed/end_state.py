"""Numbers at the end of the last or of a given load step, read from the result of any solver.

Verification cases judge these numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    Result: TypeAlias = semi_analytical.Result | fem_reference.Result


def normal_force(result: Result) -> float:
    """Return the normal force of a result at the end of the last load step [force]."""
    return float(result.steps[-1].normal_force)


def approach(result: Result) -> float:
    """Return the approach of the bodies since first touch at the end of the last load step
    [length].
    """
    return float(result.steps[-1].approach)


def peak_pressure(result: Result) -> float:
    """Return the largest pressure of all cells or rings at the end of the last load step
    [force/length²].
    """
    return float(result.steps[-1].peak_pressure)


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


def contact_radius(result: Result) -> float:
    """Return the contact radius √(contact area / π) of a result at the end of the last load step
    [length].
    """
    return float(result.steps[-1].contact_radius)


def stick_radius(result: Result, step: int = -1) -> float:
    """Return the radius √(stick area / π) at the end of a load step [length]; NaN without friction.

    step  index of the load step; default: the last
    """
    radius = result.steps[step].stick_radius
    return float("nan") if radius is None else float(radius)


def is_corrected(increment: Any) -> bool:
    """Determine if the edge correction was applied to the tractions of an increment on cells.

    The result is False for increments of other solvers.
    """
    report = getattr(increment, "edge_report", None)
    return report is not None and report.cause is None
