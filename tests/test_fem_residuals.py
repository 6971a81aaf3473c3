"""Tests of the residuals of the finite-element solver: wrong states have large residuals."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import PRESS, push, scene
from fem_scenes import elements

from contact_scene.quantities.residuals import (
    worst,
)
from contact_scene.solver_errors import NotConverged
from contact_solver.residuals import complementarity, friction_cone, penetration, slip_direction
from fem_reference import Method, solve
from fem_reference.contact import increment


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("what", ["pressure", "shear"])
def test_wrong_answer_of_a_solver_is_not_accepted(what, method, monkeypatch):
    """The last check of an increment starts from its fields, whatever the solver says."""
    honest = increment.solve_points

    def wrong(*arguments):
        answer = honest(*arguments)
        return replace(answer, **{what: 1.001 * getattr(answer, what)})

    monkeypatch.setattr(increment, "solve_points", wrong)
    with pytest.raises(NotConverged, match="residual"):
        solve(scene(PRESS, push(0.5)), elements(), method)


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
@pytest.mark.parametrize("part", [1.0, 0.5, 0.0])
def test_slip_at_an_angle_to_the_shear_or_below_the_limit_is_seen(angle, part):
    """1 - q/b cos of the angle: the dissipation that is missing."""
    u = np.ones((2, 2, 2))
    found = slip_direction(part * along(0.3), BOUND, along(0.3 + angle, np.ones((2, 2))), u)
    assert found == pytest.approx(1 - part * np.cos(angle), abs=1e-12)


@pytest.mark.parametrize("place", range(3))
def test_the_worst_is_the_one_that_is_not_a_number_wherever_it_stands(place):
    measures = [1e-9, 2e-9, None]
    assert worst(*measures) == 2e-9
    measures.insert(place, float("nan"))
    assert np.isnan(worst(*measures))


FIELD = np.ones((2, 2, 2))
MEASURES = {
    "complementarity": (complementarity, (BOUND + 1, BOUND, 0.5)),
    "penetration": (penetration, (BOUND, 0.5)),
    "friction cone": (friction_cone, (FIELD, BOUND)),
    "slip direction": (slip_direction, (FIELD, BOUND + 1, FIELD, FIELD)),
}


@pytest.mark.parametrize("measure", MEASURES)
def test_a_field_that_is_not_a_number_somewhere_has_no_measure(measure):
    of, given = MEASURES[measure]
    assert np.isfinite(of(*given))
    for number, argument in enumerate(given):
        if not isinstance(argument, np.ndarray):
            continue
        for place in np.ndindex(argument.shape):
            ill = argument.astype(float)
            ill[place] = np.nan
            assert np.isnan(of(*given[:number], ill, *given[number + 1 :])), (number, place)
