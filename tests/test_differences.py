"""What is measured between two results: a value that is no number is never a small difference."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from contact_scenes import PRESS, grid, push, scene

from contact_results.difference import largest_difference
from semi_analytical import Result, solve
from verification.cases import eccentric_ball, hertz_unloading, same_surface, turned

READ: dict[Any, tuple[str, ...]] = {
    largest_difference: ("pressure", "shear", "tangential_shift", "approach"),
    turned.difference_after_quarter: ("pressure", "shear", "tangential_shift"),
    turned.difference_of_motion(30.0): ("tangential_shift", "dissipated_energy"),
    same_surface._mirrored_difference: ("pressure", "shear"),
    same_surface._difference_of_scalars: ("approach", "tangential_shift", "dissipated_energy"),
    hertz_unloading._difference: ("pressure", "approach"),
    eccentric_ball._shifted_difference: ("pressure", "shear"),
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
