"""Tests of the difference between two results: a value that is NaN never counts as a small
difference."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from contact_scenes import PRESS, grid, push, scene

from contact_results.key_numbers import outcome_columns
from contact_scene.checks.expected_contact import beyond_linear_theory
from contact_scene.quantities.increment import SCALARS
from semi_analytical import Result, solve
from slipstick.cli.progress import solve_lines
from verification.cases import histories, indenters

READ: dict[Any, tuple[str, ...]] = {
    histories.as_it_is: ("pressure", "shear", "tangential_shift", "approach"),
    histories.after_quarter: ("pressure", "shear", "tangential_shift", "approach"),
    partial(histories.motion_apart, 30.0): ("tangential_shift", "dissipated_energy"),
    histories.in_mirror: ("pressure", "shear", "tangential_shift", "approach"),
    histories.scalars_apart: ("approach", "tangential_shift", "dissipated_energy"),
    indenters._pressure_and_approach: ("pressure", "approach"),
    histories.after_half: ("pressure", "shear", "tangential_shift", "approach"),
    indenters._shifted_field_difference: ("pressure", "shear"),
}


@cache
def solved() -> Result:
    return solve(scene(PRESS, push(0.8)), grid(16), 1e-8)


@pytest.mark.parametrize(
    ("measure", "field"), [(measure, field) for measure, fields in READ.items() for field in fields]
)
def test_a_value_that_is_no_number_makes_no_small_difference(measure: Any, field: str) -> None:
    whole = solved()
    assert np.isfinite(measure(whole, whole))
    *first, end = whole.increments
    lost = replace(end, **{field: getattr(end, field) * np.nan})
    broken = SimpleNamespace(increments=(*first, lost), steps=(*whole.steps[:-1], lost))
    assert np.isnan(measure(whole, broken))
    assert np.isnan(measure(broken, whole))


class End:
    """The end of a step with some contact, told as `State` is."""

    def __init__(self, value: float) -> None:
        vars(self).update(dict.fromkeys(SCALARS), normal_force=value, approach=1e-6)
        self.contact_area, self.contact_radius = 1e-6, 5e-4
        self.tangential_shift = (value, 1e-6)
        self.is_line = False


def of_residuals(values: list[float]) -> str:
    increments = [SimpleNamespace(worst_residual=value) for value in values]
    return str(dict(solve_lines(SimpleNamespace(tolerance=1e-8, increments=increments), 1.0)))


def of_steps(values: list[float]) -> str:
    return str(outcome_columns([End(value) for value in values])["tangential\nshift x\nm"])


TOLD: dict[str, Callable[[list[float]], str]] = {
    "largest residual": of_residuals,
    "strains": lambda values: str(beyond_linear_theory(scene(PRESS), map(End, values))),
    "shifts of steps": of_steps,
}


@pytest.mark.parametrize("place", range(3))
@pytest.mark.parametrize("tell", TOLD.values(), ids=TOLD)
def test_of_several_values_the_one_that_is_no_number_is_told(
    tell: Callable[[list[float]], str], place: int
) -> None:
    values = [1e-6, 2e-6, 1e-6]
    if tell is not of_steps:
        assert "nan" not in tell(values)
    values[place] = float("nan")
    assert "nan" in tell(values)
