"""Results of a refinement: uncertainty of a value, observed order and limit.

A size h is a cell side, or the part of a load step in one increment. With a reference, errors at
several h determine the order (`observed_order`). Without one, order and limit follow from the
values (`refined_value`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar
from scipy.special import stdtrit

CONFIDENCE = 0.95
# An order is known well enough to be judged if its interval is no wider than this.
ORDER_WIDTH = 0.25
# By so much a promised order may be missed: a fit over an octave or two still feels the next term.
ORDER_OFF = 0.1
# Orders of the two finest triplets differ by no more than this where the values are asymptotic.
TRIPLETS_AGREE = 0.2
# Half-width of an interval that holds two neighbouring whole orders: within it none can be read.
ILLEGIBLE = 0.5
ORDERS = (0.05, 6.0)
COARSE_STEPS = 60
ROUNDING = 1e-20

Vector = NDArray[np.float64]
Triplets = tuple[float | None, float | None]


@dataclass(frozen=True)
class ObservedOrder:
    """Slope of log(error) over log(h).

    half_width  of its 95 % interval
    margin      at 95 % it is no lower than `order - margin`; and, said alone, no higher than
                `order + margin`
    """

    order: float
    half_width: float
    margin: float

    @property
    def is_legible(self) -> bool:
        """Return True if the interval is narrow enough for a meaningful order."""
        return self.half_width < ILLEGIBLE

    def may_be_off_by(self, promised: float, allowance: float = 0.0) -> float:
        """Return the allowed difference from the promised order, on the side of this order.

        allowance  for levels that are not asymptotic
        """
        off = max(allowance, ORDER_OFF)
        return off if self.order < promised else off + self.margin

    def keeps(self, promised: float, allowance: float = 0.0) -> bool | None:
        """Return True if the errors have the promised order; see `order_is_kept`."""
        allowed = self.may_be_off_by(promised, allowance)
        return order_is_kept(self.order - promised, allowed, self.half_width, self.margin)


@dataclass(frozen=True)
class RefinedValue:
    """Order, limit and uncertainty of a value without a reference, from several levels.

    observed     order p of f(h) = f0 + C h^p by least squares; None where no p explains the values
    triplets     p through two different triplets of levels, the finer first; levels of a triplet
                 are about a factor of two apart where there are enough
    limit        f0 with the expected order
    uncertainty  of the limit, standard: scatter of the fit, and the other limits that the two
                 finest levels alone and the observed order give
    """

    observed: ObservedOrder | None
    triplets: Triplets
    limit: float
    uncertainty: float


def order_is_kept(above: float, allowed: float, half_width: float, margin: float) -> bool | None:
    """Return True if an order is the promised one; None if its interval is too wide.

    above    observed minus promised order
    allowed  largest difference on that side (`ObservedOrder.may_be_off_by`)

    An order below the promised one passes if its lower 95 % bound is within the allowance, and
    fails if its upper bound is not. An order above fails if its lower bound exceeds the allowance.
    """
    if half_width > ORDER_WIDTH:
        return None
    off = allowed if above < 0 else allowed - margin
    if above < -off - margin or above > allowed:
        return False
    return True if above >= margin - off else None


def triplets_agree(orders: Triplets) -> bool:
    """Return True if the orders of two triplets of levels exist and agree."""
    last, before = orders
    return last is not None and before is not None and abs(last - before) <= TRIPLETS_AGREE


def observed_order(sizes: Sequence[float], errors: Sequence[float]) -> ObservedOrder:
    """Least-squares order p of error = C h^p over at least three levels of refinement.

    sizes   h, all different
    errors  errors > 0 at these
    """
    if len(sizes) < 3:
        raise ValueError(f"{len(sizes)} levels cannot give an interval; use at least 3")
    x, y = np.log(np.asarray(sizes)), np.log(np.asarray(errors))
    spread = np.sum((x - x.mean()) ** 2)
    order = np.sum((x - x.mean()) * (y - y.mean())) / spread
    scatter = y - y.mean() - order * (x - x.mean())
    freedom = len(x) - 2
    deviation = np.sqrt(np.sum(scatter**2) / freedom / spread)
    return _known_to(float(order), float(deviation), freedom)


def refined_value(sizes: Sequence[float], values: Sequence[float], expected: float) -> RefinedValue:
    """Order and limit of a value from at least four levels, in any order.

    sizes     h, all different
    values    f(h)
    expected  the order that theory expects; the limit rests on it
    """
    if len(sizes) < 4:
        raise ValueError(f"{len(sizes)} levels cannot give order and limit; use at least 4")
    finest_first = np.argsort(sizes)
    h = np.asarray(sizes, dtype=float)[finest_first]
    f = np.asarray(values, dtype=float)[finest_first]
    h /= h[0]
    observed = _fitted_order(h, f, expected)
    limit, uncertainty = richardson(h, f, expected)
    if observed is not None:
        other = _line(h, f, observed.order, expected).limit
        uncertainty = float(np.hypot(uncertainty, limit - other))
    stride = _stride(h, reach=2)
    finest, before = (slice(k, k + 2 * stride + 1, stride) for k in (0, 1))
    triplets = _triplet_order(h[finest], f[finest]), _triplet_order(h[before], f[before])
    return RefinedValue(observed, triplets, limit, uncertainty)


def _stride(h: Vector, reach: int) -> int:
    """Levels from one member of a triplet to the next, so that two triplets fit in.

    reach  steps of that many levels that a triplet needs
    """
    wanted = max(1, round(float(np.log(2) / np.log(h[1] / h[0]))))
    return min(wanted, (len(h) - 2) // reach)


def numerical_uncertainty(sizes: Sequence[float], values: Sequence[float], order: float) -> float:
    """Compute the standard uncertainty of the value on the finest level, from f(h) = f0 + C h^p.

    sizes    h, at least three levels
    values   f(h) there
    order    the expected p; fixed, because a fitted p lets three values explain anything
    returns  √((C h^p)² + max(s, d)²) at the finest h, with s the scatter and d the largest change
             of f0 if only the finer or the coarser half of the levels is used; unit of the values

    Both s and d measure deviations from one power, so the larger counts and not their sum. If the
    coarser levels do not have the order yet, C may nearly vanish; then d is large, because the two
    ranges contradict each other (Eça and Hoekstra 2014 take differences
    between fits for the same purpose).
    """
    if len(sizes) < 3:
        raise ValueError(f"{len(sizes)} levels cannot show a scatter; use at least 3")
    finest_first = np.argsort(sizes)
    h = np.asarray(sizes, dtype=float)[finest_first]
    f = np.asarray(values, dtype=float)[finest_first]
    h /= h[0]
    fit = _line(h, f, order, order)
    half = max(3, (len(h) + 1) // 2)
    ranges = slice(half), slice(len(h) - half, None)
    moved = max(abs(_line(h[part], f[part], order, order).limit - fit.limit) for part in ranges)
    scatter = float(np.sqrt(fit.squares / (len(h) - 2)))
    return float(np.hypot(fit.coefficient, max(moved, scatter)))


@dataclass(frozen=True)
class _Line:
    """f = limit + coefficient h^p, and the weighted squares that are left."""

    limit: float
    coefficient: float
    squares: float


def _line(h: Vector, f: Vector, order: float, weight_order: float) -> _Line:
    """Fit a line by least squares with weights 1/h^p.

    The scatter is assumed to fall like the error. Without weights the coarsest level would
    determine the value on the finest."""
    weight = h**-weight_order
    matrix = np.column_stack([weight, weight * h**order])
    (limit, coefficient), *_ = np.linalg.lstsq(matrix, weight * f, rcond=None)
    left = weight * (f - limit - coefficient * h**order)
    return _Line(float(limit), float(coefficient), float(np.sum(left**2)))


def richardson(h: Vector, f: Vector, order: float) -> tuple[float, float]:
    """Extrapolate to h = 0 (Richardson); return the value and its standard uncertainty.

    The uncertainty combines that of the fit and the difference from the value of the two finest
    levels.

    h, f  at least three levels, finest first
    """
    fit = _line(h, f, order, order)
    weight = h**-order
    normal = np.array([[np.sum(weight**2), np.sum(weight)], [np.sum(weight), float(len(h))]])
    scatter = fit.squares / (len(h) - 2) * np.linalg.inv(normal)[0, 0]
    two_finest = f[0] - (f[1] - f[0]) / ((h[1] / h[0]) ** order - 1)
    return fit.limit, float(np.hypot(np.sqrt(scatter), fit.limit - two_finest))


def _fitted_order(h: Vector, f: Vector, expected: float) -> ObservedOrder | None:
    """The p that leaves least, weights held at those of the expected order; its interval from
    the tangent of the model. None where the best p lies at the end of what is sensible."""
    spread = float(np.ptp(f))
    if spread == 0:
        return None
    f = f / spread

    def left(order: float) -> float:
        return _line(h, f, order, expected).squares

    trial = np.linspace(*ORDERS, COARSE_STEPS)
    best = int(np.argmin([left(order) for order in trial]))
    if best in (0, len(trial) - 1):
        return None
    found = minimize_scalar(left, bounds=(trial[best - 1], trial[best + 1]), method="bounded")
    order, fit = float(found.x), _line(h, f, float(found.x), expected)
    weight = h**-expected
    powers = weight * h**order
    # What limit and coefficient cannot imitate of a change of p tells how well p is known.
    plane, _ = np.linalg.qr(np.column_stack([weight, powers]))
    along = fit.coefficient * powers * np.log(h)
    across = along - plane @ (plane.T @ along)
    lever = float(np.sum(across**2))
    if lever <= ROUNDING * float(np.sum(along**2)):
        return None
    freedom = len(h) - 3
    return _known_to(order, float(np.sqrt(fit.squares / freedom / lever)), freedom)


def _triplet_order(h: Vector, f: Vector) -> float | None:
    """Return the order p of three values, finest first; None if their differences change sign."""
    fine, coarse = f[1] - f[0], f[2] - f[1]
    if fine == 0 or coarse / fine <= 0:
        return None

    def mismatch(order: float) -> float:
        powers = h**order
        return float((powers[2] - powers[1]) / (powers[1] - powers[0]) - coarse / fine)

    low, high = ORDERS
    if mismatch(low) * mismatch(high) > 0:
        return None
    return float(brentq(mismatch, low, high))


def _known_to(order: float, deviation: float, freedom: int) -> ObservedOrder:
    two_sided, one_sided = stdtrit(freedom, [(1 + CONFIDENCE) / 2, CONFIDENCE]) * deviation
    return ObservedOrder(order, float(two_sided), float(one_sided))


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
        """Return the line at sizes h."""
        return np.asarray(np.exp(self.log_error + self.observed.order * self._beside(sizes)))

    def band(self, sizes: Vector) -> tuple[Vector, Vector]:
        """Return lower and upper end of the 95 % band of the line at sizes h."""
        by = np.exp(np.hypot(self.reach, self.observed.half_width * self._beside(sizes)))
        line = self.at(sizes)
        return line / by, line * by

    def _beside(self, sizes: Vector) -> Vector:
        return np.asarray(np.log(sizes) - self.log_size)


def error_line(sizes: Sequence[float], errors: Sequence[float]) -> ErrorLine:
    """Return the line through errors > 0 at sizes h, at least three."""
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
