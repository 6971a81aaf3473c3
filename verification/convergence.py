"""What refinement says: the uncertainty of a value, and the observed order of an error."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

CONFIDENCE = 0.95


@dataclass(frozen=True)
class ObservedOrder:
    """Slope of log(error) over log(h), with the half-width of its 95 % interval."""

    order: float
    half_width: float


def observed_order(spacings: Sequence[float], errors: Sequence[float]) -> ObservedOrder:
    """Least-squares order p of error = C h^p over at least three levels of refinement.

    spacings  cell sides h [length], all different
    errors    errors > 0 at these
    """
    if len(spacings) < 3:
        raise ValueError(f"{len(spacings)} levels cannot give an interval; use at least 3")
    x, y = np.log(np.asarray(spacings)), np.log(np.asarray(errors))
    spread = np.sum((x - x.mean()) ** 2)
    order = np.sum((x - x.mean()) * (y - y.mean())) / spread
    scatter = y - y.mean() - order * (x - x.mean())
    freedom = len(x) - 2
    deviation = np.sqrt(np.sum(scatter**2) / freedom / spread)
    return ObservedOrder(
        float(order), float(student.ppf((1 + CONFIDENCE) / 2, freedom) * deviation)
    )


def numerical_uncertainty(
    spacings: Sequence[float], values: Sequence[float], order: float
) -> float:
    """Standard uncertainty of the value on the finest grid, from f(h) = f0 + C h^p.

    spacings  cell sides h, at least three levels [length]
    values    f(h) there
    order     the expected p; fixed, because a fitted p lets three values explain anything
    returns   √((C h^p)² + s²) at the finest h, s the scatter there: same unit as values

    The scatter is taken to fall like the error, so levels are weighted by 1/h^p: otherwise the
    coarsest grid would decide about the finest.
    """
    if len(spacings) < 3:
        raise ValueError(f"{len(spacings)} levels cannot show a scatter; use at least 3")
    f = np.asarray(values, dtype=float)
    term = (np.asarray(spacings, dtype=float) / min(spacings)) ** order
    matrix = np.column_stack([1 / term, np.ones_like(term)])
    (limit, coefficient), *_ = np.linalg.lstsq(matrix, f / term, rcond=None)
    scatter = np.sqrt(np.sum(((f - limit) / term - coefficient) ** 2) / (len(f) - 2))
    return float(np.hypot(coefficient, scatter))
