"""Tests of reference results of other codes: extrapolation in the penalty, and uncertainty."""

import numpy as np
import pytest

from verification.cases.cross_check import Recorded

RUNS = ((16, 1000.0), (32, 1000.0), (32, 500.0))  # elements, stiffness


def synthetic(limit, per_stiffness, per_element):
    """Three runs with the force limit + per_stiffness / k + per_element / n, and the pressure that
    less the radius."""
    runs = []
    for elements, stiffness in RUNS:
        value = limit + per_stiffness / stiffness + per_element / elements
        radii = [n / elements for n in range(elements)]
        run = {"elements": elements, "stiffness": stiffness, "normal_force": value}
        runs.append({**run, "radii": radii, "pressure": [value - r for r in radii]})
    return {"runs": runs}


def test_extrapolation_removes_the_penalty():
    record = Recorded(synthetic(2.0, 5.0, 0.0))
    assert record.normal_force.value == pytest.approx(2.0, rel=1e-14)
    radii, values, _ = record.profile("pressure", 0.1, 0.5)
    assert values == pytest.approx(2.0 - radii, rel=1e-14)


def test_uncertainty_covers_what_the_mesh_leaves():
    record = Recorded(synthetic(2.0, 5.0, 0.01))
    value, uncertainty = record.normal_force
    profile = record.profile("pressure", 0.1, 0.5)
    assert abs(value - 2) <= uncertainty * (1 + 1e-9)
    assert np.max(np.abs(profile.values - (2 - profile.radii))) <= profile.uncertainty * (1 + 1e-9)
