"""The straight line through errors on logarithmic axes, and where it could run instead."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from verification.convergence.observed_order import CONFIDENCE, ObservedOrder, observed_order

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class ErrorLine:
    """error = C h^p by least squares of the logarithms.

    observed   p with its interval
    log_size   mean of ln h: there the line is known best
    log_error  ln error of the line there
    reach      half-width of the 95 % interval of `log_error`
    """

    observed: ObservedOrder
    log_size: float
    log_error: float
    reach: float

    def at(self, sizes: Vector) -> Vector:
        """The line at sizes h."""
        return np.asarray(np.exp(self.log_error + self.observed.order * self._beside(sizes)))

    def band(self, sizes: Vector) -> tuple[Vector, Vector]:
        """Lower and upper end of the 95 % band of the line at sizes h."""
        by = np.exp(np.hypot(self.reach, self.observed.half_width * self._beside(sizes)))
        line = self.at(sizes)
        return line / by, line * by

    def _beside(self, sizes: Vector) -> Vector:
        return np.asarray(np.log(sizes) - self.log_size)


def error_line(sizes: Sequence[float], errors: Sequence[float]) -> ErrorLine:
    """The line through errors > 0 at sizes h, at least three."""
    observed = observed_order(sizes, errors)
    x, y = np.log(np.asarray(sizes)), np.log(np.asarray(errors))
    left = y - y.mean() - observed.order * (x - x.mean())
    freedom = len(x) - 2
    deviation = np.sqrt(np.sum(left**2) / freedom / len(x))
    reach = float(stdtrit(freedom, (1 + CONFIDENCE) / 2) * deviation)
    return ErrorLine(observed, float(x.mean()), float(y.mean()), reach)


def by_size(sizes: Sequence[float], errors: Sequence[float]) -> tuple[list[float], list[float]]:
    """Each size once, in the order of first mention, with the root mean square of its errors.

    Errors of one size differ by where grid or mesh fall on the contact; one of them alone may
    happen to vanish.
    """
    of: dict[float, list[float]] = {}
    for size, error in zip(sizes, errors, strict=True):
        of.setdefault(float(f"{size:.9g}"), []).append(error)
    return list(of), [float(np.sqrt(np.mean(np.square(found)))) for found in of.values()]
