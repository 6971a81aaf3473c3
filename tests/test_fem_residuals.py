"""What the residuals of the finite-element reference say about states that are wrong."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import MU, PRESS, push, scene
from fem_scenes import elements

from contact_scene.solver_errors import NotConverged
from fem_reference import Method, residuals, solve
from fem_reference.contact import increment
from semi_analytical.residuals import complementarity, friction_cone, penetration, slip_direction

WEIGHTS = np.array([0.1, 0.4, 0.5])
PRESSURE = np.array([2.0, 1.0, 0.0])


def test_right_state_leaves_nothing() -> None:
    gap = np.array([0.0, 0.0, 0.3])
    assert residuals.complementarity(PRESSURE, gap, WEIGHTS, 0.1) == 0
    assert residuals.penetration(gap, WEIGHTS, 0.1) == 0
    bound = MU * PRESSURE
    shear = np.array([[0.1, MU, 0.0], [0.0, 0.0, 0.0]])
    passed = np.array([[0.0, 0.2, 5.0], [0.0, 0.0, 0.0]])
    assert residuals.friction_cone(np.abs(shear[0]), bound) == 0
    assert residuals.slip_direction(shear, bound, passed, WEIGHTS, 1.0) == 0


@pytest.mark.parametrize("shear", [1.0, 0.5, 0.0, -0.5])
def test_slip_along_the_shear_or_below_the_limit_counts(shear: float) -> None:
    """1 + q/b for slip of unit size: 2 where slip and shear go together, 1 without shear."""
    q, passed = np.array([[shear], [0.0]]), np.array([[-1.0], [0.0]])
    found = residuals.slip_direction(q, np.ones(1), passed, np.ones(1), 1.0)
    assert found == pytest.approx(1 + shear)


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("what", ["pressure", "shear"])
def test_wrong_answer_of_a_solver_is_not_accepted(what: str, method: Method, monkeypatch) -> None:
    """The last check of an increment starts from its fields, whatever the solver says."""
    honest = increment.solve_coupled

    def wrong(*arguments):
        answer = honest(*arguments)
        return replace(answer, **{what: 1.001 * getattr(answer, what)})

    monkeypatch.setattr(increment, "solve_coupled", wrong)
    with pytest.raises(NotConverged, match="residual"):
        solve(scene(PRESS, push(0.5)), elements(), method)


# ---- Every residual sees its own defect, in the same measure on every mesh, and nothing els


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
