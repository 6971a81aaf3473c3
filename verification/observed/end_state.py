"""Numbers at the end of a run or of a load step, as judged by the cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    Result: TypeAlias = semi_analytical.Result | fem_reference.Result


def normal_force(result: Result) -> float:
    """Return the normal force [force]."""
    return float(result.steps[-1].normal_force)


def approach(result: Result) -> float:
    """Return the approach since first touch [length]."""
    return float(result.steps[-1].approach)


def peak_pressure(result: Result) -> float:
    """Return the largest pressure of all cells or rings [force/length²]."""
    return float(result.steps[-1].peak_pressure)


def central_pressure(result: Any, step: int = -1) -> float:
    """Return the pressure on the axis [force/length²].

    Below a stiff thin coating this is not the largest pressure. On cells the result is the mean of
    the cells nearest to the axis. With the edge correction it is the value on the axis of p₀ - c r²
    through these cells and the next.
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
    """Return √(contact area / π) [length]."""
    return float(result.steps[-1].contact_radius)


def stick_radius(result: Result, step: int = -1) -> float:
    """Return √(stick area / π) [length]; NaN without friction.

    step  index of the load step
    """
    radius = result.steps[step].stick_radius
    return float("nan") if radius is None else float(radius)


def is_corrected(increment: Any) -> bool:
    """Return true if the increment has the edge correction."""
    report = getattr(increment, "edge_report", None)
    return report is not None and report.cause is None
