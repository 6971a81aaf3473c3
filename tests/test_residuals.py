"""Every residual sees its own defect, in the same measure on every mesh, and nothing else."""

import numpy as np
import pytest

from semi_analytical.residuals import (
    complementarity,
    friction_cone,
    penetration,
    slip_direction,
)

BOUND = np.array([[2.0, 1.0], [0.0, 1.0]])


def along(angle, length=BOUND):
    return np.stack([length * np.cos(angle), length * np.sin(angle)])


def test_complementarity_is_the_gap_under_pressure():
    p, g = np.array([[1.0, 3.0], [0.0, 0.0]]), np.array([[0.2, -0.1], [5.0, np.inf]])
    assert complementarity(p, g, 0.5) == pytest.approx((0.2 + 0.3) / (0.5 * 4))


def test_penetration_is_the_deepest_overlap():
    assert penetration(np.array([0.3, -0.02, np.inf]), 0.5) == pytest.approx(0.04)
    assert penetration(np.array([0.3, 0.0]), 0.5) == 0


def test_friction_cone_is_the_largest_excess():
    assert friction_cone(along(0.3), BOUND) == pytest.approx(0, abs=1e-15)
    excess = np.array([[0, 0.1], [0, 0]])
    assert friction_cone(along(0.3, BOUND + excess), BOUND) == pytest.approx(0.05)


@pytest.mark.parametrize("angle", [0.0, 0.1, np.pi / 2, np.pi])
def test_slip_at_an_angle_to_the_shear_is_seen(angle):
    """1 - cos of the angle: the dissipation that is missing."""
    u = np.ones((2, 2, 2))
    found = slip_direction(along(0.3), BOUND, along(0.3 + angle, np.ones((2, 2))), u)
    assert found == pytest.approx(1 - np.cos(angle), abs=1e-12)


def test_slip_that_nearly_vanishes_is_judged_by_the_displacement():
    noise = along(2.0, np.full((2, 2), 1e-15))
    assert slip_direction(along(0.3), BOUND, noise, np.ones((2, 2, 2))) < 1e-11
