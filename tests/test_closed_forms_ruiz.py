"""Closed forms of the surface stress and of Ruiz's parameters: consistent before they judge."""

import numpy as np
import pytest
from scipy.integrate import quad

from verification.closed_forms.sheared_surface import (
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)

POISSON_RATIOS = [0.0, 0.3, 0.5]


@pytest.mark.parametrize("nu", POISSON_RATIOS)
@pytest.mark.parametrize("x", [1.05, -1.4, 6.0])
def test_stress_beyond_a_sheared_circle_is_that_of_the_forces_in_it(x: float, nu: float) -> None:
    """Cerruti's point force, added up over the circle in polar coordinates about its centre."""

    def of_ring(r: float) -> float:
        def of_force(angle: float) -> float:
            X, Y = x - r * np.cos(angle), -r * np.sin(angle)
            R = np.hypot(X, Y)
            return float(-(3 * nu * X**3 / R**5 + (1 - 2 * nu) * X / R**3) / np.pi)

        return r * np.sqrt(1 - r**2) * 2 * quad(of_force, 0, np.pi, epsrel=1e-9)[0]

    expected = quad(of_ring, 0, 1, epsrel=1e-8)[0]
    assert stress_by_hertz_shear(x, 1.0, 1.0, nu) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("nu", POISSON_RATIOS)
@pytest.mark.parametrize("mu", [0.0, 0.1, 0.7])
def test_a_sliding_contact_is_most_in_tension_at_its_trailing_edge(nu: float, mu: float) -> None:
    x = np.linspace(-3, 3, 6001)
    stress = stress_by_hertz_pressure(x, 1.0, 2.0, nu) + stress_by_hertz_shear(x, 1.0, 2 * mu, nu)
    assert np.max(stress) == pytest.approx(trailing_edge_tension(2.0, mu, nu), rel=1e-9, abs=1e-12)
    if mu > 0:
        assert x[np.argmax(stress)] == pytest.approx(-1.0, abs=1e-9)
