"""Tests of hat functions over the radius: integrals over the plane that they cover."""

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


@given(nodes(), st.lists(st.floats(-2, 2), min_size=3, max_size=3), st.data())
def test_integrals_are_those_up_to_the_rim(radii, parabola, data):
    """∫ u t r dr for u quadratic and t linear, the area and its moment; at a rim is half a hat."""
    rim = data.draw(st.sampled_from(list(radii[2::2])))
    hats = hats_on(radii, rim)
    u = np.polynomial.Polynomial(parabola)
    t = np.polynomial.Polynomial([0.7, -0.3])
    exact = (u * t * np.polynomial.Polynomial([0, 1])).integ()(rim)
    assert u(radii) @ hats.products @ t(hats.radii) == pytest.approx(exact, abs=1e-9)
    assert hats.weights.sum() == pytest.approx(rim**2 / 2)
    assert hats.arms.sum() == pytest.approx(rim**3 / 3)
