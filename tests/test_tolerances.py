"""Tests of stored tolerances: damaged files, and the numbers that they belong to."""

import pytest
from report_examples import a_case, verdict

from verification.judging.case import Level
from verification.regression.baseline import BaselineRefused, read_baselines
from verification.regression.tolerances import Tolerances, held_to, read_tolerances, text_of


def test_a_damaged_file_of_tolerances_is_named(tmp_path):
    (tmp_path / "quick.json").write_text("{")
    with pytest.raises(BaselineRefused, match=r"quick\.json is damaged: got no JSON"):
        read_tolerances("quick", tmp_path)


@pytest.mark.parametrize("level", [level.name.lower() for level in Level])
def test_every_accepted_tolerance_belongs_to_a_recorded_number(level):
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


def test_no_tolerance_is_smaller_than_the_uncertainty_of_the_reference():
    one = verdict("radius", 1.0, 1.0).model_copy(update={"reference_uncertainty": 6e-3})
    outcome = a_case("case").model_copy(update={"verdicts": (one,)})
    of_case = {"case": {text_of(one): {"allowed": 1e-4, "error": 1e-5}}}
    accepted = {"because": "why", "commit": None, "kernels": [], "tolerances": of_case}
    known = Tolerances.model_validate({"level": "quick", "accepted": [accepted]})
    (held,) = held_to([outcome], known)
    assert held.verdicts[0].allowed == 6e-3
