"""One increment costs what its physics costs: effects that are off are never computed."""

import numpy as np
import pytest
from contact_scenes import LOAD, PRESS, RIGID_BALL, A, grid, push, scene

from semi_analytical import SurfaceGrid, plan, pressing, solve
from semi_analytical.box import box_around
from semi_analytical.history import march
from semi_analytical.model import ContactModel
from semi_analytical.normal import solve_normal
from semi_analytical.operator.operator import DisplacementOperator

TOLERANCE = 1e-8
PRODUCTS = "normal", "tangential", "normal_by_shear", "tangential_by_pressure", "together"


@pytest.fixture
def calls(monkeypatch):
    """Names of the products, in the order in which they are called."""
    made = []

    def spy(name):
        plain = getattr(DisplacementOperator, name)

        def counted(self, field):
            made.append(name)
            return plain(self, field)

        monkeypatch.setattr(DisplacementOperator, name, counted)

    for name in PRODUCTS:
        spy(name)
    return made


@pytest.mark.parametrize(
    ("loading", "more"),
    [
        ((PRESS,), {"friction": None}),
        ((PRESS,), {"friction": None, "indenter": RIGID_BALL}),
        ((PRESS, {"normal_force": 0.5 * LOAD}), {}),
        ((PRESS, push(0)), {}),
    ],
    ids=["frictionless", "frictionless and dissimilar", "only pressed", "no push"],
)
def test_without_a_push_shear_costs_nothing(loading, more, calls):
    for increment in solve(scene(*loading, **more), grid(), TOLERANCE).increments:
        assert increment.shear is None
        assert increment.slip is None
        assert increment.in_stick is None
        assert increment.dissipated_energy is None
        assert increment.residuals.slip_direction is None
    assert set(calls) == {"normal"}


def test_shear_costs_nothing_until_the_first_push(calls):
    seen = []
    solve(scene(PRESS, push(0.5)), grid(), TOLERANCE, lambda _: seen.append(set(calls)))
    assert seen[0] == {"normal"}


def test_pressure_is_not_solved_again_where_the_normal_load_is_held(calls):
    def after(increment):
        if increment.step == 1:
            calls.clear()

    solve(scene(PRESS, push(0.5), push(-0.5)), grid(), TOLERANCE, after)
    assert set(calls) == {"tangential"}


@pytest.mark.parametrize("cells", [64, 128])
def test_pressure_takes_few_iterations_and_hardly_more_convolutions(cells, calls, monkeypatch):
    iterations = []

    def spied(*arguments, **more):
        solution = solve_normal(*arguments, **more)
        iterations.append(solution.iterations)
        return solution

    monkeypatch.setattr(pressing, "solve_normal", spied)
    solve(scene(PRESS, friction=None), SurfaceGrid((cells, cells), (3 * A, 3 * A)), TOLERANCE)
    assert sum(iterations) <= 10
    # Besides one per iteration: the start on each grid, the check on the window, admissible parts
    # of three steps.
    assert len(calls) <= sum(iterations) + len(iterations) + 4


def test_convolutions_count_what_was_convolved(calls):
    result = solve(scene(PRESS, push(0.5)), grid(), TOLERANCE)
    for increment, kind, price in [
        (result.increments[0], "normal", 1),
        (result.increments[1], "tangential", 2),
    ]:
        assert increment.convolutions == price * calls.count(kind)


def test_a_growing_contact_does_not_gather_operators():
    problem = scene({**PRESS, **push(0.5), "increments": 8})
    decided = plan(problem)
    model = ContactModel.of(problem, grid(128), decided.symmetry)
    boxes = set()
    for increment in march(model, decided, TOLERANCE):
        boxes.add(box_around(increment.in_contact, 4).shape)
        assert len(model._operators) <= 2
    assert len(boxes) > 3


def test_fields_are_reported_on_the_whole_window():
    increment = solve(scene(PRESS, push(0.5)), SurfaceGrid((48, 40), (4 * A, 3 * A)), TOLERANCE)
    end = increment.steps[-1]
    assert end.pressure.shape == end.gap.shape == end.in_contact.shape == (48, 40)
    assert end.shear.shape == end.slip.shape == (2, 48, 40)
    assert np.all(end.gap[~end.in_contact] > -1e-8 * end.approach)
