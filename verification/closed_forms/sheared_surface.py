"""Stress along the surface under a Hertz pressure and the shear that goes with it, on y = 0.

The normal stress of the surface in the direction of the shear, tension positive. It decides where
fretting cracks start: it is largest at the trailing edge.
"""

from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.huber_stress import huber_stress
from verification.closed_forms.validity import require_positive


def stress_by_hertz_shear(
    x: ArrayLike, contact_radius: float, peak_shear: float, poisson_ratio: float
) -> NDArray[np.float64]:
    """σ_xx at (x, 0, 0) under the shear q0 √(1-r²/a²) along +x on the body [force/length²].

    contact_radius  a > 0 [length]
    peak_shear      q0, of any sign [force/length²]

    Within the circle it is -(π/8)(4+ν) q0 x/a (Hamilton and Goodman 1966). Beyond it, integrate the
    stress -(Q/π)[3ν X³/R⁵ + (1-2ν) X/R³] by a force Q on the surface (Cerruti) over the rays
    through the circle: along the ray at the angle φ to the x axis the shear over R adds up to
    π (x cos φ - √(x²-a²)) q0/a, and of φ from 0 to m = arcsin(a/x) elementary integrals are left.
    """
    require_positive(contact_radius=contact_radius)
    nu = poisson_ratio
    t = np.asarray(x, dtype=float) / contact_radius
    outside = np.abs(t) > 1
    sine = 1 / np.where(outside, np.abs(t), 1.0)
    m, cosine = np.arcsin(sine), np.sqrt((1 - sine) * (1 + sine))
    once = (m - sine * cosine) / 2
    fourth = 3 * m / 8 + np.sin(2 * m) / 4 + np.sin(4 * m) / 32
    cubed = fourth - cosine * (sine - sine**3 / 3)
    beyond = 2 * (3 * nu * cubed + (1 - 2 * nu) * once)
    return np.asarray(-peak_shear * t * np.where(outside, beyond, pi / 8 * (4 + nu)))


def stress_by_hertz_pressure(
    x: ArrayLike, contact_radius: float, peak_pressure: float, poisson_ratio: float
) -> NDArray[np.float64]:
    """σ_xx at (x, 0, 0) under the pressure p0 √(1-r²/a²): the radial stress of Huber (1904)."""
    return huber_stress(np.abs(x), 0.0, contact_radius, peak_pressure, poisson_ratio).radial


def trailing_edge_tension(
    peak_pressure: float, friction_coefficient: float, poisson_ratio: float
) -> float:
    """Largest tension of a sliding Hertz contact [force/length²], at its trailing edge: p0
    [(1-2ν)/3 + (π/8)(4+ν) µ] (Hamilton and Goodman 1966; Johnson 1985, section 7.1)."""
    nu, mu = poisson_ratio, friction_coefficient
    return peak_pressure * ((1 - 2 * nu) / 3 + pi / 8 * (4 + nu) * mu)
