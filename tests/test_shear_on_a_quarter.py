"""A quarter of the window tells the shear of loads along one axis."""

import itertools
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    INDENTERS,
    LOAD,
    MU,
    PRESS,
    RADIUS,
    RIGID_BALL,
    A,
    bump,
    grid,
    push,
    scene,
    slide,
    steel,
)
from mirrored_runs import (
    Leaf,
    assert_same_shear,
    even_map,
    on_part_and_window,
    pickled,
    refuse,
    why,
    window_solves,
)

from contact_scene import FrictionMap, HeightMap, Layer
from contact_scene.solver_errors import GrossSliding
from contact_scene.standing import Standing
from semi_analytical import SurfaceGrid, all_effects, one_way, plan, solve
from semi_analytical.history import marked
from semi_analytical.mirrored_shear import MirroredTangentialOperator
from semi_analytical.model import ContactModel
from semi_analytical.operator import TangentialOperator
from semi_analytical.padded_transform import PaddedTransform
from semi_analytical.part import WHOLE, Part
from semi_analytical.periodic_inverse import PeriodicInverse

# Both go the same way to it, by the same steps.
TOLERANCE, SAME = 1e-10, 1e-10


COATED = Layer(thickness=0.5 * A, material=steel(young_modulus=840e9))
LOOP = push(0.8, increments=3), push(-0.8, increments=2), push(0.8)
HALF = {"normal_force": 0.5 * LOAD, "increments": 3}


def coated(*loading):
    """Both bodies, alike."""
    described = scene(*loading)
    body = described.body.model_copy(update={"layers": (COATED,)})
    indenter = described.indenter.model_copy(update={"layers": (COATED,)})
    return described.model_copy(update={"body": body, "indenter": indenter})


SCENES = {
    "loop": (scene(PRESS, *LOOP), (3, 3.5)),
    "along y": (scene(PRESS, push(0, 0.8), push(0, -0.7)), (3, 3.5)),
    "shifted until it slides": (scene(PRESS, slide(0.5), slide(20), slide(-1)), (3, 3)),
    "shifted along y": (scene(PRESS, slide(0, -0.5), slide(0, 0.3)), (3, 4)),
    "force takes over": (scene(PRESS, slide(0.5), push(-0.3), slide(0.2)), (3, 3)),
    "unloading": (scene(PRESS, push(0.3), HALF, push(0.1)), (3, 3)),
    "pressed harder": (scene(HALF, push(0.3), {**PRESS, "increments": 3}, push(-0.2)), (3, 3)),
    "both at once": (scene({**PRESS, **push(0.5), "increments": 4}), (3, 3)),
    "to the limit": (scene(PRESS, push(0.9), push(1.0)), (3, 3)),
    "nearly": (scene(PRESS, push(0.999)), (3, 3)),
    "by approach": (scene({"approach": 0.7 * APPROACH}, push(0.3), slide(0)), (3, 3)),
    "coated": (coated(PRESS, push(0.7), push(-0.7)), (4, 4)),
    "incompressible": (
        scene(PRESS, push(0.5), indenter=RIGID_BALL, body=steel(poisson_ratio=0.5)),
        (3, 3),
    ),
    "ellipsoid": (scene(PRESS, *LOOP, indenter=INDENTERS["ellipsoid"]), (3, 6)),
    "cone": (scene(PRESS, push(0.6), indenter=INDENTERS["cone"]), (5, 5)),
    "flat punch": (scene(PRESS, push(0.6), indenter=INDENTERS["flat punch"]), (3, 3)),
    "height map": (
        scene(
            PRESS,
            push(0.6),
            indenter=HeightMap(file=bump(64, 4 * A / 64), spacing=4 * A / 64, material=steel()),
        ),
        (3.5, 3),
    ),
    "friction that waves": (
        scene(PRESS, push(0.6), push(-0.5), friction=even_map()),
        (3, 3.5),
    ),
}


def assert_told(described, on):
    runs = on_part_and_window(described, on, TOLERANCE)
    assert_same_shear(*runs, SAME, steps=4)


@pytest.mark.parametrize("cells", [(32, 32), (26, 40)], ids=str)
@pytest.mark.parametrize(("described", "sides"), SCENES.values(), ids=SCENES)
def test_a_quarter_tells_the_answer_of_the_window(described, sides, cells):
    assert_told(described, SurfaceGrid(cells, (sides[0] * A, sides[1] * A)))


def drawn(seed):
    """A scene that a quarter tells, and cells and sides of its window."""
    rng = np.random.default_rng(seed)
    name = rng.choice(["paraboloid", "ellipsoid", "cone", "sphere"])
    axis, steps = rng.integers(2), [PRESS]
    for _ in range(rng.integers(1, 5)):
        along = np.zeros(2)
        along[axis] = rng.uniform(-1.0, 1.0)
        load = [push, slide][rng.integers(2)](*along)
        if rng.random() < 0.4:
            load["normal_force"] = rng.uniform(1.0, 1.5) * LOAD
        steps.append(dict(load, increments=int(rng.integers(1, 4))))
    friction = even_map(order=rng.uniform(0, 1)) if rng.random() < 0.4 else MU
    described = scene(*steps, friction=friction, indenter=INDENTERS[name])
    if rng.random() < 0.3:
        body = described.body.model_copy(update={"layers": (COATED,)})
        indenter = described.indenter.model_copy(update={"layers": (COATED,)})
        described = described.model_copy(update={"body": body, "indenter": indenter})
    sides = rng.uniform(3.2, 3.8, 2) * A * (np.array([1.0, 2.0]) if name == "ellipsoid" else 1.4)
    if isinstance(friction, FrictionMap):
        sides = np.minimum(sides, 3.9 * A)
    return described, SurfaceGrid(tuple(int(n) for n in 2 * rng.integers(9, 20, 2)), tuple(sides))


@pytest.mark.parametrize("seed", range(20))
def test_a_quarter_tells_what_is_drawn(seed):
    """As far as the window goes: what it cannot solve the quarter cannot, either."""
    described, on = drawn(seed)
    if window_solves(described, on, TOLERANCE):
        assert_told(described, on)


def _uneven(**more):
    return scene(PRESS, push(0.5), friction=FrictionMap(**more))


NOT_TOLD = {
    "oblique": (scene(PRESS, push(0.3, 0.2)), "push along the same axis"),
    "x, then y": (scene(PRESS, push(0.3), push(0, 0.2)), "push along the same axis"),
    "twisted": (scene(PRESS, {**push(0.3), "twist": 1e-4}), "twists"),
    "uneven friction": (
        _uneven(map=even_map().map.values * np.linspace(1, 1.1, 40), spacing=0.1 * A),
        "friction is not even",
    ),
    "friction off the middle": (
        _uneven(map=even_map().map.values, spacing=0.1 * A, origin=(0.05 * A, 0.0)),
        "friction is not even",
    ),
}


@pytest.mark.parametrize(("described", "because"), NOT_TOLD.values(), ids=NOT_TOLD)
def test_the_plan_says_why_a_quarter_does_not_tell_shear(described, because):
    decided = plan(described)
    assert decided.quarter
    assert decided.told == WHOLE
    assert because in why(decided)


def test_the_plan_says_that_a_quarter_tells_shear():
    for axis in (0, 1):
        decided = plan(scene(PRESS, push(*0.9 * np.eye(2)[axis]), push(*-0.5 * np.eye(2)[axis])))
        assert decided.told == Part((True, True), along=axis)
        assert "tells pressures and shear" in why(decided)
    assert all_effects(decided).told == WHOLE
    assert one_way(decided).told == WHOLE
    assert plan(scene(PRESS, friction=None)).told == WHOLE
    uneven = scene(PRESS, push(0.5), indenter=Leaf(radii=(RADIUS, RADIUS), material=steel()))
    assert plan(uneven).told == WHOLE


@pytest.mark.parametrize(
    ("described", "cells"),
    [
        (scene(PRESS, push(0.3)), (33, 32)),
        (scene(PRESS, push(0.3, 0.2)), (32, 32)),
        (scene({**PRESS, "tilt": (1e-4, 0.0)}, push(0.3)), (32, 32)),
    ],
    ids=["cells on a plane", "oblique", "tilt"],
)
def test_what_is_not_even_is_sheared_on_the_window(described, cells, monkeypatch):
    refuse(monkeypatch, MirroredTangentialOperator)
    solve(described, SurfaceGrid(cells, (3.5 * A, 3.5 * A)), 1e-8)


@pytest.mark.parametrize("cells", [(32, 32), (64, 40)], ids=str)
def test_nothing_is_convolved_on_the_window_where_a_quarter_is_enough(cells, monkeypatch):
    """Neither by the operators on the window nor by their transform."""
    refuse(monkeypatch, TangentialOperator, PaddedTransform, PeriodicInverse)
    solve(scene(PRESS, *LOOP), SurfaceGrid(cells, (3 * A, 3 * A)), 1e-8)


@pytest.mark.parametrize("told", [Part((True, True), along=0), WHOLE], ids=["quarter", "window"])
def test_what_friction_does_not_carry_is_refused_alike(told):
    described = scene(PRESS, push(1.3), friction=even_map())
    with pytest.raises(GrossSliding, match="force 130 N exceeds the friction limit"):
        solve(described, grid(), 1e-8, plan=replace(plan(described), told=told))


def test_a_history_told_by_a_quarter_goes_on_as_it_was():
    described, on = scene(PRESS, *LOOP), grid(32)
    decided = plan(described)
    model = partial(ContactModel.of, described, on, even=decided.quarter, told=decided.told)
    told_ = list(marked(model(), decided, TOLERANCE))
    _, mark = told_[3]
    since = Standing(tuple(increment for increment, _ in told_[:4]), pickled(mark), on)
    later = list(marked(model(), decided, TOLERANCE, since))
    assert mark.state.sheared.shear.shape == (2, 16, 16)
    for (increment, _), (again, _) in zip(told_[4:], later, strict=True):
        for field in ("shear", "slip", "slip_before", "dissipation_before", "in_stick"):
            np.testing.assert_array_equal(getattr(increment, field), getattr(again, field))
        assert increment.dissipated_energy == again.dissipated_energy


def test_what_was_slipped_before_an_increment_is_kept_once():
    """A history with its fields in a file has each there once."""
    increments = solve(scene(PRESS, *LOOP), grid(32), TOLERANCE).increments
    for before, after in itertools.pairwise(increments[1:]):
        assert after.slip_before is before.slip
        assert after.dissipation_before is before.dissipation
