r"""Limit of a number under refinement, its uncertainty, and the error on the finest level.

Where the levels follow one power of their size, $f(h) = f_0 + C h^p$, the limit is $f_0$ by least
squares with the observed order $p$ (Richardson 1911). Its uncertainty is twice the standard
uncertainty, of the scatter of the fit and of the limit that the two finest levels give. Elsewhere
the limit is the finest value, and its uncertainty that of a run,

$$ \max_k |f - f_k| / (r_k^{0.6p} - 1) , $$

over the levels whose sizes are within three times the finest; $r_k$ is the ratio of sizes. The edge
correction removes the regular error, and how an edge cuts the cells differs from grid to grid:
there corrected numbers scatter about their limit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from contact_errors.error_formula import BELIEVED
from verification.convergence.observed_order import (
    ORDER_WIDTH,
    ObservedOrder,
    Triplets,
    refined_value,
    triplets_agree,
)
from verification.running.row import CaseRecord, Row
from verification.running.rules import RESIDUAL
from verification.studies.refinement.scene_level import FLOOR, LARGEST, NATURAL, ORDER

FEWEST_LEVELS = 4
NEAR = 3.0  # ratio of sizes up to which levels count where one power does not explain them
COVERAGE = 2.0
VANISHES = 1e-6  # of the natural size: a smaller number is zero by symmetry
FINER = "use more --cells"


@dataclass(frozen=True)
class Estimate:
    """Limit and error of one number, in its unit.

    of           number without component, as a request names it
    sizes, values
                 of the levels, coarse to fine
    largest      largest value in the history, to which requests are relative
    order        theoretical order; observed: measured order, None where no power explains the
                 values
    remaining    error on the finest level, at 95 %
    likely       the most likely error there, without a safety factor
    open         why the levels are not asymptotic, with a remedy; empty where they are
    resolved     whether the finest level resolves the features on which the number depends
    """

    name: str
    of: str
    unit: str
    sizes: tuple[float, ...]
    values: tuple[float, ...]
    largest: float
    order: float
    observed: ObservedOrder | None
    limit: float
    uncertainty: float
    remaining: float
    likely: float
    open: str
    resolved: bool

    @property
    def points(self) -> list[tuple[float, float]]:
        """Sizes with the distances from the limit, relative to the largest value."""
        errors = (abs(value - self.limit) / self.largest for value in self.values)
        return list(zip(self.sizes, errors, strict=True))

    @property
    def order_text(self) -> str:
        """Observed order with its 95 % interval."""
        if self.observed is None:
            return "none"
        return f"{self.observed.order:.2f} ± {self.observed.half_width:.2f}"


def estimates(levels: Sequence[CaseRecord], order: float | None) -> tuple[Estimate, ...]:
    """Estimate all numbers of the finest level that refinement changes.

    levels  coarse to fine
    order   of all numbers; None where it is that of each number in the cells
    """
    if len(levels) < FEWEST_LEVELS:
        return ()
    return tuple(
        _estimate(part, levels, order)
        for part in levels[-1].parts
        if _varies(part, levels) and str(part.parameters["of"]) != levels[-1].words.get("infinite")
    )


def _varies(part: Row, levels: Sequence[CaseRecord]) -> bool:
    """Whether a number is on all levels, not zero by symmetry, and not the same everywhere."""
    name, measures = str(part.parameters["quantity"]), _known(part.measures)
    values = [level.measures.get(name) for level in levels]
    return (
        name != RESIDUAL
        and None not in values
        and measures[LARGEST] > VANISHES * measures[NATURAL]
        and len(set(values)) > 1
    )


def _known(measures: Mapping[str, float | None]) -> dict[str, float]:
    return {name: value for name, value in measures.items() if value is not None}


def _estimate(part: Row, levels: Sequence[CaseRecord], order: float | None) -> Estimate:
    name, measures = str(part.parameters["quantity"]), _known(part.measures)
    sizes = [float(level.parameters["size"] or 0.0) for level in levels]
    values = [_known(level.measures)[name] for level in levels]
    p = order or measures[ORDER]
    floor = measures[FLOOR] * measures[LARGEST]
    near = [(h / sizes[-1], v) for h, v in zip(sizes, values, strict=True) if h < NEAR * sizes[-1]]
    bound, likely = (
        max(abs(values[-1] - value) / (ratio**power - 1) for ratio, value in near if ratio > 1)
        for power in (BELIEVED * p, p)
    )
    fit = refined_value(sizes, values, p)
    limit, why = values[-1], ""
    if bound > floor:
        why = _not_asymptotic(fit.observed, fit.triplets)
        if fit.observed is not None and not why:
            followed = refined_value(sizes, values, fit.observed.order)
            limit, bound = followed.limit, COVERAGE * followed.uncertainty
            likely = abs(values[-1] - limit)
    small = part.words["small"]
    if small:
        why = f"{small}: {FINER}, or a smaller window"
    uncertainty = bound + floor
    return Estimate(
        name, str(part.parameters["of"]), levels[-1].units[name], tuple(sizes), tuple(values),
        measures[LARGEST], p, fit.observed, limit, uncertainty,
        abs(values[-1] - limit) + uncertainty, likely, why, not small,
    )  # fmt: skip


def _not_asymptotic(observed: ObservedOrder | None, triplets: Triplets) -> str:
    """Reason with a remedy; empty where one power of the size explains the levels."""
    if observed is None:
        return (
            "no power of the size explains the levels: the edges of contact and stick zone cut the "
            "cells of each level differently. The limit is the finest value; its uncertainty falls "
            f"with the cells: {FINER}"
        )
    if observed.half_width > ORDER_WIDTH:
        return (
            f"the order is known to ± {observed.half_width:.2g} alone: the levels scatter. The "
            f"limit is the finest value; {FINER}, or more --levels"
        )
    if not triplets_agree(triplets):
        shown = " and ".join("none" if t is None else f"{t:.2f}" for t in triplets)
        return (
            f"the order by the finest levels and by coarser ones differs ({shown}): the coarse "
            f"levels are not asymptotic. {FINER[0].upper()}{FINER[1:]}, with as many --levels"
        )
    return ""
