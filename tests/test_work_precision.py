"""Tests of the study of work and precision: Pareto front, cheapest setting, and timing."""

import numpy as np
import pytest

from contact_scene.disk_cache import cached_array
from radial.response.wavenumbers import (
    waves,
)
from verification.judging.case import Level
from verification.running.cold_cache import cold_cache
from verification.running.study import Settings
from verification.studies.work_precision import (
    OWN,
    STUDY,
    Method,
    PrecisionCase,
)


def test_every_setting_has_a_name_of_its_own():
    for level in Level:
        names = [case.name for case in STUDY.cases(Settings(level))]
        assert len(set(names)) == len(names) > 100


@pytest.mark.parametrize(("contact", "error"), [("cattaneo", "shear"), ("coated", "pressure")])
@pytest.mark.parametrize("method", Method)
def test_tractions_are_judged_by_what_each_method_states(method, contact, error):
    """On 32 cells, 16 elements and the rings of the radial solver they err by less than 4 %."""
    fineness = {Method.SURFACE: 32, Method.EDGES: 32, Method.RADIAL: OWN}.get(method, 16)
    case = PrecisionCase(contact, method, fineness, penalty=10.0 * (method is Method.PENALTY))
    assert 0 < case.solved.errors_of(case._solve_contact())[error] < 0.04


def test_a_measurement_starts_from_an_empty_cache(monkeypatch, tmp_path):
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", str(tmp_path))
    assert cached_array("stored", (1,), lambda: np.zeros(1)) == 0
    with cold_cache():
        assert cached_array("stored", (1,), lambda: np.ones(1)) == 1


def test_a_measurement_finds_nothing_in_memory():
    """What contacts have in common is made again, with its functions called."""
    asked = waves(0.01, 1.0, 1.0)
    with cold_cache():
        first = asked.even_transforms(2)
        assert asked.even_transforms(2) is first
    with cold_cache():
        assert asked.even_transforms(2) is not first
