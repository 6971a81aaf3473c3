"""The laws that any surface FRF obeys, numbered P1 to P20: worse bodies are searched for than the
report draws by their seeds, and what only tests state."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from stack_strategies import (
    MODULI,
    THICKNESSES,
    stacks,
)

from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import half_space_scalars, scalars
from verification.laws.law import Law, apart
from verification.laws.limit_laws import LIMIT_LAWS
from verification.laws.symmetry_laws import SYMMETRY_LAWS

LAWS = SYMMETRY_LAWS + LIMIT_LAWS
EXACT = ("hermitian", "real", "parity")  # no rounding comes in


class Searched(np.random.Generator):
    """What the laws draw at random, chosen by Hypothesis instead: it looks for the worst."""

    def __init__(self, data: st.DataObject) -> None:
        super().__init__(np.random.PCG64(0))
        self._data = data

    def uniform(self, low: float, high: float, size: int | None = None) -> Any:  # type: ignore[override]
        one = st.floats(low, high)
        if size is None:
            return self._data.draw(one)
        return np.array(self._data.draw(st.lists(one, min_size=size, max_size=size)))

    def random(self) -> float:  # type: ignore[override]
        return self._data.draw(st.floats(0, 1, exclude_max=True))

    def integers(self, low: int, high: int, endpoint: bool = False) -> int:  # type: ignore[override]
        return self._data.draw(st.integers(low, high - (not endpoint)))

    def choice(self, values: Any) -> Any:  # type: ignore[override]
        return self._data.draw(st.sampled_from(values))

    def normal(self, size: Any) -> Any:  # type: ignore[override]
        seed = self._data.draw(st.integers(0, 2**32 - 1))
        return np.random.default_rng(seed).normal(size=size)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@given(data=st.data())
def test_law_holds_for_the_worst_body_that_is_found(law: Law, data: st.DataObject) -> None:
    assert law.violation(Searched(data)) <= (0 if law.name in EXACT else law.allowed)


@given(MODULI, THICKNESSES, st.floats(-0.95, 0.49))
def test_p14_long_waves_over_a_rigid_base_compress_and_shear_the_layer(G, h, nu):
    c11, _, c22, csh = scalars(Stack([(G, nu, h)]), 1e-6 / h)
    assert c11 == pytest.approx(h / G, rel=1e-9)
    assert csh == pytest.approx(h / G, rel=1e-9)
    assert c22 == pytest.approx(h * (1 - 2 * nu) / (2 * G * (1 - nu)), rel=1e-9)


@given(MODULI, THICKNESSES)
def test_p14_long_waves_over_a_rigid_base_squeeze_an_incompressible_layer(G, h):
    x = 1e-5
    _, c12, c22, _ = scalars(Stack([(G, 0.5, h)]), x / h)
    assert c22 == pytest.approx(x**2 * h / (3 * G), rel=1e-9)
    assert c12 == pytest.approx(-x * h / (2 * G), rel=1e-9)


def depth_system(G, nu, alpha):
    """Matrix of d/dz (U, W, tau_s, tau_z) in a layer."""
    ratio, modulus = nu / (1 - nu), 2 * G / (1 - nu)
    return np.array(
        [
            [0, -alpha, -1 / G, 0],
            [ratio * alpha, 0, 0, -(1 - 2 * nu) / (2 * G * (1 - nu))],
            [-(alpha**2) * modulus, 0, 0, -alpha * ratio],
            [0, 0, alpha, 0],
        ]
    )


@given(stacks(min_layers=1, max_layers=3), st.floats(0.1, 3))
def test_p18_equilibrium_over_the_depth_gives_the_surface_response(stack, x):
    """Integrate equilibrium with continuous displacement and traction from the base upward."""
    alpha = x / sum(film.thickness for film in stack.layers)
    response = np.zeros((2, 2))
    if stack.base is not None:
        c11, c12, c22, _ = half_space_scalars(stack.base, alpha)
        response = np.array([[c11, c12], [c12, c22]])
    for G, nu, h in reversed(stack.layers):
        # Unit displacement G / alpha keeps the exponential well scaled.
        scale = np.array([1 / (G * alpha), 1 / (G * alpha), 1, 1])
        system = depth_system(G, nu, alpha) * scale / scale[:, None]
        state = expm(-system * h) @ np.vstack([response * G * alpha, np.eye(2)])
        response = np.linalg.solve(state[2:].T, state[:2].T).T / (G * alpha)
    c11, c12, c22, _ = scalars(stack, alpha)
    assert apart(np.array([[c11, c12], [c12, c22]]), response) <= 1e-8
