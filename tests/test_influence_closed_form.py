"""The closed forms of the influence coefficients are integrals of the point solutions."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.integrate import dblquad

from semi_analytical.influence.closed_form import HalfSpaceCoefficients, RectangleIntegrals

G, NU = 3.0, 0.3
CELLS = {"square": (0.7, 0.7), "flat": (0.5, 1.6), "upright": (3.0, 0.4)}
# Point solutions of Boussinesq and Cerruti (Johnson 1985, eqs 3.18 and 3.75), times 2 pi G.
POINT = {
    "zz": lambda x, y, r: (1 - NU) / r,
    "xx": lambda x, y, r: (1 - NU) / r + NU * x * x / r**3,
    "yy": lambda x, y, r: (1 - NU) / r + NU * y * y / r**3,
    "xy": lambda x, y, r: NU * x * y / r**3,
    "zx": lambda x, y, r: (0.5 - NU) * x / r**2,
    "zy": lambda x, y, r: (0.5 - NU) * y / r**2,
}
# Quadrature leaves 1e-13 of the self coefficient, the closed forms a few units of round-off.
QUADRATURE = 1e-10


def point(component, x, y):
    return POINT[component](x, y, np.hypot(x, y)) / (2 * np.pi * G)


def coefficients(cell, shape=(6, 5), poisson_ratio=NU):
    return HalfSpaceCoefficients(RectangleIntegrals(*cell, shape), G, poisson_ratio)


def by_gauss(component, cell, i, j):
    """Integral over a cell that the observer is not in."""
    nodes, weights = leggauss(200)
    x = i * cell[0] - 0.5 * cell[0] * nodes[:, None]
    y = j * cell[1] - 0.5 * cell[1] * nodes[None, :]
    area = 0.25 * cell[0] * cell[1]
    return area * np.sum(weights[:, None] * weights * point(component, x, y))


def over_own_cell(component, cell):
    """Integral over the cell around the observer, in polar coordinates: no singularity."""
    half_x, half_y = 0.5 * cell[0], 0.5 * cell[1]

    def along_ray(r, angle):
        return r * point(component, r * np.cos(angle), r * np.sin(angle))

    corner = np.arctan2(half_y, half_x)
    sides = [
        (-corner, corner, lambda angle: half_x / np.cos(angle)),
        (corner, np.pi - corner, lambda angle: half_y / np.sin(angle)),
    ]
    # The opposite quarters see the even components alike.
    return 2 * sum(
        dblquad(along_ray, start, end, 0, edge, epsabs=1e-13)[0] for start, end, edge in sides
    )


@pytest.mark.parametrize("cell", CELLS.values(), ids=CELLS)
@pytest.mark.parametrize("component", POINT)
def test_coefficient_is_the_integral_of_the_point_solution(component, cell):
    K = getattr(coefficients(cell), component)
    largest = np.max(np.abs(K))
    for i, j in [(1, 0), (0, 1), (1, 1), (3, 2), (5, 4)]:
        assert abs(K[i, j] - by_gauss(component, cell, i, j)) < QUADRATURE * largest


@pytest.mark.parametrize("cell", CELLS.values(), ids=CELLS)
@pytest.mark.parametrize("component", ["zz", "xx", "yy"])
def test_self_coefficient_is_the_integral_around_the_observer(component, cell):
    assert getattr(coefficients(cell), component)[0, 0] == pytest.approx(
        over_own_cell(component, cell), rel=QUADRATURE
    )


def test_turning_the_cell_swaps_x_and_y():
    one, other = coefficients((0.5, 1.6), (6, 5)), coefficients((1.6, 0.5), (5, 6))
    for name, swapped in [("zz", "zz"), ("xx", "yy"), ("xy", "xy"), ("zx", "zy")]:
        np.testing.assert_allclose(
            getattr(one, name), getattr(other, swapped).T, rtol=1e-13, atol=1e-15
        )


@pytest.mark.parametrize("component", POINT)
@pytest.mark.parametrize("cell", CELLS.values(), ids=CELLS)
def test_a_unit_of_length_costs_no_digit(component, cell):
    """In one that differs by a power of two, all bits are the same: logarithms are of ratios."""
    unit = 2.0**-20
    one, other = coefficients(cell), coefficients((unit * cell[0], unit * cell[1]))
    np.testing.assert_array_equal(getattr(other, component), unit * getattr(one, component))
