"""What the residuals of the finite-element reference say about states that are wrong."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import MU, PRESS, push, scene
from fem_scenes import elements

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
