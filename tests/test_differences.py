"""Tests of the difference between two results: a value that is NaN never counts as a small
difference."""

from dataclasses import replace
from functools import cache, partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from contact_scenes import PRESS, grid, push, scene

from semi_analytical import Result, solve
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
