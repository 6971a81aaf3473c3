"""Tests of error norms, of fields and between rings, on fields whose error is known."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from verification.judging.field_errors import shear_error as shear_error_of_run
from verification.norms import relative_l1, relative_l2, shear_error
from verification.observed.ring_errors import between_rings, central_pressure
from verification.observed.ring_errors import relative_l1 as relative_l1_over_radius
from verification.observed.ring_errors import relative_l2 as relative_l2_over_radius
from verification.problems.problem import FRICTION


def test_error_norms_are_relative_to_the_exact_field() -> None:
    exact = np.array([[3.0, 0.0], [4.0, 0.0]])
    assert relative_l1(1.01 * exact, exact) == pytest.approx(0.01)
    assert relative_l2(1.01 * exact, exact) == pytest.approx(0.01)
    assert relative_l2(exact + np.array([[0, 5], [0, 0]]), exact) == pytest.approx(1.0)


def test_errors_between_rings_are_those_of_the_linear_traction() -> None:
    """A parabola r (1.1 - r) is above its chords by h²/6 in the mean, h²/√30 in the mean square."""

    def exact(r: np.ndarray) -> np.ndarray:
        return np.where(r <= 1.1, r * (1.1 - r), 0.0)

    side = 1 / 40
    radii = side * np.arange(45)
    increment: Any = SimpleNamespace(radii=radii, pressure=np.ones_like(radii))
    assert between_rings(increment, 1.0).max() == pytest.approx(1.1, abs=side)
    # ∫ r dr is 1.1²/2, ∫ r² (1.1 - r)² r dr is 1.1⁶/60
    l1 = relative_l1_over_radius(increment, exact(radii), exact, 1.0)
    assert l1 == pytest.approx(side**2 / 6, rel=0.02)
    l2 = relative_l2_over_radius(increment, exact(radii), exact, 1.0)
    assert l2 == pytest.approx(side**2 / np.sqrt(30) * np.sqrt(30 / 1.1**4), rel=0.02)


def test_an_error_of_half_the_friction_limit_is_half_on_rings() -> None:
    radii = np.arange(41) / 40
    pressure = np.sqrt(1 - radii**2)
    end = SimpleNamespace(
        radii=radii, pressure=pressure, shear_along_load=0.5 * FRICTION * pressure
    )
    none: Any = SimpleNamespace(ends=[SimpleNamespace(shear=np.zeros_like)], radius=1.0)
    found = shear_error_of_run(SimpleNamespace(steps=[end]), 0, none)
    assert found == pytest.approx(0.5, rel=1e-3)


def test_the_pressure_on_the_axis_is_the_vertex_of_a_parabola() -> None:
    x, y = np.meshgrid(*[0.1 * (np.arange(8) - 3.5)] * 2)
    mean = 3 - 2 * (x**2 + y**2)
    report = SimpleNamespace(cause=None)
    grid = SimpleNamespace(coordinates=lambda: (x, y))
    result = SimpleNamespace(grid=grid, steps=[SimpleNamespace(pressure=mean, edge_report=report)])
    assert central_pressure(result) == pytest.approx(3.0, rel=1e-12)


def test_shear_error_counts_the_transverse_component() -> None:
    exact = np.full((2, 2), 3.0)
    limit = np.full((2, 2), 10.0)
    shear = np.stack([exact + 3.0, exact * 0 + 4.0])
    assert shear_error(shear, exact, limit) == pytest.approx(0.5)
    assert shear_error(shear, np.stack([exact, 0 * exact]), limit) == pytest.approx(0.5)
