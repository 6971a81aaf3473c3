"""Into how many increments steps are cut, and whether that gives the accuracy asked for."""

import numpy as np
import pytest
from contact_scenes import PRESS, grid, push, scene, slide
from coupled_scenes import bulk, coated
from coupled_scenes import press as pressed
from coupled_scenes import scene as coupled_scene

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


def test_strong_friction_takes_more_increments_until_all_sticks():
    found = [
        counts(coupled_scene(PRESS, body=bulk(0.3), friction=mu))[0]
        for mu in (0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 5.0)
    ]
    assert found == sorted(found)
    assert found[-1] == 130


def test_a_load_that_goes_straight_between_alike_bodies_takes_one():
    assert counts(scene(PRESS, push(0.9), push(-0.9), slide(1.0))) == (1, 1, 1, 1)


def polygon(steps, x=0.6):
    angles = np.linspace(0, 2 * np.pi, steps + 1)
    return scene(PRESS, *(free(x * np.cos(t), x * np.sin(t)) for t in angles))


def test_a_load_that_goes_on_turning_takes_more_for_each_step():
    """Errors of its steps add up."""
    round_, once = counts(polygon(8)), counts(scene(PRESS, free(0.6), free(0.4243, 0.4243)))
    assert round_[2:] == round_[2:3] * 8
    assert round_[2] > 1.5 * once[2]


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
