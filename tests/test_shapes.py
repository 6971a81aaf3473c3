"""What a shape says of itself is true, and what it does not say no solver assumes."""

import re
from typing import Any, get_args

import numpy as np
import pytest
from contact_scenes import PRESS, RADIUS, A, scene, steel
from fem_scenes import elements
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike
from strategies import SHAPED

import contact_scene
from contact_scene import Paraboloid, Scene, SurfaceDiscretisation
from contact_scene.geometry import SHAPES, Gap, Indenter, ShapedBody
from contact_scene.reading.quantity import PositiveLength
from contact_scene.reading.scene_text import shape_text
from contact_scene.solver_errors import SolverError, UnsupportedScene
from fem_reference import plan as plan_of_elements
from fem_reference import solve as solve_by_elements
from semi_analytical import solve_discretised

ANGLES = np.linspace(0.0, 2 * np.pi, 17)


class Barrel(ShapedBody):
    """Two radii, and not a word of it."""

    radii: tuple[PositiveLength, PositiveLength]

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """To second order."""
        R_x, R_y = self.radii
        return np.asarray(np.square(x) / (2 * R_x) + np.square(y) / (2 * R_y))


class Egg(Paraboloid):
    """Derived from a shape of revolution, which it is not."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Twice as wide along y."""
        return np.asarray((np.square(x) + np.square(y) / 4) / (2 * self.radius))


class Dome(Barrel):
    """Says that it is of revolution, and nothing of how large its contact is."""

    @property
    def is_of_revolution(self) -> bool:
        """It is."""
        return True

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Of the fourth order."""
        return np.asarray((np.square(x) + np.square(y)) ** 2 / self.radii[0] ** 3)


NEW = (
    Barrel(material=steel(), radii=(RADIUS, 3 * RADIUS)),
    Egg(material=steel(), radius=RADIUS),
    Dome(material=steel(), radii=(0.1 * RADIUS, RADIUS)),
)
ALL = SHAPED | st.sampled_from(NEW)


def on(shape: ShapedBody, **update: Any) -> Scene:
    """A scene with any indenter, one that no file can name included."""
    return scene(PRESS, friction=None).model_copy(update={"indenter": shape, **update})


def test_every_shape_is_registered_everywhere() -> None:
    branches = get_args(get_args(Indenter)[0])
    assert [get_args(branch)[0] for branch in branches] == list(SHAPES.values())
    assert [get_args(branch)[1].tag for branch in branches] == [f"<{name}>" for name in SHAPES]
    for name, shape in SHAPES.items():
        assert shape.model_fields["shape"].default == name
        assert getattr(contact_scene, shape.__name__) is shape


@given(ALL, st.floats(1e-9, 0.5), st.floats(0, 2 * np.pi))
def test_what_a_shape_says_of_its_gap_is_true(shape, reach, angle) -> None:
    x, y = np.multiply(shape.extent or (1.0, 1.0), reach) * (np.cos(angle), np.sin(angle))
    assert not np.isnan(shape.initial_gap(x, y))
    if shape.is_even:
        mirrored = shape.initial_gap(np.array([x, -x, x]), np.array([y, y, -y]))
        np.testing.assert_allclose(mirrored, mirrored[0], rtol=1e-12)
    if shape.is_of_revolution:
        around = shape.initial_gap(reach * np.cos(ANGLES), reach * np.sin(ANGLES))
        # Round-off of the radius, which an edge or an equator makes large, and of the gap.
        least, most = shape.initial_gap(reach * np.array([1 - 1e-15, 1 + 1e-15]), 0.0)
        assert np.all((around >= least * (1 - 1e-14)) & (around <= most * (1 + 1e-14)))
    if shape.rim is not None:
        r = shape.rim * np.array([0.0, 0.5, 1 - 1e-9, 1 + 1e-9, 2.0])
        np.testing.assert_array_equal(np.isfinite(shape.initial_gap(r, 0.0)), r < shape.rim)
    if shape.extent is not None:
        with pytest.raises(ValueError, match="covers"):
            shape.initial_gap(0.51 * shape.extent[0], 0.0)
    elif shape.gap_exponent is not None:
        k = shape.gap_exponent
        r = min(shape.contact_at(1e-12 * reach)) ** (1 / k)  # far below any radius that is drawn
        one, two = shape.initial_gap([r, 2 * r], 0.0)
        assert two / one == pytest.approx(2.0**k, rel=1e-5)


@given(ALL, st.floats(1e-9, 1.0), st.floats(1e3, 1e12))
def test_a_contact_grows_with_the_load(shape, approach, modulus) -> None:
    for of in (shape.contact_at, lambda load: shape.contact_under(load, modulus)):
        smaller, larger = of(approach), of(2 * approach)
        assert (smaller is None) == (larger is None)
        if smaller is not None:
            assert 0 < smaller[0] < larger[0] < np.inf
            assert 0 < smaller[1] < larger[1] < np.inf
            assert shape.gap_exponent is not None


@given(ALL)
@settings(max_examples=30)
def test_finite_elements_take_what_says_it_is_of_revolution_and_refuse_the_rest(shape) -> None:
    asked = on(shape)
    if not shape.is_of_revolution:
        named = re.escape(shape_text(shape))
        with pytest.raises(UnsupportedScene, match=f"{named}.*bodies of revolution"):
            plan_of_elements(asked)
        return
    try:
        plan_of_elements(asked)
        solved = solve_by_elements(asked, elements(4, box=10.0))
    except SolverError:
        return
    assert solved.increments[-1].normal_force == pytest.approx(PRESS["normal_force"])


@given(ALL)
@settings(max_examples=30)
def test_the_semi_analytical_solver_solves_or_refuses_any_shape(shape) -> None:
    try:
        solved = solve_discretised(on(shape), SurfaceDiscretisation(cells=(16, 16)))
    except SolverError:
        return
    assert solved.increments[-1].normal_force == pytest.approx(PRESS["normal_force"])


@pytest.mark.parametrize("shape", NEW, ids=lambda shape: type(shape).__name__)
def test_a_shape_that_says_nothing_is_solved_where_its_window_is_given(shape) -> None:
    with pytest.raises(UnsupportedScene, match="give a window"):
        solve_discretised(on(shape), SurfaceDiscretisation(cells=(16, 16)))
    window = (6 * A, 6 * A)
    asked = SurfaceDiscretisation(cells=(24, 24), window=window, tolerance=1e-6)
    assert solve_discretised(on(shape), asked).increments[-1].contact_radius > 0
