"""Into how many increments steps are cut, and whether that gives the accuracy asked for."""

import numpy as np
import pytest
from contact_scenes import PRESS, A, grid, push, scene, slide
from coupled_scenes import bulk, coated
from coupled_scenes import press as pressed
from coupled_scenes import scene as coupled_scene

from contact_scene import RIGID, Cone, Ellipsoid, FlatPunch
from semi_analytical import Result, SurfaceGrid, plan, solve

TOLERANCE = 1e-7
DEFAULT = 1e-2


def shear_difference(described, one, other) -> float:
    """Σ|q - q_other| / Σµp of the other [1]."""
    limit = np.sum(described.friction.limit(other.pressure))
    return np.sum(np.hypot(*(one.shear - other.shear))) / limit


def counts(described, accuracy=DEFAULT):
    return plan(described, accuracy).increments


def free(x, y=0.0, friction=0.1, **more):
    """A push in parts of the friction limit that leaves its increments to the solver."""
    limit = friction * PRESS["normal_force"]
    return {"tangential_force": (x * limit, y * limit), **more}


WEAK = coupled_scene(PRESS, body=bulk(0.3))
STRONG = coupled_scene(PRESS, body=bulk(0.3), friction=0.3)
PUSHED = coupled_scene(PRESS, free(0.6), body=bulk(0.3))
COATED = coupled_scene(PRESS, free(0.9), body=coated(2.0))
TURNING = scene(PRESS, push(0.5), push(0, 0.5))
OBLIQUE = scene({**PRESS, **push(0.3)})


def test_explicit_increments_win_over_every_law():
    assert counts(coupled_scene(pressed(increments=2), free(0.6, increments=3))) == (2, 3)
    assert counts(scene(PRESS, push(0.5, increments=7))) == (1, 7)


@pytest.mark.parametrize("described", [WEAK, STRONG, PUSHED, COATED, TURNING, OBLIQUE])
def test_more_accuracy_takes_more_increments(described):
    fine, coarse = counts(described, 1e-3), counts(described, 1e-1)
    assert all(f >= c for f, c in zip(fine, coarse, strict=True))
    assert sum(fine) > sum(coarse)


@pytest.mark.parametrize("described", [WEAK, STRONG, PUSHED, COATED, TURNING, OBLIQUE])
def test_every_count_has_a_reason(described):
    assert all(step.why for step in plan(described).path)


def test_strong_friction_takes_more_increments_until_all_sticks():
    found = [
        counts(coupled_scene(PRESS, body=bulk(0.3), friction=mu))[0]
        for mu in (0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 5.0)
    ]
    assert found == sorted(found)
    assert found[-1] == 130


def test_a_load_that_goes_straight_between_alike_bodies_takes_one():
    assert counts(scene(PRESS, push(0.9), push(-0.9), slide(1.0))) == (1, 1, 1, 1)


def test_many_small_steps_take_about_as_many_increments_as_one_large():
    one = counts(coupled_scene(PRESS, free(0.9)))[1]
    many = counts(coupled_scene(PRESS, *(free(x) for x in np.linspace(0.09, 0.9, 10))))[1:]
    assert one / 2 <= sum(many) <= 2 * one


def polygon(steps, x=0.6):
    angles = np.linspace(0, 2 * np.pi, steps + 1)
    return scene(PRESS, *(free(x * np.cos(t), x * np.sin(t)) for t in angles))


def test_a_load_that_goes_on_turning_takes_more_for_each_step():
    """Errors of its steps add up."""
    round_, once = counts(polygon(8)), counts(scene(PRESS, free(0.6), free(0.4243, 0.4243)))
    assert round_[2:] == round_[2:3] * 8
    assert round_[2] > 1.5 * once[2]


def test_below_a_flat_punch_one_increment_is_exact():
    punch = FlatPunch(radius=A, material="rigid")
    described = coupled_scene(PRESS, body=bulk(0.3), indenter=punch)
    assert counts(described) == (1,)
    ends = [end_of(described, grid(contacts=1.2), n).shear for n in (1, 4)]
    limit = 0.1 * np.sum(end_of(described, grid(contacts=1.2), 1).pressure)
    assert np.sum(np.hypot(*(ends[0] - ends[1]))) < 1e-5 * limit


def test_pressing_harder_on_what_sticks_takes_one():
    described = scene(PRESS, push(0.5), {"normal_force": 2000.0})
    assert counts(described) == (1, 1, 1)
    window = grid(contacts=1.5)
    one, four = (end_of(described, window, n) for n in (1, 4))
    assert shear_difference(described, one, four) < 1e-6
    assert counts(scene(PRESS, push(0.5), {"normal_force": 800.0}))[2] > 1


def end_of(described, window, last):
    """The end of the history with so many increments in its last step."""
    cut = plan(described)
    cut = cut.cut_into((*cut.increments[:-1], last))
    return solve(described, window, TOLERANCE, plan=cut).steps[-1]


def path_error(described, cells: int | SurfaceGrid = 32, accuracy: float = DEFAULT) -> float:
    """Σ|q - q_exact| / Σµp at the end, from four times the increments, first order taken off."""
    planned = plan(described, accuracy)
    window = cells
    if isinstance(cells, int):
        window = grid(cells, contacts=1.15 if described.body.layers == () else 1.3)
    finer = planned.cut_into([(4 if s.path_matters else 1) * s.count for s in planned.path])
    found: list[Result] = [
        solve(described, window, TOLERANCE, plan=each) for each in (planned, finer)
    ]
    ends = [result.steps[-1] for result in found]
    return shear_difference(described, *ends) / 0.75


@pytest.mark.parametrize("described", [WEAK, PUSHED, TURNING], ids=["pressed", "pushed", "turning"])
def test_default_accuracy_is_met(described):
    assert path_error(described) <= DEFAULT


OTHERS = {
    "cone": (Cone(slope_angle=0.02, material=RIGID), 100.0, (1.0e-3, 1.0e-3)),
    "ellipsoid": (Ellipsoid(radii=(0.018, 0.054), material=RIGID), 1000.0, (1.15e-3, 2.4e-3)),
}


@pytest.mark.parametrize("name", OTHERS)
def test_default_accuracy_is_met_below_other_shapes(name):
    indenter, load, window = OTHERS[name]
    described = coupled_scene({"normal_force": load}, body=bulk(0.3), indenter=indenter)
    cells = tuple(round(40 * side / window[0]) for side in window)
    assert path_error(described, SurfaceGrid(cells, window)) <= DEFAULT


@pytest.mark.slow
def test_accuracy_is_met_at_the_end_of_three_turns():
    once = polygon(8)
    again = once.loading[2:]
    described = once.model_copy(update={"loading": [*once.loading, *again, *again]})
    assert path_error(described, 16, 8 * DEFAULT) <= 8 * DEFAULT


MANY = {
    **{f"nu {nu}, mu {mu}": (bulk(nu), mu) for nu in (0.0, 0.3, 0.45) for mu in (0.05, 0.2, 0.5)},
    **{
        f"E1/E2 {ratio}, mu {mu}": (coated(ratio), mu) for ratio in (0.5, 2, 4) for mu in (0.1, 0.3)
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("push_to", [0.0, 0.4, 0.8])
@pytest.mark.parametrize("name", MANY)
def test_default_accuracy_is_met_over_bodies_and_friction(name, push_to):
    body, mu = MANY[name]
    more = [free(push_to, friction=mu)] if push_to else []
    assert path_error(coupled_scene(PRESS, *more, body=body, friction=mu), 48) <= DEFAULT
