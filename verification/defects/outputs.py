"""Seeded defects of results: wrong values and incomplete results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

import fem_reference
import semi_analytical
from contact_results.directory.atomic_file import atomic_file
from verification.defects.defect import (
    Defect,
    Replacements,
    changed_results,
    replaces,
    scaled_increments,
)
from verification.running import case_pool

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
        return replace(increment, pressure=increment.pressure[..., :-1])

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


SEEN = ("hertz_approach_control", "fem_hertz")
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
        ("hertz_approach_control",),
        _half_record_written,
    ),
)

OUTPUTS = (*PLANTED, *NO_RESULTS)
