"""Tests of whole commands of drawn scenes by all solvers."""

import pytest
from whole_commands import failures_of_drawn_scenes


@pytest.mark.parametrize(("count", "seed"), [(2, 15), pytest.param(40, 0, marks=pytest.mark.slow)])
def test_commands_of_drawn_scenes_end_as_documented(count, seed):
    assert failures_of_drawn_scenes(count, seed) == []
