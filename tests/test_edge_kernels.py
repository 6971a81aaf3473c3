"""Displacements by what tractions do within their cells."""

import numpy as np
import pytest

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.edge.displacement import EdgeOperator, Within
from semi_analytical.edge.kernels import (
    PARITY,
    PARTS,
    REACH,
    EdgeKernels,
    part_centres,
)
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.operator.spectra import even_transform
from semi_analytical.operator.transforms import Convolutions, offsets_for

SPACING = (1.0, 0.7)
STEEL = IsotropicMaterial(young_modulus=1.0, poisson_ratio=0.2)
COATED = Body(
    material=STEEL,
    layers=[Layer(thickness=2.0, material=IsotropicMaterial(young_modulus=3.0, poisson_ratio=0.3))],
)
BODIES = {"half-space": Body(material=STEEL), "coated": COATED}
CELLS = (14, 12)
# Offsets of parts across the window: more than the kernels need.
SEEN = max(CELLS) * PARTS + PARTS


@pytest.fixture(scope="module", params=BODIES)
def coefficients(request):
    """Of cells, and of the parts of a cell."""
    body, rigid = BODIES[request.param], Body(material=RIGID)
    parts = (SPACING[0] / PARTS, SPACING[1] / PARTS)
    return (
        influence_coefficients(body, rigid, SPACING, (20, 20)),
        influence_coefficients(body, rigid, parts, (SEEN, SEEN)),
    )


@pytest.mark.parametrize("component", PARITY)
def test_the_parts_of_a_cell_move_what_the_cell_moves(coefficients, component):
    """Σ over the parts = influence coefficient of the cell, at offsets of both signs."""
    whole = getattr(coefficients[0], component)
    x, y = PARITY[component]
    summed = EdgeKernels(component, *coefficients).near.sum(axis=(2, 3))
    for (i, j), found in np.ndenumerate(summed):
        i, j = i - REACH, j - REACH
        sign = (x if i < 0 else 1) * (y if j < 0 else 1)
        scale = abs(whole[1, 1])
        assert found == pytest.approx(sign * whole[abs(i), abs(j)], abs=1e-11 * scale)


@pytest.mark.parametrize("component", PARITY)
def test_a_traction_within_its_cells_moves_what_its_parts_do(coefficients, component):
    """By the operator, and added up part by part; a slope within the parts is a 121st of it, and
    what is not a slope is not seen beyond the near cells."""
    rng = np.random.default_rng(5)
    i, j = (rng.integers(0, n, 3) for n in CELLS)
    x = part_centres()
    parts = rng.normal(size=(3, 1, 1)) * x[:, None] + rng.normal(size=(3, 1, 1)) * x
    parts = parts + 0.3 * rng.normal(size=(3, 1, 1)) * (x[:, None] ** 2 - x**2)
    kernels = EdgeKernels(component, *coefficients)
    within = Within.of(np.zeros(CELLS), i, j, parts)
    found = EdgeOperator([[(1, kernels)]], CELLS, Convolutions())(within)[0]
    expected = np.zeros(CELLS)
    K, fine = getattr(coefficients[1], component), np.arange(PARTS) - PARTS // 2
    for place in np.ndindex(CELLS):
        for k in range(3):
            di, dj = PARTS * (place[0] - i[k]) - fine, PARTS * (place[1] - j[k]) - fine
            sign_x, sign_y = (
                np.where(d < 0, s, 1) for d, s in zip((di, dj), PARITY[component], strict=True)
            )
            seen = K[np.abs(di)[:, None], np.abs(dj)] * sign_x[:, None] * sign_y
            expected[place] += np.sum(parts[k] * seen)
    scale = np.max(np.abs(expected))
    np.testing.assert_allclose(found, expected, rtol=0, atol=0.02 * scale)


def test_moments_are_told_by_the_spectrum_of_the_coefficients(coefficients):
    """Where they are differences; but those from end to end of the window, where no slopes are."""
    kernels = EdgeKernels("zz", *coefficients)
    plain = EdgeOperator([[(1, kernels)]], CELLS, Convolutions())
    nx, ny = offsets_for(CELLS)
    known = {"zz": even_transform(coefficients[0].zz[:nx, :ny])}
    by_spectrum = EdgeOperator([[(1, kernels)]], CELLS, Convolutions(), known)
    slopes, nothing = np.zeros((2, *CELLS)), Within.nothing(CELLS)
    slopes[:, 1:-1, 1:-1] = np.random.default_rng(6).normal(size=(2, CELLS[0] - 2, CELLS[1] - 2))
    within = Within(slopes, nothing.i, nothing.j, nothing.rest)
    expected, found = plain(within), by_spectrum(within)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13 * np.max(np.abs(expected)))
