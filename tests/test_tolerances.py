"""Tests of stored tolerances: damaged files, and the numbers that they belong to."""

from __future__ import annotations

from pathlib import Path

import pytest

from verification.judging.case import Level
from verification.regression.baseline import BaselineRefused, read_baselines
from verification.regression.tolerances import (
    read_tolerances,
)


def test_a_damaged_file_of_tolerances_is_named(tmp_path: Path) -> None:
    (tmp_path / "quick.json").write_text("{")
    with pytest.raises(BaselineRefused, match=r"quick\.json is damaged: got no JSON"):
        read_tolerances("quick", tmp_path)


@pytest.mark.parametrize("level", [level.name.lower() for level in Level])
def test_every_accepted_tolerance_belongs_to_a_recorded_number(level: str) -> None:
    """A number that gets another name loses its tolerance, unless that is accepted anew."""
    recorded = {
        (case, f"{quantity.name} [{quantity.key[1]}] {quantity.tolerance_kind}")
        for case, baseline in read_baselines().items()
        if level in baseline.levels
        for quantity in baseline.levels[level].quantities
    }
    accepted = read_tolerances(level).accepted
    assert all(one.because for one in accepted)
    named = [pair for one in accepted for pair in one.tolerances.items()]
    assert {(case, key) for case, keys in named for key in keys} <= recorded
