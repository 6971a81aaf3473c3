"""Half of the window tells bodies that couple pushed along an axis, a quarter pressed ones."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from contact_scenes import APPROACH, INDENTERS, LOAD, MU, A, grid, slide
from coupled_scenes import bulk, coated, press, push, scene
from mirrored_runs import (
    assert_same_pressures,
    assert_same_shear,
    even_map,
    on_part_and_window,
    pickled,
    refuse,
    why,
    window_solves,
)

from contact_scene import RIGID, IsotropicMaterial, Paraboloid
from contact_scene.standing import Standing
from contact_scene.summary import ContactStatus
from semi_analytical import SurfaceGrid, all_effects, one_way, plan, solve
from semi_analytical.coupled_operator import CoupledOperator
from semi_analytical.history import marked
from semi_analytical.mirrored_coupling import MirroredCoupledOperator
from semi_analytical.model import ContactModel
from semi_analytical.operator import CouplingOperator, NormalOperator, TangentialOperator
from semi_analytical.padded_transform import PaddedTransform
from semi_analytical.part import QUARTER, WHOLE, Part
from semi_analytical.periodic_inverse import PeriodicInverse

# Both go the same way to it; what is rounded in single precision they do not round alike.
TOLERANCE, SAME = 1e-11, 1e-10
X, Y = Part((False, True)), Part((True, False))
LOOP = push(0.8, increments=3), push(-0.8), push(0.3)
RUBBER = IsotropicMaterial(young_modulus=40e9, poisson_ratio=0.45)


def slid(x, y=0.0):
    """A shift in two increments."""
    return slide(x, y, increments=2)


def rigid(name):
    return INDENTERS[name].model_copy(update={"material": RIGID})


SCENES = {
    "pressed": (scene(press(increments=4)), QUARTER),
    "pressed and let go": (scene(press(), press(0.2), press(0.9)), QUARTER),
    "loop": (scene(press(), *LOOP), X),
    "along y": (scene(press(), push(0, 0.8), push(0, -0.7)), Y),
    "pushed first of all": (scene(press(0.5, **push(0.4)), press(1.0, **push(0.2))), X),
    "pushed while let go": (scene(press(), push(0.2), press(0.4), push(-0.1)), X),
    "to the limit": (scene(press(), push(0.9), push(1.0)), X),
    "nearly": (scene(press(), push(0.999, increments=4)), X),
    "shifted until it slides": (scene(press(), slid(0.5), slid(20), slid(-1)), X),
    "shifted along y": (scene(press(), slid(0, -0.5), slid(0, 0.3)), Y),
    "force takes over": (scene(press(), slid(0.5), push(-0.3), slid(0.2)), X),
    "by approach": (scene({"approach": 0.7 * APPROACH, "increments": 2}, slid(0.3)), X),
    "strong friction": (scene(press(), push(0.7, friction=1.0), friction=1.0), X),
    "hard film": (scene(press(), push(0.7), body=coated(4.0, 0.3)), X),
    "soft film": (scene(press(), push(0.7), body=coated(0.25, 0.7)), X),
    "bulk": (scene(press(), *LOOP, body=bulk(0.0)), X),
    "two bodies": (
        scene(
            press(),
            push(-0.6),
            body=bulk(0.2),
            indenter=Paraboloid(radius=0.018, material=RUBBER),
        ),
        X,
    ),
    "ellipsoid": (scene(press(), push(0, 0.8), indenter=rigid("ellipsoid")), Y),
    "cone": (scene(press(), push(0.6), indenter=rigid("cone")), X),
    "flat punch": (scene(press(), push(0.6), indenter=rigid("flat punch")), X),
    "friction that waves": (scene(press(), push(0.5), friction=even_map()), X),
}
SIDES = {"two bodies": (6, 6), "ellipsoid": (3.5, 8), "cone": (5, 5), "soft film": (4, 4)}


def assert_told(described, on):
    runs = on_part_and_window(described, on, TOLERANCE)
    assert_same_pressures(*runs, SAME)
    # An increment that just misses the tolerance is gone over again.
    assert_same_shear(*runs, SAME, steps=20)
    return runs


@pytest.mark.parametrize("cells", [(32, 32), (26, 40)], ids=str)
@pytest.mark.parametrize("name", SCENES)
def test_a_part_tells_the_answer_of_the_window(name, cells):
    described, part = SCENES[name]
    assert plan(described).told == part
    x, y = SIDES.get(name, (3, 3.3))
    assert_told(described, SurfaceGrid(cells, (x * A, y * A)))


def drawn(seed):
    """A scene that a part tells, and cells and sides of its window."""
    rng = np.random.default_rng(seed)
    mu = float(rng.choice([0.05, MU, 0.3, 0.6]))
    name = rng.choice(["paraboloid", "ellipsoid", "cone", "sphere", "flat punch"])
    film = coated(float(rng.choice([0.25, 0.5, 2.0, 4.0])), rng.uniform(0.2, 1.5))
    body = film if rng.random() < 0.6 else bulk(rng.uniform(0, 0.4))
    axis, steps = rng.integers(2), [press(increments=int(rng.integers(1, 4)))]
    for _ in range(rng.integers(0, 4)):
        along = np.zeros(2)
        along[axis] = rng.uniform(-0.95, 0.95)
        forced = rng.random() < 0.5
        load = push(*along, friction=mu) if forced else slide(*rng.choice([1, 3, 30]) * mu * along)
        if rng.random() < 0.4:
            load["normal_force"] = rng.uniform(1.0 if forced else 0.3, 1.5) * LOAD
        steps.append(dict(load, increments=int(rng.integers(1, 4))))
    friction = even_map(order=rng.uniform(0, 1)) if rng.random() < 0.2 else mu
    described = scene(*steps, body=body, indenter=rigid(name), friction=friction)
    sides = rng.uniform(3.2, 3.8, 2) * A * (np.array([1.0, 2.0]) if name == "ellipsoid" else 1.4)
    if described.friction.varying is not None:
        sides = np.minimum(sides, 3.9 * A)
    return described, SurfaceGrid(tuple(int(n) for n in 2 * rng.integers(9, 20, 2)), tuple(sides))


@pytest.mark.parametrize("seed", range(64))
def test_a_part_tells_what_is_drawn(seed):
    """As far as the window goes: what it cannot solve the part cannot, either."""
    described, on = drawn(seed)
    if window_solves(described, on, TOLERANCE):
        assert_told(described, on)


def test_the_part_is_left_by_what_its_planes_do_not_mirror():
    """The component of shear across a plane is odd about it, and no shift leads across."""
    end = solve(scene(press(), push(0, 0.6)), grid(), 1e-8).increments[-1]
    q_x, q_y = end.shear
    np.testing.assert_array_equal(q_x, 0.0 - q_x[::-1])
    np.testing.assert_array_equal(q_y, q_y[::-1])
    np.testing.assert_array_equal(end.pressure, end.pressure[::-1])
    assert np.max(np.abs(q_x)) > 0.01 * np.max(q_y)
    assert np.max(np.abs(q_y - q_y[:, ::-1])) > 0.01 * np.max(q_y)
    assert end.tangential_shift[0] == 0.0
    assert end.tangential_force[0] == 0.0


NOT_TOLD = {
    "oblique": (scene(press(), push(0.3, 0.2)), "push along the same axis"),
    "x, then y": (scene(press(), push(0.3), push(0, 0.2)), "push along the same axis"),
    "twisted": (scene(press(), push(0.3, twist=1e-4)), "twists"),
    "uneven friction": (
        scene(
            press(),
            push(0.3),
            friction=even_map().model_copy(update={"origin": (0.05 * A, 0.0)}),
        ),
        "friction is not even",
    ),
    "tilted": (scene(press(tilt=(1e-4, 0.0)), push(0.3)), "tilts"),
    "held by moments": (scene(press(moment=(0.0, 0.0)), push(0.3)), "tilts"),
}


@pytest.mark.parametrize(("described", "because"), NOT_TOLD.values(), ids=NOT_TOLD)
def test_what_no_part_tells_is_solved_on_the_window(described, because, monkeypatch):
    decided = plan(described)
    assert decided.told == WHOLE
    assert because in why(decided)
    refuse(monkeypatch, MirroredCoupledOperator)
    solve(described, SurfaceGrid((20, 20), (3.5 * A, 3.5 * A)), 1e-6)


def test_cells_on_a_plane_are_solved_on_the_window(monkeypatch):
    refuse(monkeypatch, MirroredCoupledOperator)
    solve(scene(press(), push(0.3)), SurfaceGrid((20, 21), (3.5 * A, 3.5 * A)), 1e-6)


def test_the_plan_says_which_part_tells_what():
    pressed, pushed = plan(scene(press())), plan(scene(press(), push(0, 0.5), push(0, -0.5)))
    assert "a quarter of the window tells pressures and shear" in why(pressed)
    assert "half of it, x > 0, pressures and shear, at three fifths" in why(pushed)
    assert "half of it, y > 0" in why(plan(scene(press(), slid(0.5))))
    assert all_effects(pushed).told == WHOLE
    assert one_way(pushed).told == Y


@pytest.mark.parametrize(
    "loading",
    [
        (press(),),
        (press(), *LOOP),
        (press(), push(1.0)),
        (press(), slid(30), push(0, increments=1)),
    ],
    ids=["pressed", "loop", "to the limit", "slid"],
)
@pytest.mark.parametrize("cells", [(32, 32), (104, 40)], ids=str)
def test_nothing_is_convolved_on_the_window_where_a_part_is_enough(cells, loading, monkeypatch):
    """Neither by the operators on the window nor by their transform, whatever way leads there."""
    on_window = CoupledOperator, CouplingOperator, NormalOperator, TangentialOperator
    refuse(monkeypatch, *on_window, PaddedTransform, PeriodicInverse)
    solve(scene(*loading), SurfaceGrid(cells, (3 * A, 3 * A)), 1e-8)


def test_a_slide_and_the_way_back_are_slides():
    """The scene above goes where it says, by the alternation at least once."""
    end = solve(scene(press(), slid(30)), grid(), 1e-8).increments[-1]
    assert end.status is ContactStatus.GROSS_SLIDING


def test_all_effects_are_solved_on_the_window(monkeypatch):
    refuse(monkeypatch, MirroredCoupledOperator)
    described = scene(press(increments=1), push(0.3, increments=1))
    solve(described, SurfaceGrid((16, 16), (3 * A, 3 * A)), 1e-6, plan=all_effects(plan(described)))


@pytest.mark.parametrize("loading", [(press(),), (press(), push(0.5))], ids=["pressed", "pushed"])
def test_pressure_that_acts_alone_on_shear_is_told_by_the_same_part(loading):
    described = scene(*loading)
    decided = one_way(plan(described))
    of_part = solve(described, grid(), TOLERANCE, plan=decided)
    of_window = solve(described, grid(), TOLERANCE, plan=replace(decided, told=WHOLE))
    assert_same_pressures(of_part, of_window, SAME)
    assert_same_shear(of_part, of_window, SAME, steps=4)


@pytest.mark.parametrize("loading", [(press(),), (press(), push(0.5))], ids=["pressed", "pushed"])
def test_edges_are_put_inside_the_same_cells(loading):
    """On the window, from what the part tells."""
    described, on = scene(*loading), grid(48, 1.2)
    decided = plan(described, edge="all")
    assert decided.edge == "all"
    of_part = solve(described, on, TOLERANCE, plan=decided)
    of_window = solve(described, on, TOLERANCE, plan=replace(decided, told=WHOLE))
    for a, b in zip(of_part.increments, of_window.increments, strict=True):
        assert (a.edge_change is None) == (b.edge_change is None)
        assert np.max(np.abs(a.pressure - b.pressure)) <= 1e-6 * np.max(b.pressure)
        assert np.max(np.abs(a.shear - b.shear)) <= 1e-6 * MU * np.max(b.pressure)
    assert of_part.increments[-1].edge_change is not None


def test_a_history_told_by_half_goes_on_as_it_was():
    described, on = scene(press(), *LOOP), grid(32)
    decided = plan(described)
    model = partial(ContactModel.of, described, on, even=decided.quarter, told=decided.told)
    all_of_it = list(marked(model(), decided, TOLERANCE))
    _, mark = all_of_it[4]
    since = Standing(tuple(increment for increment, _ in all_of_it[:5]), pickled(mark), on)
    later = list(marked(model(), decided, TOLERANCE, since))
    assert mark.state.sheared.shear.shape == (2, 32, 16)
    for (increment, _), (again, _) in zip(all_of_it[5:], later, strict=True):
        for field in ("pressure", "shear", "slip", "slip_before", "dissipation", "in_stick"):
            np.testing.assert_array_equal(getattr(increment, field), getattr(again, field))
        assert increment.dissipated_energy == again.dissipated_energy


@pytest.mark.parametrize("mirrored", [(False, True), (True, False), (True, True)], ids=str)
def test_friction_varies_on_a_box_as_on_the_window(mirrored):
    part = Part(mirrored)
    described = scene(press(), friction=even_map())
    model = ContactModel.of(described, grid(32, 0.9), even=True, told=part)
    expected = part.of(model.friction.limit(np.ones((32, 32))))
    np.testing.assert_array_equal(model.friction_limit(np.ones(part.cells((32, 32)))), expected)
    found = model.friction_limit(np.ones((5, 7)), first=(3, 2))
    np.testing.assert_array_equal(found, expected[3:8, 2:9])


@pytest.mark.parametrize("loading", [(press(),), (press(), push(0.8))], ids=["pressed", "pushed"])
def test_a_part_goes_the_steps_of_the_window_where_patches_are_wider_than_cells(loading):
    """What decides on a step is counted with the images."""
    of_part, of_window = on_part_and_window(scene(*loading), grid(128, 1.2), 1e-8)
    steps = [[i.rounds for i in run.increments] for run in (of_part, of_window)]
    spent = [[i.iterations for i in run.increments] for run in (of_part, of_window)]
    assert steps[0] == steps[1]
    assert spent[0] == pytest.approx(spent[1], abs=1)
