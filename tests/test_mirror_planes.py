"""A quarter of the window tells pressures that are even about x = 0 and y = 0, to rounding."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    INDENTERS,
    LOAD,
    PRESS,
    RADIUS,
    RIGID_BALL,
    A,
    bump,
    grid,
    push,
    scene,
    steel,
)
from hypothesis import given
from hypothesis import strategies as st
from mirrored_runs import Leaf, assert_same_pressures, refuse, why

from contact_scene import HeightMap, Layer, Paraboloid
from contact_scene.geometry import Gap
from contact_scene.solver_errors import ContactAtWindowEdge, ContactNotResolved
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.box import box_around
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.mirrored_operator import MirroredNormalOperator
from semi_analytical.mirrored_transform import MOST_BY_MATRIX, mirrored_offsets
from semi_analytical.model import ContactModel
from semi_analytical.operator import NormalOperator
from semi_analytical.padded_transform import Convolutions
from semi_analytical.part import QUARTER, part_of
from semi_analytical.pressing import NormalTarget, nested_start
from verification.problems.shifted_grid import ShiftedGrid

ROUND_OFF = 1e-13
# Solved to 1e-13; what the cells at the edge make of that.
TOLERANCE, SAME = 1e-13, 1e-10
LONG = MOST_BY_MATRIX + 2
ELASTIC = scene(PRESS).body, scene(PRESS).indenter


def operators(shape, counter=None):
    """On a quarter of `shape` cells and on the whole window."""
    K = influence_coefficients(*ELASTIC, (0.3, 1.7), mirrored_offsets(shape))
    counter = counter or Convolutions()
    whole = 2 * shape[0], 2 * shape[1]
    return MirroredNormalOperator(K, shape, counter), NormalOperator(K, whole, counter)


@pytest.mark.parametrize(
    "shape", [(1, 1), (3, 5), (8, 13), (17, 1), (LONG, 6), (5, LONG), (LONG, LONG), (150, 200)]
)
def test_the_operator_on_a_quarter_is_that_on_the_window(shape, rng):
    of_quarter, of_window = operators(shape)
    p = rng.standard_normal(shape)
    expected = of_window(QUARTER.unfolded(p))
    assert np.max(np.abs(QUARTER.unfolded(of_quarter(p)) - expected)) < ROUND_OFF * np.max(
        np.abs(expected)
    )


@pytest.mark.parametrize("shape", [(4, 6), (8, 1), (24, LONG + 4), (80, 100)])
def test_the_preconditioner_on_a_quarter_is_that_on_the_window(shape, rng):
    """Where both have the same period: of fast lengths, odd ones are not halved."""
    of_quarter, of_window = operators(shape)
    u = rng.standard_normal(shape)
    expected = of_window.precondition(QUARTER.unfolded(u))
    found = QUARTER.unfolded(of_quarter.precondition(u))
    # Long waves across the longer cells are divided by little.
    assert np.max(np.abs(found - expected)) < 10 * ROUND_OFF * np.max(np.abs(expected))


@given(st.tuples(st.integers(1, 40), st.integers(1, 80)), st.integers(0, 2**32 - 1))
def test_operator_and_preconditioner_are_symmetric_and_positive(shape, seed):
    of_quarter, _ = operators(shape)
    a, b = np.random.default_rng(seed).standard_normal((2, *shape))
    for linear in (of_quarter, of_quarter.precondition):
        size = np.linalg.norm(a) * np.linalg.norm(linear(b))
        assert np.sum(a * linear(b)) == pytest.approx(np.sum(linear(a) * b), abs=1e-12 * size)
        assert np.sum(a * linear(a)) > 0


def test_a_convolution_of_a_quarter_counts_as_one():
    counter = Convolutions()
    of_quarter, _ = operators((6, 70), counter)
    of_quarter.precondition(of_quarter(np.ones((6, 70))))
    assert counter.count == 1


@given(st.integers(1, 60), st.integers(1, 60), st.integers(0, 59), st.integers(0, 59))
def test_the_box_of_a_quarter_is_the_quarter_of_the_box(nx, ny, i, j):
    marked = np.zeros((nx, ny), dtype=bool)
    marked[i % nx, j % ny] = True
    whole = box_around(QUARTER.unfolded(marked), 4)
    told = box_around(marked, 4, QUARTER)
    assert told.first == (0, 0)
    assert told.shape == tuple(side // 2 for side in whole.shape)
    assert whole.first == (nx - told.shape[0], ny - told.shape[1])


def even_map():
    spacing = 4 * A / 64
    return HeightMap(file=bump(64, spacing), spacing=spacing, material=steel())


COATED = Layer(thickness=0.5 * A, material=steel(young_modulus=840e9))
SCENES = {
    **{
        name: (scene(PRESS, friction=None, indenter=indenter), (4, 5))
        for name, indenter in INDENTERS.items()
    },
    "long ellipsoid": (scene(PRESS, friction=None, indenter=INDENTERS["ellipsoid"]), (3, 6)),
    "approach": (scene({"approach": 0.7 * APPROACH}, friction=None), (4, 4)),
    "approach and back": (
        scene({"approach": APPROACH}, {"approach": 0.4 * APPROACH}, friction=None),
        (3, 3),
    ),
    "history": (scene(PRESS, {"normal_force": 0.2 * LOAD, "increments": 3}), (4, 3)),
    "coated": (
        scene(PRESS, friction=None, indenter=RIGID_BALL).model_copy(
            update={"body": scene(PRESS).body.model_copy(update={"layers": (COATED,)})}
        ),
        (3, 3),
    ),
    "height map": (scene(PRESS, friction=None, indenter=even_map()), (3.5, 3)),
}


@pytest.mark.parametrize("cells", [(64, 64), (48, 40), (26, 34)], ids=str)
@pytest.mark.parametrize(("described", "sides"), SCENES.values(), ids=SCENES)
def test_a_quarter_tells_the_answer_of_the_window(described, sides, cells):
    on = SurfaceGrid(cells, (sides[0] * A, sides[1] * A))
    decided = plan(described)
    assert decided.quarter
    told = solve(described, on, TOLERANCE, plan=decided)
    full = solve(described, on, TOLERANCE, plan=replace(decided, quarter=False))
    assert_same_pressures(told, full, SAME)
    for a, b in zip(told.increments, full.increments, strict=True):
        assert (a.iterations, a.convolutions) == pytest.approx(
            (b.iterations, b.convolutions), abs=3
        )


@pytest.mark.parametrize(
    ("described", "cells"),
    [
        (scene(PRESS, friction=None), (33, 32)),
        (scene({**PRESS, "tilt": (1e-4, 0.0)}, friction=None), (32, 32)),
        (scene({**PRESS, "moment": (0.0, 0.0)}, friction=None), (32, 32)),
        (
            scene(
                PRESS,
                friction=None,
                indenter=HeightMap(
                    file=bump(64, 4 * A / 64)[1:], spacing=4 * A / 64, material=steel()
                ),
            ),
            (32, 32),
        ),
    ],
    ids=["cells on a plane", "tilt", "moment", "uneven map"],
)
def test_what_is_not_even_is_solved_on_the_window(described, cells, monkeypatch):
    refuse(monkeypatch, MirroredNormalOperator)
    solve(described, SurfaceGrid(cells, (3.5 * A, 3.5 * A)), 1e-8)


@pytest.mark.parametrize("cells", [(32, 32), (64, 40)], ids=str)
def test_nothing_is_convolved_on_the_window_where_a_quarter_is_enough(cells, monkeypatch):
    refuse(monkeypatch, NormalOperator)
    solve(scene(PRESS, push(0.5)), SurfaceGrid(cells, (3 * A, 3 * A)), 1e-8)


@pytest.mark.parametrize("quarter", [True, False], ids=["quarter", "window"])
def test_what_cannot_be_solved_is_refused_alike(quarter):
    def solved(described, on):
        solve(described, on, 1e-8, plan=replace(plan(described), quarter=quarter))

    with pytest.raises(ContactAtWindowEdge, match="reaches the edge of the window"):
        solved(scene(PRESS, friction=None), grid(32, 0.9))
    with pytest.raises(ContactNotResolved, match="no cell of the window touches"):
        solved(scene({"approach": 1e-4 * APPROACH}, friction=None), grid(16, 8))


class Liar(Paraboloid):
    """Says that it is even, which it is along x alone."""

    @property
    def is_even(self) -> bool:
        """No."""
        return True

    def initial_gap(self, x, y) -> Gap:
        """Off the middle."""
        return super().initial_gap(x, np.subtract(y, 0.01 * A))


def test_a_shape_that_is_not_what_it_says_is_found_out():
    described = scene(PRESS, friction=None).model_copy(
        update={"indenter": Liar(radius=RADIUS, material=steel())}
    )
    with pytest.raises(ValueError, match="says that it is even"):
        solve(described, grid(), 1e-8)


def test_round_off_is_told_from_a_lie_by_the_size_of_the_gap_whatever_its_sign():
    """As at the cells of a map where its cubic dips below the lowest height."""
    gap = bump(6, A) - 1.0
    gap[0, 0] *= 1 + 1e-15
    assert part_of(gap, even=True) == QUARTER
    gap[0, 0] *= 1 + 1e-6
    with pytest.raises(ValueError, match="says that it is even"):
        part_of(gap, even=True)


def test_a_gap_of_its_own_is_not_taken_for_even():
    described = scene(PRESS, friction=None).model_copy(
        update={"indenter": Leaf(radii=(RADIUS, 3 * RADIUS), material=steel())}
    )
    assert not plan(described).quarter


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.5, 0.0), (0.1, 0.35)])
def test_cells_that_lie_beside_the_axis_are_solved_as_they_are(offset):
    """The indenter is even, but what they see of it is not."""
    beside = ShiftedGrid((8, 8), (3 * A, 3 * A), offset)
    part = ContactModel.of(scene(PRESS), beside, even=True).part
    assert part.quarter == (offset == (0.0, 0.0))


def test_a_first_pressure_covers_the_window_for_whoever_asks():
    """Below a grid with a cell on a plane, too: 260 cells, 130, 65."""
    on = SurfaceGrid((260, 260), (3 * A, 3 * A))
    target = NormalTarget(force=LOAD)
    (told, spent), (full, full_spent) = (
        nested_start(ContactModel.of(scene(PRESS), on, even=even), target) for even in (True, False)
    )
    assert spent == full_spent
    np.testing.assert_allclose(told, full, rtol=1e-6, atol=1e-6 * np.max(full))


def test_the_plan_says_what_mirror_planes_save_or_why_not():
    level, tilted = plan(scene(PRESS)), plan(scene({**PRESS, "tilt": (1e-4, 0.0)}))
    assert level.quarter
    assert "a quarter of the window tells pressures" in why(level)
    assert not tilted.quarter
    assert "tilts" in why(tilted)
