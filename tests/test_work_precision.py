"""Tests of the study of work and precision: Pareto front, cheapest setting, and timing."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

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
    TARGETS,
    Method,
    Point,
    PrecisionCase,
    cheapest,
    dependable,
    pareto,
)

SETTINGS = Settings(Level.QUICK)
positive = st.floats(1e-6, 1.0)
points = st.lists(
    st.builds(
        lambda method, fineness, error, seconds: Point(method, "", "", fineness, error, seconds),
        st.sampled_from(["one", "other"]),
        st.integers(1, 64),
        positive,
        positive,
    ),
    max_size=20,
)


@given(points, st.sampled_from(TARGETS))
def test_the_pareto_line_beats_every_point_and_has_the_cheapest(
    all_points: list[Point], target: float
) -> None:
    line = pareto(all_points)
    for p in all_points:
        assert any(kept.seconds <= p.seconds and kept.error <= p.error for kept in line)
    assert [p.seconds for p in line] == sorted(p.seconds for p in line)
    good = [p.seconds for p in all_points if p.error <= target]
    best = cheapest(all_points, target)
    assert (best.seconds if best else None) == min(good, default=None)


@given(points)
def test_a_finer_setting_of_a_curve_is_never_less_dependable(all_points: list[Point]) -> None:
    steady = dependable(all_points)
    assert sorted(p.seconds for p in steady) == sorted(p.seconds for p in all_points)
    for p in steady:
        finer = [q for q in all_points if q.method == p.method and q.fineness > p.fineness]
        assert all(q.error <= p.error for q in finer)


def test_a_setting_whose_error_is_no_number_makes_none_dependable() -> None:
    points = [Point("a", "", "", n, e, n) for n, e in ((16, 1e-3), (32, np.nan), (64, 1e-4))]
    assert [p.fineness for p in dependable(points) if p.error <= 1] == [64]


def test_every_setting_has_a_name_of_its_own() -> None:
    for level in Level:
        names = [case.name for case in STUDY.cases(Settings(level))]
        assert len(set(names)) == len(names) > 100


@pytest.mark.parametrize(("contact", "error"), [("cattaneo", "shear"), ("coated", "pressure")])
@pytest.mark.parametrize("method", Method)
def test_tractions_are_judged_by_what_each_method_states(
    method: Method, contact: str, error: str
) -> None:
    """On 32 cells, 16 elements and the rings of the radial solver they err by less than 4 %."""
    fineness = {Method.SURFACE: 32, Method.EDGES: 32, Method.RADIAL: OWN}.get(method, 16)
    case = PrecisionCase(contact, method, fineness, penalty=10.0 * (method is Method.PENALTY))
    assert 0 < case.solved.errors_of(case._solve_contact())[error] < 0.04


def test_a_measurement_starts_from_an_empty_cache(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", str(tmp_path))
    assert cached_array("stored", (1,), lambda: np.zeros(1)) == 0
    with cold_cache():
        assert cached_array("stored", (1,), lambda: np.ones(1)) == 1


def test_a_measurement_finds_nothing_in_memory() -> None:
    """What contacts have in common is made again, with its functions called."""
    asked = waves(0.01, 1.0, 1.0)
    with cold_cache():
        first = asked.even_transforms(2)
        assert asked.even_transforms(2) is first
    with cold_cache():
        assert asked.even_transforms(2) is not first
