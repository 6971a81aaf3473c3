"""One-way coupled indentation: the stick radius by another route, its limits and printed values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import ellipe, ellipk

from verification.closed_forms.goodman import stick_ratio

BETA = 0.4 / 1.4  # ν = 0.3 under a rigid indenter


@pytest.mark.parametrize(("friction", "ratio"), [(0.1, 0.2240), (0.2, 0.7334), (0.3, 0.9186)])
def test_printed_values(friction, ratio):
    assert stick_ratio(friction, BETA) == pytest.approx(ratio, abs=5e-5)


def slip_side(c):
    """The Abel transform at s = c of the shear µ g outside the stick disc, over µ g."""

    def integrand(t):
        m = 1 - (c / t) ** 2
        return (ellipk(m) - ellipe(m)) / (t * t - c * c)

    return 1 - 2 / np.pi * c * quad(integrand, c, 1, epsabs=1e-13)[0]


@given(friction=st.floats(0.05, 0.6), beta=st.floats(0.05, 0.5))
def test_transforms_of_stick_and_slip_meet_at_the_edge(friction, beta):
    """Of a flat punch, whose transform of the pressure is constant (Spence 1975)."""
    c = stick_ratio(friction, beta)
    if 1e-3 < c < 1 - 1e-6:
        stick_side = beta / np.pi * np.log((1 + c) / (1 - c))
        assert stick_side == pytest.approx(friction * slip_side(c), rel=1e-7)


def test_limits():
    assert stick_ratio(1e-6, BETA) == 0
    assert stick_ratio(100, BETA) == 1
    with pytest.raises(ValueError, match="dundurs_beta"):
        stick_ratio(0.1, 0.0)
