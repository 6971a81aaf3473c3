"""Tests of hat functions over the radius: integrals over the plane that they cover."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem_reference.elasticity.hat_functions import hats_on


@st.composite
def nodes(draw):
    """Corners of unequal elements, midsides between."""
    widths = draw(st.lists(st.floats(0.1, 3.0), min_size=1, max_size=8))
    corners = np.concatenate([[0.0], np.cumsum(widths)])
    middle = 0.5 * (corners[1:] + corners[:-1])
    return np.sort(np.concatenate([corners, middle]))


@given(nodes())
def test_uniform_traction_carries_area_and_moment(radii) -> None:
    hats, R = hats_on(radii), radii[-1]
    assert 2 * pi * hats.weights.sum() == pytest.approx(pi * R**2)
    assert 2 * pi * hats.arms.sum() == pytest.approx(2 * pi * R**3 / 3)


@given(nodes(), st.lists(st.floats(-2, 2), min_size=3, max_size=3))
def test_forces_of_a_linear_traction_do_the_work_of_the_tractions(radii, parabola) -> None:
    """∫ u t r dr for u quadratic and t linear, by nodal forces and in closed form."""
    hats = hats_on(radii)
    u = np.polynomial.Polynomial(parabola)
    t = np.polynomial.Polynomial([0.7, -0.3])
    exact = (u * t * np.polynomial.Polynomial([0, 1])).integ()(radii[-1])
    assert u(radii) @ hats.products @ t(hats.radii) == pytest.approx(exact, abs=1e-9)


@given(nodes(), st.data())
def test_no_hat_reaches_beyond_a_rim(radii, data) -> None:
    """A hat at the rim is half a hat, so the area carried is that within the rim."""
    rim = data.draw(st.sampled_from(list(radii[2::2])))
    hats = hats_on(radii, rim)
    assert hats.radii[-1] == rim
    assert 2 * pi * hats.weights.sum() == pytest.approx(pi * rim**2)
