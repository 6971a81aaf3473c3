"""Seeded defects of results: wrong values, incomplete results, and wrong texts of reports."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np

import fem_reference
import semi_analytical
from contact_results.directory.atomic_file import atomic_file
from contact_results.files import tables
from contact_results.stress import stress_maxima
from verification.convergence import observed_order
from verification.defects.defect import (
    Defect,
    Replacements,
    changed_results,
    replaces,
    scaled_increments,
)
from verification.judging import judgement, outcome
from verification.running import case_pool

SIDES = {"above": "below", "below": "above"}


def _shown_halved(text: str, field: str) -> Replacements:
    @replaces(outcome, text)
    def halved(whole: Any, verdict: Any) -> Any:
        return whole(verdict.model_copy(update={field: 0.5 * getattr(verdict, field)}))

    return halved


@replaces(observed_order, "richardson")
def _finest_exchanged(whole: Any, h: Any, f: Any, order: float) -> Any:
    g = f.copy()
    g[:2] = f[1::-1]
    return whole(h, g, order)


@replaces(observed_order, "_known_to")
def _one_sided(whole: Any, *given: Any) -> Any:
    order = whole(*given)
    return replace(order, half_width=order.margin)


@replaces(tables, "numbers", local=True)
def _torque_for_twist(whole: Any, increment: Any) -> Any:
    values = dict(whole(increment))
    return values | {"torque": values["twist"], "twist": values["torque"]}


@replaces(tables, "_largest_with_place")
def _place_turned(whole: Any, *given: Any) -> Any:
    value, x, y = whole(*given)
    return value, y, x


BY_HAND = ("worked_examples",)
BY_FILES = ("written_files",)

TOLD = (
    Defect(
        "uncertainty-shown-halved",
        "The printed uncertainty of a reference is halved.",
        BY_HAND,
        _shown_halved("uncertainty_text", "reference_uncertainty"),
    ),
    Defect(
        "allowed-shown-halved",
        "The printed tolerance is halved.",
        BY_HAND,
        _shown_halved("_allowed_text", "allowed"),
    ),
    Defect(
        "coverage-doubled",
        "Tolerances are U = 4u.",
        BY_HAND,
        replaces(judgement, "expanded_uncertainty")(lambda whole, *given: 2 * whole(*given)),
    ),
    Defect(
        "finest-levels-exchanged",
        "Richardson extrapolation exchanges the two finest levels.",
        BY_HAND,
        _finest_exchanged,
    ),
    Defect("interval-one-sided", "95 % intervals omit 5 % on either side.", BY_HAND, _one_sided),
    Defect(
        "variance-inverted",
        "Fits weight levels by h^p instead of its inverse.",
        BY_HAND,
        replaces(observed_order, "_line")(
            lambda whole, h, f, order, weight_order: whole(h, f, order, -weight_order)
        ),
    ),
    Defect(
        "torque-for-twist",
        "The columns of torque and twist are exchanged.",
        BY_FILES,
        _torque_for_twist,
    ),
    Defect(
        "place-of-f1-turned",
        "The coordinates x and y of the position of Ruiz's parameters are exchanged.",
        BY_FILES,
        _place_turned,
    ),
    Defect(
        "sides-exchanged",
        "Above and below an interface are exchanged.",
        BY_FILES,
        replaces(stress_maxima, "interface_sides")(
            lambda whole, body: [(n, SIDES[side], *rest) for n, side, *rest in whole(body)]
        ),
    ),
)


BIAS = 3e-3
FLOOR = 5e-4
FIRST_ORDER = 0.1  # of h/a
FALSIFIED = (
    "approach",
    "pressure",
    "peak_pressure",
    "tangential_shift",
    "shear",
    "shear_along_load",
    "twist",
    "shear_circumferential",
)


def _changed_results(change: Callable[[Any], Any]) -> Replacements:
    return changed_results(change, semi_analytical, fem_reference)


def _scaled_results(factor: Callable[[Any], float]) -> Replacements:
    """Return the defect that multiplies approach, shift, twist and tractions by a wrong factor.

    factor  function of the result that returns the factor
    """
    return _changed_results(lambda result: scaled_increments(result, factor(result), FALSIFIED))


def _relative_cell_size(result: Any) -> float:
    """Compute the side of a surface cell or finite element over the contact radius, h/a, for a
    result.

    The seeded defects of first order have an error proportional to this ratio.
    """
    if isinstance(result, semi_analytical.Result):
        return max(result.grid.spacing) / result.increments[-1].contact_radius
    return 1 / float(result.discretisation.elements_per_radius)


def _error_floor_factor(result: Any) -> float:
    """Return the wrong factor 1 ± 0.0005 for results: refinement does not reduce this error.

    The sign depends on the parity of the number of cells per contact radius.
    """
    return 1 + FLOOR * (-1) ** round(1 / _relative_cell_size(result))


def _last_row_missing(result: Any) -> Any:
    def shortened(increment: Any) -> Any:
        return replace(
            increment,
            **{
                field.name: value[..., :-1]
                for field in fields(increment)
                if np.ndim(value := getattr(increment, field.name)) and field.name == "pressure"
            },
        )

    return replace(result, increments=tuple(map(shortened, result.increments)))


@replaces(case_pool.CaseStore, "save")
def _half_record_written(whole: Any, self: Any, case: Any, record: Any) -> None:
    """Plant an incomplete file: each stored record of a case contains only the first half of its
    text."""
    whole(self, case, record)
    path = self.path(case)
    text = path.read_text(encoding="utf-8")
    with atomic_file(path) as temporary:
        temporary.write_text(text[: len(text) // 2], encoding="utf-8")


SEEN = ("dissimilar_bodies", "fem_hertz")
PLANTED_IN = ("hertz_point", "cattaneo_mindlin", "fem_hertz")

PLANTED = (
    Defect(
        "first-order-error",
        "Results are too large by 0.1 h/a: an error of first order.",
        PLANTED_IN,
        _scaled_results(lambda r: 1 + FIRST_ORDER * _relative_cell_size(r)),
    ),
    Defect(
        "error-floor",
        "Results have an error of ± 0.05 % on any grid.",
        PLANTED_IN,
        _scaled_results(_error_floor_factor),
    ),
    Defect(
        "bias",
        "Results are too large by 0.3 %.",
        PLANTED_IN,
        _scaled_results(lambda r: 1 + BIAS),
    ),
)

NO_RESULTS = (
    Defect(
        "nan",
        "Results are not numbers.",
        SEEN,
        _scaled_results(lambda r: np.nan),
    ),
    Defect(
        "wrong-length",
        "The pressure lacks its last row.",
        ("hertz_point", "fem_hertz"),
        _changed_results(_last_row_missing),
    ),
    Defect(
        "history-truncated",
        "The last increment of a result is missing.",
        ("cattaneo_mindlin",),
        _changed_results(lambda result: replace(result, increments=result.increments[:-1])),
    ),
    Defect(
        "record-truncated",
        "Half of the file with a finished case reaches the disk.",
        ("dissimilar_bodies",),
        _half_record_written,
    ),
)

OUTPUTS = (*PLANTED, *NO_RESULTS)
