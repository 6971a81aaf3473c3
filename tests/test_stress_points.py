"""Points of a stress field say the same whoever computed them and however they lie."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_results.stress.invariants import principal_stresses, von_mises
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_section import stress_on_section
from contact_results.stress.points import StressField, StressPoints
from contact_scene import Body, FiniteElementDiscretisation, IsotropicMaterial, Layer

SOFT = IsotropicMaterial(young_modulus=2.6, poisson_ratio=0.3)
FILM = Layer(thickness=0.5, material=IsotropicMaterial(young_modulus=5.2, poisson_ratio=0.3))
COATED = Body(material=SOFT, layers=(FILM,))
FRICTION = 0.5


def pressed_and_pushed(axes: dict[str, np.ndarray], pressure: np.ndarray) -> LoadedBodies:
    """Gross sliding along x under a Hertz pressure."""
    tractions = {"pressure": pressure}
    if "x" in axes:
        tractions["shear"] = np.stack([FRICTION * pressure, 0 * pressure])
    else:
        tractions["shear_along_load"] = FRICTION * pressure
    asked = FiniteElementDiscretisation(elements_per_radius=8)
    return LoadedBodies("", COATED, COATED, 1, axes, tractions, asked)


@pytest.fixture(scope="module")
def on_section() -> StressField:
    radii = np.linspace(0, 1.2, 61)
    pressure = np.sqrt(np.maximum(1 - radii**2, 0))
    return stress_on_section(pressed_and_pushed({"radii": radii}, pressure))


@pytest.fixture(scope="module")
def on_cells() -> StressField:
    x = (np.arange(33) - 16) * 2.4 / 33
    pressure = np.sqrt(np.maximum(1 - x[:, None] ** 2 - x**2, 0))
    return stress_on_cells(pressed_and_pushed({"x": x, "y": x}, pressure))


def test_cells_and_rings_draw_the_same_picture(
    on_cells: StressField, on_section: StressField
) -> None:
    """Down the axis, one material after the other."""
    scale = np.abs(on_section.section.stress).max()
    for material in (0, 1):
        one, other = (
            axis.chosen(axis.material == material) for axis in (on_cells.axis, on_section.axis)
        )
        inside = one.chosen(one.depth > 0.1)
        assert len(inside.depth) > 3
        for name, values in inside.components.items():
            expected = np.interp(inside.depth, other.depth, other.components[name])
            np.testing.assert_allclose(values, expected, atol=0.02 * scale)


def test_measures_of_a_pure_shear() -> None:
    nothing, one = np.zeros(1), np.zeros((3, 1))
    shear = np.array([0, 0, 0, 0, 3.0, 0])[:, None]
    points = StressPoints(nothing, nothing, nothing, nothing.astype(int), one, shear, nothing > 0)
    found = {name: value.item() for name, value in points.measures.items()}
    expected = {"von_mises": 3 * np.sqrt(3), "max_principal": 3.0, "max_shear": 3.0}
    assert found == pytest.approx(expected)


# ---- Invariants of the stress do not depend on the axes, and are right where they are known


# Sixth powers of a stress are taken: below 1e-50 they underflow.
STRESS = st.floats(-1e9, 1e9).map(lambda s: s if abs(s) > 1e-50 else 0.0)
STRESSES = st.lists(STRESS, min_size=6, max_size=6).map(np.array)


def tensor(s):
    xx, yy, zz, yz, xz, xy = s
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def components(t):
    return np.array([t[0, 0], t[1, 1], t[2, 2], t[1, 2], t[0, 2], t[0, 1]])


@given(STRESSES, st.integers(0, 2**32 - 1))
def test_invariants_do_not_depend_on_the_axes(stress, seed):
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    turned = components(turn @ tensor(stress) @ turn.T)
    scale = 1e-14 * np.abs(stress).max() + 1e-300
    for invariant in (von_mises, principal_stresses):
        np.testing.assert_allclose(invariant(turned), invariant(stress), rtol=0, atol=30 * scale)


@given(STRESSES)
def test_von_mises_follows_from_the_principal_stresses(stress):
    a, b, c = principal_stresses(stress)
    expected = np.sqrt(((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 2)
    assert von_mises(stress) == pytest.approx(expected, rel=1e-7, abs=1e-6)
    assert a >= b >= c
    assert a + b + c == pytest.approx(stress[:3].sum(), abs=1e-12 * (1 + np.abs(stress).max()) * 10)


@given(STRESSES, st.integers(0, 2**32 - 1), st.sampled_from([0, 1e-15, 1e-12, 1e-8, 1e-3]))
def test_principal_stresses_keep_their_digits_where_two_are_equal(values, seed, apart):
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    first, _, third, *_ = values
    pair, triple = (first, first * (1 + apart), third), (first, first, first * (1 - apart))
    for roots in (pair, triple, values[:3]):
        whole = tensor(components(turn @ np.diag(roots) @ turn.T))
        found = principal_stresses(components(whole))
        exact = np.linalg.eigvalsh(whole)[::-1]
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-14 * np.abs(exact).max())
