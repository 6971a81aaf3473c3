"""Tests of the difference between two results: a value that is NaN never counts as a small
difference."""

from collections.abc import Callable
from types import SimpleNamespace

import pytest
from contact_scenes import PRESS, scene

from contact_results.key_numbers import outcome_columns
from contact_scene.checks.expected_contact import beyond_linear_theory
from contact_scene.quantities.increment import SCALARS
from slipstick.cli.progress import solve_lines


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
