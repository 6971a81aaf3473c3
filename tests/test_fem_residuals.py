"""What the residuals of the finite-element reference say about states that are wrong."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import MU, PRESS, RIGID_BALL, push, scene
from fem_scenes import elements, solved

from contact_scene.solver_errors import NotConverged
from fem_reference import Method, residuals, solve
from fem_reference.contact import increment

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


def test_pressure_across_a_gap_counts_with_both() -> None:
    gap = np.array([0.0, 0.02, 0.3])
    assert residuals.complementarity(PRESSURE, gap, WEIGHTS, 0.1) == pytest.approx(0.02 / 0.06)


def test_overlap_counts_as_a_mean_over_the_hat() -> None:
    gap = np.array([-0.001, 0.0, -0.01])
    assert residuals.penetration(gap, WEIGHTS, 0.1) == pytest.approx(0.02 / 0.1)


def test_shear_beyond_the_limit_counts() -> None:
    assert residuals.friction_cone(np.array([0.1, 0.15]), np.array([0.2, 0.1])) == pytest.approx(
        0.25
    )


@pytest.mark.parametrize("shear", [1.0, 0.5, 0.0, -0.5])
def test_slip_along_the_shear_or_below_the_limit_counts(shear: float) -> None:
    """1 + q/b for slip of unit size: 2 where slip and shear go together, 1 without shear."""
    q, passed = np.array([[shear], [0.0]]), np.array([[-1.0], [0.0]])
    found = residuals.slip_direction(q, np.ones(1), passed, np.ones(1), 1.0)
    assert found == pytest.approx(1 + shear)


def test_nothing_that_moves_has_no_wrong_direction() -> None:
    nothing = np.zeros((2, 3))
    assert residuals.slip_direction(nothing, PRESSURE, nothing, WEIGHTS, 0.0) == 0


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


def test_equilibrium_is_measured_where_it_is_asked_for() -> None:
    by_force = solved(scene(PRESS, push(0.5))).increments[-1].residuals
    assert by_force.tangential_equilibrium is not None
    assert by_force.torque_equilibrium is None
    twisted = solved(scene(PRESS, {"torque": 1e-3})).increments[-1].residuals
    assert twisted.tangential_equilibrium is None
    assert twisted.torque_equilibrium is not None
    radial = solved(scene({**PRESS, "increments": 1}, indenter=RIGID_BALL)).increments[-1].residuals
    assert radial.tangential_equilibrium is None
    assert radial.friction_cone is not None
