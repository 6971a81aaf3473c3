"""Identification of inputs of a scene from a measured loop or profile, by least squares.

The residuals r are the differences of measured and computed curves, relative to the largest
measured value. Their squares are minimised over the logarithms x of the inputs. With the
slopes J = dr/dx at the minimum, n points and m inputs:

    variance of x by the scatter of the points = (JᵀJ)⁻¹ rᵀr / (n - m)
    largest change of x by the errors e of both curves = |J⁺| e

The first line holds for a correct scene and independent points. The errors are those that the run
states, and those of the measured loop by its drift.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import exp, hypot, inf

import numpy as np

from contact_scene.reading.scene_error import Problem, SceneError, shown
from contact_scene.solver_errors import SolverError
from slipstick.against import (
    ComparedNumber,
    Comparison,
    NothingToCompare,
    Numbers,
    root_mean_square,
)
from slipstick.uncertain_inputs import NUMBER, override_text

_FIRST = re.compile(rf"\s*(?P<key>[^\s=]+)\s*=\s*(?P<value>{NUMBER})\s*(?P<unit>[^\s\d.].*?)?\s*")
EXPECTED = "key=first value above 0, such as friction.coefficient=.1 or rig.stiffness=50 N/um"
# Logarithm at the first value of each input. The tolerance of the optimiser is relative to the norm
# of the logarithms, which then does not depend on units.
ORIGIN = 10.0
# Step of a logarithm for its slope. The slope errs by about 1e-5 by the tolerance 1e-8 of a solve,
# and by about 1e-3 by its change over the step.
STEP = 1e-3
# Relative change of the inputs that ends the iteration: a tenth of the smallest useful scatter.
PRECISION = 1e-4
# Smallest ratio of the singular values of normalised slopes, which have an error of about STEP.
INDEPENDENT = 10 * STEP
# Iterations. A fit of two inputs to a loop took 6 and 8, from values off by a third to a half.
MAX_ITERATIONS = 20
# Residual of each point for inputs with which the scene cannot be solved: the curves are further
# apart than curves of opposite sign.
UNSOLVED = 4.0


@dataclass(frozen=True)
class FittedInput:
    """Value of one key of a scene that fits a measured table best.

    key         key of the scene file
    unit        unit of all values; empty for a dimensionless key
    first       value at which the search begins
    value       value of the best fit
    by_scatter  standard deviation by the scatter of the points
    by_errors   largest change by the errors of both curves; None if they are unknown
    """

    key: str
    unit: str
    first: float
    value: float
    by_scatter: float | None = None
    by_errors: float | None = None

    @property
    def override(self) -> str:
        """The argument of `--set` for the value."""
        return override_text(self.key, self.value, self.unit)


def read_first_values(text: str) -> tuple[FittedInput, ...]:
    """Read the keys to fit with their first values, such as "friction.coefficient=.1".

    text  keys with values, separated by commas; a value may have a unit

    Raises SceneError for another text, a value of 0 or less, an infinite one, and a repeated key.
    """
    found: dict[str, FittedInput] = {}
    for item in text.split(","):
        match = _FIRST.fullmatch(item)
        if match is None or not 0 < float(match["value"]) < inf or match["key"] in found:
            raise SceneError([Problem(("--fit",), f"got {shown(item.strip())}", EXPECTED)])
        first = float(match["value"])
        found[match["key"]] = FittedInput(match["key"], match["unit"] or "", first, first)
    return tuple(found.values())


def fit(
    inputs: Sequence[FittedInput],
    compare: Callable[[Sequence[FittedInput], bool], Comparison],
) -> tuple[tuple[FittedInput, ...], Comparison]:
    """Fit inputs of a scene to a measured table.

    Returns the fitted inputs and the comparison of the table with their scene.

    inputs   keys with their first values
    compare  solves the scene with the values of the inputs and compares the table with it; the
             second argument is True to compute the stated errors, too

    Raises NothingToCompare if the curves do not determine the inputs, and SceneError or SolverError
    if the scene is invalid or unsolved with the first values.
    """
    from scipy.optimize import least_squares

    curves = _Curves(inputs, compare)
    start = np.full(len(inputs), ORIGIN)
    _refuse_dependent(inputs, curves.slopes(start))
    best = least_squares(
        curves.residuals,
        start,
        curves.slopes,
        xtol=PRECISION / ORIGIN,
        ftol=PRECISION**2,
        max_nfev=MAX_ITERATIONS,
    )
    _refuse_dependent(inputs, best.jac)
    if weak := [one.key for one, each in zip(inputs, best.jac.T, strict=True) if _is_weak(each)]:
        raise NothingToCompare(f"the curves do not depend on {', '.join(weak)}; do not fit it")
    if not best.success:
        raise NothingToCompare(
            f"the fit does not converge in {MAX_ITERATIONS} iterations; give nearer first values, "
            "or fit fewer inputs"
        )
    fitted = curves.inputs_at(best.x)
    compared = compare(fitted, True)
    inverse = np.linalg.pinv(best.jac)
    variance = np.sum(best.fun**2) / (curves.points - len(inputs))
    scatter = np.sqrt(variance * np.sum(inverse**2, axis=1))
    errors = _residual_errors(compared.numbers)
    by_errors = None if errors is None else np.abs(inverse) @ errors
    return tuple(
        replace(
            one,
            by_scatter=one.value * float(scatter[row]),
            by_errors=None if by_errors is None else one.value * float(by_errors[row]),
        )
        for row, one in enumerate(fitted)
    ), compared


class _Curves:
    """Residuals of a measured table as functions of the logarithms of the inputs.

    points  number of residuals

    Raises NothingToCompare if the first values give no curve, or fewer points than inputs.
    """

    def __init__(
        self,
        inputs: Sequence[FittedInput],
        compare: Callable[[Sequence[FittedInput], bool], Comparison],
    ) -> None:
        self._inputs = inputs
        self._compare = compare
        try:
            first = _residuals(compare(inputs, False).numbers)
        except NothingToCompare as error:
            raise NothingToCompare(f"with the first values of --fit, {error}") from None
        self._known = {np.full(len(inputs), ORIGIN).tobytes(): first}
        self.points = len(first)
        if self.points <= len(inputs):
            raise NothingToCompare(f"got {self.points} points, expected more than inputs to fit")

    def inputs_at(self, logarithms: Numbers) -> tuple[FittedInput, ...]:
        return tuple(
            FittedInput(one.key, one.unit, one.first, one.first * exp(x - ORIGIN))
            for one, x in zip(self._inputs, logarithms, strict=True)
        )

    def residuals(self, logarithms: Numbers) -> Numbers:
        """Solve the scene, and return the residuals of its curves (n,)."""
        place = logarithms.tobytes()
        if place not in self._known:
            try:
                compared = self._compare(self.inputs_at(logarithms), False)
                self._known[place] = _residuals(compared.numbers)
            # Such as a Poisson's ratio above one half, gross sliding, or a loop without slip.
            except (SceneError, SolverError, NothingToCompare):
                self._known[place] = np.full(self.points, UNSOLVED)
        if len(self._known[place]) != self.points:
            raise NothingToCompare(
                "the number of increments changes with the fitted inputs; set 'increments' of the "
                "load steps"
            )
        return self._known[place]

    def slopes(self, logarithms: Numbers) -> Numbers:
        """Return the slope of each residual by the logarithm of each input (n, m)."""
        here, columns = self.residuals(logarithms), []
        for row, one in enumerate(self.inputs_at(logarithms)):
            beside = self.residuals(logarithms + STEP * (np.arange(len(logarithms)) == row))
            if np.all(beside == UNSOLVED):
                raise NothingToCompare(
                    f"near {one.key}={one.value:.6g} {one.unit}".rstrip()
                    + " the scene has no solution or no loop; give another first value"
                )
            columns.append((beside - here) / STEP)
        return np.stack(columns, axis=1)


def _residuals(numbers: Sequence[ComparedNumber]) -> Numbers:
    """Return all differences over the largest measured value of their curve (n,).
    Raise NothingToCompare for a curve of zeros."""
    if zero := [
        each.name for each in numbers if each.differences is not None and not each.measured
    ]:
        raise NothingToCompare(f"{zero[0]}: all measured values are 0, which fits nothing")
    return np.concatenate(
        [each.differences / each.measured for each in numbers if each.differences is not None]
    )


def _residual_errors(numbers: Sequence[ComparedNumber]) -> Numbers | None:
    curves = [each for each in numbers if each.differences is not None]
    if any(each.error is None for each in curves):
        return None
    return np.concatenate(
        [
            np.full_like(each.differences, hypot(each.error or 0.0, each.of_table or 0.0))
            / each.measured
            for each in curves
        ]
    )


def _is_weak(slopes: Numbers) -> bool:
    return root_mean_square(slopes) < STEP


def _refuse_dependent(inputs: Sequence[FittedInput], slopes: Numbers) -> None:
    """Raise NothingToCompare if inputs change the curves in the same way.

    slopes  slope of each residual by the logarithm of each input (n, m)
    """
    strong = [column for column in range(len(inputs)) if not _is_weak(slopes[:, column])]
    if len(strong) < 2:
        return
    directions = slopes[:, strong] / np.linalg.norm(slopes[:, strong], axis=0)
    singular = np.linalg.svd(directions, compute_uv=False)
    if singular[-1] < INDEPENDENT * singular[0]:
        keys = " and ".join(inputs[column].key for column in strong)
        raise NothingToCompare(f"{keys} change the curves in the same way; leave one of them out")
