"""Convergence orders, limits and uncertainties of values computed on several refinement levels.

A size h is a cell side, or the fraction of a load step in one increment. With a reference solution,
the errors at several h determine the order (`observed_order`). Without a reference, order and limit
follow from the values (`refined_value`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import stdtrit

from contact_scene.array_types import Vector

CONFIDENCE = 0.95
# An order is known well enough to be judged if its interval is no wider than this.
ORDER_WIDTH = 0.25
# Allowed difference from a theoretical order: a fit over few levels includes the next error term.
ORDER_OFF = 0.1
# Half-width of an interval that contains two consecutive integer orders: none can be determined.
ILLEGIBLE = 0.5
# Half-widths below have three decimals, of which the last is at least 1: less depends on round-off.
LEAST_SHOWN = 0.005
LEAST_TOLD = 0.001
ORDERS = (0.05, 6.0)
COARSE_STEPS = 60
ROUNDING = 1e-20


@dataclass(frozen=True)
class ObservedOrder:
    """Hold an observed convergence order: slope of log(error) over log(h), with its uncertainty.

    order       observed order p of error = C h^p (h: discretisation size)
    half_width  half-width of the two-sided 95 % interval of the order
    margin      half-width for one-sided bounds: with 95 % confidence the order is at least `order -
                margin`, or, as a separate statement, at most `order + margin`
    """

    order: float
    half_width: float
    margin: float

    @property
    def interval(self) -> tuple[float, float]:
        """Order and half-width of its 95 % interval."""
        return self.order, self.half_width

    def reaches(self, promised: float) -> bool | None:
        """Determine if the order is at least a claimed one, up to the allowed difference.

        The result is None if the order is too uncertain for a verdict.
        """
        below = promised - self.order
        return is_within(below - self.margin, below + self.margin, ORDER_OFF)

    def may_be_off_by(self, promised: float, allowance: float = 0.0) -> float:
        """Return the largest accepted difference between the observed and the theoretical
        convergence order.

        For an observed order above the theoretical one, the margin of the observed order is added.

        promised   theoretical convergence order
        allowance  additional tolerance for levels that are not asymptotic
        """
        off = max(allowance, ORDER_OFF)
        return off if self.order < promised else off + self.margin

    def keeps(self, promised: float, allowance: float = 0.0) -> bool | None:
        """Determine if the observed convergence order agrees with the theoretical order.

        The result is None if the observed order is too uncertain for a verdict.

        promised   theoretical convergence order
        allowance  additional tolerance for levels that are not asymptotic
        """
        allowed = self.may_be_off_by(promised, allowance)
        return order_is_kept(self.order - promised, allowed, self.half_width, self.margin)


def order_text(order: float, half_width: float) -> str:
    """Format an observed order of convergence with its interval, such as "1.98 ± 0.05".

    The text is "not known" if the half-width is 0.5 or more.

    half_width  half-width of the 95 % interval of the order
    """
    if half_width >= ILLEGIBLE:
        return "not known"
    digits = 2 if half_width >= LEAST_SHOWN else 3
    # Zero has no sign.
    return f"{round(order, digits) + 0.0:.{digits}f} ± {max(half_width, LEAST_TOLD):.{digits}f}"


@dataclass(frozen=True)
class RefinedValue:
    """Hold the convergence order, the limit for h → 0 and the uncertainty of a refined value.

    The value f is known at several discretisation sizes h.

    observed     order p of f(h) = f0 + C h^p by least squares; None if no p explains the values
    limit        f0, extrapolated with the theoretical order
    uncertainty  standard uncertainty of the limit: scatter of the fit, and the differences from the
                 limits by the two finest levels and by the observed order
    """

    observed: ObservedOrder | None
    limit: float
    uncertainty: float


def order_is_kept(above: float, allowed: float, half_width: float, margin: float) -> bool | None:
    """Determine if an observed convergence order agrees with the theoretical one.

    An order below the theoretical one passes if its lower 95 % bound is within the allowance, and
    fails if its upper bound is not. An order above fails if its lower bound exceeds the allowance.
    The result is None if the interval is too wide for a verdict.

    above       observed minus theoretical order
    allowed     largest difference on that side (`ObservedOrder.may_be_off_by`)
    half_width  half-width of the two-sided 95 % interval of the order
    margin      half-width for one-sided 95 % bounds
    """
    if half_width > ORDER_WIDTH:
        return None
    if above > allowed:
        return False
    return is_within(-above - margin, -above + margin, allowed if above < 0 else allowed - margin)


def is_within(least: float, most: float, allowed: float) -> bool | None:
    """Determine if a number that lies between two bounds is at most the allowed value.

    The result is None if the bounds do not decide. It is False if a bound is NaN.

    least, most  bounds of the number at 95 %, such as an error without and with its uncertainty
    allowed      largest accepted value
    """
    if most <= allowed:
        return True
    return None if least <= allowed else False


def observed_order(sizes: Sequence[float], errors: Sequence[float]) -> ObservedOrder:
    """Fit the convergence order p of error = C h^p to the errors on at least three refinement
    levels.

    sizes   discretisation sizes h of the levels, all different
    errors  errors > 0 on these levels
    """
    return error_line(sizes, errors).observed


def refined_value(sizes: Sequence[float], values: Sequence[float], expected: float) -> RefinedValue:
    """Estimate convergence order and limit for h → 0 of a value on at least four refinement levels.

    Used where no exact value is known.

    sizes     discretisation sizes h of the levels, all different, in any order
    values    values f(h)
    expected  theoretical order, with which the limit is extrapolated
    """
    if len(sizes) < 4:
        raise ValueError(f"{len(sizes)} levels cannot give order and limit; use at least 4")
    h, f = _finest_first(sizes, values)
    observed = _fit_order(h, f, expected)
    limit, uncertainty = richardson(h, f, expected)
    if observed is not None:
        other = _line(h, f, observed.order, expected).limit
        uncertainty = float(np.hypot(uncertainty, limit - other))
    return RefinedValue(observed, limit, uncertainty)


def numerical_uncertainty(sizes: Sequence[float], values: Sequence[float], order: float) -> float:
    """Compute the standard uncertainty of a value on the finest of several refinement levels.

    The values are assumed to follow f(h) = f0 + C h^p (h: discretisation size).

    sizes    sizes h of at least three levels
    values   f(h) on these levels
    order    theoretical order p; fixed, because a fitted p lets three values explain anything
    returns  √((C h^p)² + max(s, d)²) at the finest h, with s the scatter and d the largest change
             of f0 if only the finer or the coarser half of the levels is used; unit of the values

    Both s and d measure deviations from one power, so the larger counts and not their sum. If the
    coarser levels do not have the order yet, C may nearly vanish. Then d is large, because the two
    ranges contradict each other (Eça and Hoekstra 2014 use differences between fits for the same
    purpose).
    """
    if len(sizes) < 3:
        raise ValueError(f"{len(sizes)} levels cannot show a scatter; use at least 3")
    h, f = _finest_first(sizes, values)
    fit = _line(h, f, order, order)
    half = max(3, (len(h) + 1) // 2)
    ranges = slice(half), slice(len(h) - half, None)
    moved = max(abs(_line(h[part], f[part], order, order).limit - fit.limit) for part in ranges)
    scatter = float(np.sqrt(fit.squares / (len(h) - 2)))
    return float(np.hypot(fit.coefficient, max(moved, scatter)))


def _finest_first(sizes: Sequence[float], values: Sequence[float]) -> tuple[Vector, Vector]:
    """Return sizes over the finest one, and values, from the finest level to the coarsest."""
    order = np.argsort(sizes)
    h = np.asarray(sizes, dtype=float)[order]
    return h / h[0], np.asarray(values, dtype=float)[order]


@dataclass(frozen=True)
class _FittedLine:
    """Hold the least-squares fit of f(h) = limit + coefficient h^p to values on several levels.

    limit        value for h → 0
    coefficient  factor of h^p
    squares      weighted sum of the squared residuals of the fit
    """

    limit: float
    coefficient: float
    squares: float


def _line(h: Vector, f: Vector, order: float, weight_order: float) -> _FittedLine:
    """Fit f(h) = limit + coefficient h^p by least squares with weights h^-w.

    The scatter of the values is assumed to fall with h like the error. Without weights the coarsest
    level would determine the value on the finest.

    h, f          discretisation sizes and values of the levels
    order         exponent p
    weight_order  exponent w of the weights
    """
    weight = h**-weight_order
    matrix = np.column_stack([weight, weight * h**order])
    (limit, coefficient), *_ = np.linalg.lstsq(matrix, weight * f, rcond=None)
    left = weight * (f - limit - coefficient * h**order)
    return _FittedLine(float(limit), float(coefficient), float(np.sum(left**2)))


def richardson(h: Vector, f: Vector, order: float) -> tuple[float, float]:
    """Extrapolate values f(h) to h = 0 (Richardson); return the limit and its standard uncertainty.

    The uncertainty combines the scatter of the fit and the difference from the limit by the two
    finest levels alone.

    h, f   discretisation sizes and values of at least three levels, finest first
    order  convergence order of the values
    """
    fit = _line(h, f, order, order)
    weight = h**-order
    normal = np.array([[np.sum(weight**2), np.sum(weight)], [np.sum(weight), float(len(h))]])
    scatter = fit.squares / (len(h) - 2) * np.linalg.inv(normal)[0, 0]
    two_finest = f[0] - (f[1] - f[0]) / ((h[1] / h[0]) ** order - 1)
    return fit.limit, float(np.hypot(np.sqrt(scatter), fit.limit - two_finest))


def _fit_order(h: Vector, f: Vector, expected: float) -> ObservedOrder | None:
    """Fit the order p of f(h) = f0 + C h^p by least squares; return p with its 95 % interval.

    The interval follows from the linearised model. The result is None if all values are equal, or
    if the best p lies at an end of the range 0.05 to 6.

    h, f      discretisation sizes and values of the levels, finest first
    expected  theoretical order, which determines the weights
    """
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
    # The part of a change of p that limit and coefficient cannot fit determines the interval of p.
    plane, _ = np.linalg.qr(np.column_stack([weight, powers]))
    along = fit.coefficient * powers * np.log(h)
    across = along - plane @ (plane.T @ along)
    lever = float(np.sum(across**2))
    if lever <= ROUNDING * float(np.sum(along**2)):
        return None
    freedom = len(h) - 3
    return _known_to(order, float(np.sqrt(fit.squares / freedom / lever)), freedom)


def _known_to(order: float, deviation: float, freedom: int) -> ObservedOrder:
    two_sided, one_sided = stdtrit(freedom, [(1 + CONFIDENCE) / 2, CONFIDENCE]) * deviation
    return ObservedOrder(order, float(two_sided), float(one_sided))


@dataclass(frozen=True)
class ErrorLine:
    """Hold the line error = C h^p, fitted to errors on several levels by least squares of
    logarithms.

    observed   order p with its interval
    log_size   mean of ln h, where the uncertainty of the line is smallest
    log_error  ln error of the line at `log_size`
    reach      half-width of the 95 % interval of `log_error`
    """

    observed: ObservedOrder
    log_size: float
    log_error: float
    reach: float

    def at(self, sizes: Vector) -> Vector:
        """Return the errors C h^p of the fitted line at discretisation sizes h."""
        return np.asarray(np.exp(self.log_error + self.observed.order * self._beside(sizes)))

    def band(self, sizes: Vector) -> tuple[Vector, Vector]:
        """Return the lower and upper limits of the 95 % confidence band of the fitted line at sizes
        h.
        """
        by = np.exp(np.hypot(self.reach, self.observed.half_width * self._beside(sizes)))
        line = self.at(sizes)
        return line / by, line * by

    def _beside(self, sizes: Vector) -> Vector:
        return np.asarray(np.log(sizes) - self.log_size)


def error_line(sizes: Sequence[float], errors: Sequence[float]) -> ErrorLine:
    """Fit the line error = C h^p (straight in logarithms) to errors on at least three refinement
    levels.

    sizes   discretisation sizes h of the levels
    errors  errors > 0 on these levels
    """
    if len(sizes) < 3:
        raise ValueError(f"{len(sizes)} levels cannot give an interval; use at least 3")
    x, y = np.log(np.asarray(sizes)), np.log(np.asarray(errors))
    spread, freedom = np.sum((x - x.mean()) ** 2), len(x) - 2
    order = np.sum((x - x.mean()) * (y - y.mean())) / spread
    left = y - y.mean() - order * (x - x.mean())
    scatter = np.sqrt(np.sum(left**2) / freedom)
    observed = _known_to(float(order), float(scatter / np.sqrt(spread)), freedom)
    reach = float(stdtrit(freedom, (1 + CONFIDENCE) / 2) * scatter / np.sqrt(len(x)))
    return ErrorLine(observed, float(x.mean()), float(y.mean()), reach)


def by_size(sizes: Sequence[float], errors: Sequence[float]) -> tuple[list[float], list[float]]:
    """Combine the errors of runs of equal discretisation size by their root mean square.

    Errors of one size differ by the position of the grid or mesh relative to the contact, and a
    single one may vanish by chance. Returns the sizes in the order of their first occurrence, and
    their combined errors.
    """
    of: dict[float, list[float]] = {}
    for size, error in zip(sizes, errors, strict=True):
        of.setdefault(float(f"{size:.9g}"), []).append(error)
    return list(of), [float(np.sqrt(np.mean(np.square(found)))) for found in of.values()]
