"""Limits of the results of a scene under refinement, and the errors of the setting of a run.

The limit of a result is its value in a run, changed by the effect of every refined parameter. The
effect of one parameter is extrapolated from the levels of that parameter.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite, sqrt

from contact_errors.error_formula import BELIEVED, ORDERS, SPREADS
from slipstick.convergence.levels import (
    FEWEST_LEVELS,
    FLOOR,
    LARGEST,
    NATURAL,
    ORDER,
    UNREFINED,
    Kind,
    Ladder,
    Plan,
)
from verification.convergence.observed_order import (
    ObservedOrder,
    order_text,
    refined_value,
)
from verification.running.study import CaseRecord, Row

NEAR = 3.0  # levels up to this ratio of sizes bound the error without a common power
COVERAGE = 2.0
LEAST_ORDER = 0.1  # a lower order has no limit within reach: 1000 times the cells halve its error
VANISHES = 1e-6  # relative to the natural size; smaller results are zero by symmetry


@dataclass(frozen=True)
class Effect:
    """Effect of one refined parameter on a scalar result, in the unit of the result.

    kind      kind of refinement
    sizes     size of the parameter on each level, coarse to fine
    values    result of each level, coarse to fine
    order     theoretical convergence order
    observed  observed convergence order; None if no power of the size explains the values
    limit     limit of the result under refinement of this parameter alone
    bound     uncertainty of the limit by the levels, at 95 %; infinite if it is unknown
    open      reason why the levels are not asymptotic, with a remedy; empty if they are
    """

    kind: Kind
    sizes: tuple[float, ...]
    values: tuple[float, ...]
    order: float
    observed: ObservedOrder | None
    limit: float
    bound: float
    open: str

    @property
    def order_text(self) -> str:
        """Observed convergence order with the half-width of its 95 % interval.

        The text is "none" if no power of the size explains the values, and "unknown" if the
        interval is too wide to judge the order.
        """
        if self.observed is None:
            return "none"
        if self.observed.keeps(self.order) is None:
            return "unknown"
        return order_text(*self.observed.interval)


@dataclass(frozen=True)
class Estimate:
    """Limit of one scalar result under refinement of all parameters, in its unit.

    name       result, with _x or _y for a component
    of         result without component, as a requested accuracy names it
    unit       unit of the result
    own        result of the setting of a run
    largest    largest value in the load history; requested accuracies are relative to this value
    effects    effects of the refined parameters
    floor      part of the uncertainty by the tolerance of the solves
    unrefined  part of the uncertainty by what the study does not refine; infinite if unknown
    small      reason why the finest mesh does not resolve a feature that matters; empty if it does
    """

    name: str
    of: str
    unit: str
    own: float
    largest: float
    effects: tuple[Effect, ...]
    floor: float
    unrefined: float
    small: str

    @property
    def limit(self) -> float:
        """Limit of the result: its value in a run, changed by the effects of all parameters."""
        return self.own + sum(effect.limit - self.own for effect in self.effects)

    @property
    def uncertainty(self) -> float:
        """Uncertainty of the limit at 95 %, with what the study does not refine."""
        return sum(effect.bound for effect in self.effects) + self.floor + self.unrefined

    def distance(self, value: float) -> float:
        """Distance of a value from the limit, relative to the largest value in the history."""
        return abs(value - self.limit) / self.largest

    def error(self, value: float) -> float:
        """Bound of the relative error of a value at 95 %: its distance and the uncertainty."""
        return self.distance(value) + self.uncertainty / self.largest

    def share(self, effect: Effect, value: float) -> float:
        """Bound of the relative error that one parameter leaves in a value of its levels."""
        return (abs(value - effect.limit) + effect.bound) / self.largest

    @property
    def worst(self) -> Kind:
        """Kind of refinement that reduces the error of the setting of a run most."""
        return max(self.effects, key=lambda effect: self.share(effect, self.own)).kind

    @property
    def open(self) -> str:
        """Reason why the uncertainty is no more than an order of magnitude; empty without one."""
        if self.small:
            return f"{self.small}: {self.effects[0].kind.remedy}, or a smaller window"
        if not isfinite(self.unrefined):
            return "the error by what the study does not refine is unknown"
        return next((e.open for e in self.effects if not isfinite(e.bound)), "")


def estimates(plan: Plan, records: Mapping[str, CaseRecord]) -> tuple[Estimate, ...]:
    """Estimate limit and error of all scalar results of a run that change under refinement.

    Results whose exact value is infinite, or that are zero by symmetry, are left out.

    records  available records by name of the level
    """
    run = records.get(plan.run.name)
    if run is None or "refused" in run.words:
        return ()
    found = (_estimate(part, run, plan.ladders, records) for part in run.parts)
    return tuple(one for one in found if one is not None)


def _estimate(
    part: Row, run: CaseRecord, ladders: Sequence[Ladder], records: Mapping[str, CaseRecord]
) -> Estimate | None:
    """Estimate limit and error of one scalar; None for one that is left out."""
    name, of = str(part.parameters["quantity"]), str(part.parameters["of"])
    measures = finite_measures(part.measures)
    largest, finest = measures[LARGEST], part
    if of == run.words.get("infinite") or largest <= VANISHES * measures[NATURAL]:
        return None
    effects = []
    for ladder in ladders:
        solved = {
            size: record
            for size, level in ladder.levels.items()
            if (record := records.get(level.name)) and record.measures.get(name) is not None
        }
        rows = [p for record in solved.values() for p in record.parts]
        last = [p for p in rows if p.parameters["quantity"] == name][-1:]
        if ladder is ladders[0]:
            finest = next(iter(last), part)
        effects.append(_effect(ladder, name, solved, finest))
    if all(len(set(effect.values)) == 1 for effect in effects):
        return None
    unrefined = measures.get(UNREFINED, inf)
    floor = max(measures[FLOOR], finite_measures(finest.measures)[FLOOR])
    return Estimate(
        name,
        of,
        run.units[name],
        finite_measures(run.measures)[name],
        largest,
        tuple(effects),
        floor * largest,
        unrefined * largest,
        finest.words["small"],
    )


def finite_measures(measures: Mapping[str, float | None]) -> dict[str, float]:
    """Return the measured values that are known, by name."""
    return {name: value for name, value in measures.items() if value is not None}


def _effect(ladder: Ladder, name: str, solved: Mapping[float, CaseRecord], finest: Row) -> Effect:
    """Extrapolate the effect of one refined parameter on a result.

    If errors scatter, the limit is the finest value, and its bound is that of `_scatter`. If the
    observed order keeps the theoretical one, as `verify` judges orders, the limit is that of the
    observed order. Otherwise it is the finest value, and its bound follows from the finest levels
    and the theoretical order.

    name    name of the result
    solved  records of the levels that have the result, by size, coarse to fine
    finest  row of the result on the finest mesh
    """
    measures, mesh = finite_measures(finest.measures), ladder.part not in ORDERS
    p = measures[ORDER] if mesh else ORDERS[ladder.part] / ladder.power
    floor = measures[FLOOR] * measures[LARGEST]
    values = tuple(finite_measures(record.measures)[name] for record in solved.values())
    sizes = tuple(
        float(record.parameters["side"] or size) if mesh else size**ladder.power
        for size, record in solved.items()
    )
    if len(set(values)) == 1:
        return Effect(ladder.kind, sizes, values, p, None, values[-1], 0.0, "")
    if ladder.scatters:
        observed = refined_value(sizes, values, p).observed
        bound = _scatter(sizes, values, p)
        return Effect(ladder.kind, sizes, values, p, observed, values[-1], bound, "")
    if len(sizes) < FEWEST_LEVELS:
        why = f"{len(sizes)} levels have a result, and a limit needs {FEWEST_LEVELS}"
        return Effect(ladder.kind, sizes, values, p, None, values[-1], inf, why)
    finest_first = [(h / sizes[-1], v) for h, v in zip(sizes, values, strict=True)][::-1]
    # Two neighbours may have equal values by chance.
    near = [(r, v) for n, (r, v) in enumerate(finest_first) if n and (n < 3 or r < NEAR)]
    bound = max(abs(values[-1] - v) / (r ** (BELIEVED * p) - 1) for r, v in near)
    fit = refined_value(sizes, values, p)
    limit, why = values[-1], "the two finest levels agree within the tolerance of the solves"
    if bound > floor:
        why = _reason_not_asymptotic(fit.observed, p, ladder.kind)
        if fit.observed is not None and not why:
            followed = refined_value(sizes, values, fit.observed.order)
            limit = followed.limit
            bound = COVERAGE * followed.uncertainty + _reach_of_order(sizes, values, fit.observed)
    return Effect(ladder.kind, sizes, values, p, fit.observed, limit, bound, why)


def _scatter(sizes: Sequence[float], values: Sequence[float], order: float) -> float:
    """Compute the error of the finest level if each level has another C in the error C h^p."""
    # A common power of some levels is a coincidence then. The largest spread counts, because the
    # errors of half widths have one sign: their mean square is more than that of their differences.
    return SPREADS * max(
        abs(value - values[-1]) / sqrt((size / sizes[-1]) ** (2 * order) + 1)
        for size, value in zip(sizes[:-1], values[:-1], strict=True)
    )


def _reach_of_order(
    sizes: Sequence[float], values: Sequence[float], observed: ObservedOrder
) -> float:
    """Compute the largest change of a limit by a convergence order within its 95 % interval."""
    # An error that the study does not refine changes the observed order, and with it the limit.
    low, limit, high = (
        refined_value(sizes, values, max(LEAST_ORDER, observed.order + way)).limit
        for way in (-observed.half_width, 0.0, observed.half_width)
    )
    return max(abs(low - limit), abs(high - limit))


def _reason_not_asymptotic(observed: ObservedOrder | None, order: float, kind: Kind) -> str:
    """Return the reason why the values of a result do not keep the theoretical order, with a
    remedy.

    The text is empty if they keep it.

    observed  observed convergence order; None if no power fits
    order     theoretical convergence order
    kind      kind of refinement
    """
    if observed is None:
        return f"no power of the size explains the levels: {kind.cause}; {kind.remedy}"
    kept = observed.keeps(order)
    if kept is None:
        return (
            f"the order is known to ± {observed.half_width:.2g} alone: {kind.cause}; "
            f"{kind.remedy}, or more --levels"
        )
    different = f"the levels do not have the theoretical order: {kind.cause}; {kind.remedy}"
    return "" if kept else different
