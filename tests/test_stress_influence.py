"""Tests of the fields of a unit traction on one cell: closed form, layers and quadrature."""

import numpy as np
import pytest

from semi_analytical.frf.depth import Descent, Level, in_plane_stresses, material_at
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.stress.components import FIELDS, TRACTIONS
from semi_analytical.stress.field import depth_coefficients
from semi_analytical.stress.rectangle import half_space_response

GAUSS = np.polynomial.legendre.leggauss(16)
DYING = 42.0  # exp(-alpha z) is 1e-18 there


def fields_at(stack, level, point, transform, reach):
    """Fields (9, 3) at a point (x, y), each by q_x, q_y and p.

    transform  (m, n) -> transform of the traction
    reach      greatest distance between the point and a load, for the resolution

    Half of the circle suffices: fields and tractions are real.
    """
    limit = DYING / level.depth
    small = limit * 2.0 ** -np.arange(40.0, 10.0, -1)
    even = np.linspace(0, limit, int(limit * reach / 8) + 40)
    bounds = np.unique([0.0, *small, *even])
    middle, half = (bounds[1:] + bounds[:-1]) / 2, np.diff(bounds) / 2
    alpha = (middle[:, None] + half[:, None] * GAUSS[0]).ravel()
    weight = (half[:, None] * GAUSS[1]).ravel() * alpha
    u, stress = wave_response(stack, level, alpha)
    count = int(limit * reach / 2 + 40)
    total = np.zeros((9, 3))
    for angle in np.pi * np.arange(count) / count:
        c, s = np.cos(angle), np.sin(angle)
        turn, m, n = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), alpha * c, alpha * s
        wave = transform(m, n) * np.exp(1j * (m * point[0] + n * point[1])) * weight
        total[:3] += (turn @ (u @ wave) @ turn.T).real
        turned = np.einsum("ia,jb,kc,abc->ijk", turn, turn, turn, stress @ wave).real
        total[3:] += [turned[place] for place in PLACES]
    return total / (4 * np.pi**2) * 2 * np.pi / count


def wave_response(stack, level, alpha):
    """Displacements (3, 3, n) and stresses (3, 3, 3, n) by tractions along a wave, across it and
    normal."""
    fields = Descent(stack, alpha).at(level)
    plane = in_plane_stresses(fields, material_at(stack, level), alpha)
    u, stress = np.zeros((3, 3, len(alpha)), complex), np.zeros((3, 3, 3, len(alpha)), complex)
    # A traction t_s along the wave vector is Q = -i t_s, and u_s = iU.
    u[0, ::2] = fields.displacement[0] * np.array([[1], [1j]])
    u[2, ::2] = fields.displacement[1] * np.array([[-1j], [1]])
    u[1, 1] = fields.transverse_displacement
    stress[0, 0, ::2] = plane.along * np.array([[-1j], [1]])
    stress[1, 1, ::2] = plane.across * np.array([[-1j], [1]])
    stress[0, 1, 1] = stress[1, 0, 1] = 1j * plane.shear
    stress[0, 2, ::2] = stress[2, 0, ::2] = -fields.traction[0] * np.array([[1], [1j]])
    stress[2, 2, ::2] = fields.traction[1] * np.array([[1j], [-1]])
    stress[1, 2, 1] = stress[2, 1, 1] = -fields.transverse_traction
    return u, stress


def cell_transform(dx, dy):
    """Transform of one on a cell at the origin."""
    return lambda m, n: dx * dy * np.sinc(m * dx / 2 / np.pi) * np.sinc(n * dy / 2 / np.pi)


DX = 1.0
DY = 0.6
# xx, yy, zz, yz, xz, xy as places in the tensor
PLACES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
BODIES = {
    "stiff layer": Stack([(5.0, 0.2, 0.4)], (1.0, 0.45)),
    "soft layer, incompressible base": Stack([(0.1, 0.3, 0.4)], (1.0, 0.5)),
    "incompressible under stiff": Stack([(3.0, 0.1, 0.2), (0.3, 0.5, 0.4)], (1.0, 0.3)),
    "rigid base": Stack([(1.0, 0.5, 0.5), (0.4, 0.3, 0.6)]),
}


def under_cell(x, y, z, nu, G=1.7):
    """Fields (9, 3) at a point by unit tractions on the cell DX by DY at the origin."""
    corners = np.array([x - DX / 2, x + DX / 2]), np.array([y - DY / 2, y + DY / 2])
    return half_space_response(*corners, z, HalfSpace(G, nu))[..., 0, 0]


def test_closed_form_carries_the_traction_at_the_surface():
    loaded, beside = under_cell(0.2, 0.1, 0.0, 0.3), under_cell(0.8, 0.1, 0.0, 0.3)
    # zz, yz, xz by (q_x, q_y, p)
    np.testing.assert_allclose(loaded[5:8], [[0, 0, -1], [0, -1, 0], [-1, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(beside[5:8], 0, atol=1e-15)


def test_closed_form_moves_the_surface_like_the_surface_coefficients():
    surface = HalfSpaceCoefficients((DX, DY), (3, 2), 1.7, 0.3)
    moved = under_cell(2 * DX, DY, 0.0, 0.3)[:3]
    xx, yy, zz, xy, zx, zy = (surface[name][2, 1] for name in ("xx", "yy", "zz", "xy", "zx", "zy"))
    expected = [[xx, xy, -zx], [xy, yy, -zy], [zx, zy, zz]]
    np.testing.assert_allclose(moved, expected, rtol=1e-13)


def scales(coefficients):
    """Largest response of each field, to judge rounding by."""
    return np.abs(coefficients).max(axis=(1, 2, 3))[:, None, None, None]


@pytest.mark.parametrize("thickness", [20.0, 0.3, 1e-3])
def test_layer_of_the_substrates_material_is_not_there(thickness):
    """From layers twice as thick as the window is wide to a hundredth of a cell."""
    spacing, shape = (0.1, 0.08), (50, 50)
    layered = Stack([(1.7, 0.3, thickness)], (1.7, 0.3))
    depths = [0.0, 0.5 * thickness, thickness, thickness, 1.5 * thickness]
    levels = tuple(Level(z, k) for z, k in zip(depths, (0, 0, 0, 1, 1), strict=True))
    alone = tuple(Level(z, 0) for z in depths)
    pairs = zip(
        depth_coefficients(layered, levels, spacing, shape),
        depth_coefficients(Stack((), (1.7, 0.3)), alone, spacing, shape),
        strict=True,
    )
    assert len(levels) == 5
    for found, expected in pairs:
        # Rounding of the corners does not fall with the depth as the coefficients do: 1e-16 each,
        # where one cell at the surface has 1.
        assert np.all(np.abs(found - expected) <= 1e-14 + 1e-12 * scales(expected))


@pytest.mark.parametrize(
    ("name", "place"), list(zip(BODIES, [(5, 3), (0, 0), (2, 1), (0, 3)], strict=True))
)
def test_coefficients_are_the_transform_of_the_frf(name, place):
    """Every component by quadrature over the plane of wave vectors, on both sides."""
    stack, spacing = BODIES[name], (0.25, 0.15)
    first = stack.layers[0].thickness
    levels = (Level(0.9 * first, 0), Level(first + 0.1, 1))
    point = place[0] * spacing[0], place[1] * spacing[1]
    cell = cell_transform(*spacing)
    assert len(TRACTIONS) == 3
    for level, found in zip(
        levels, depth_coefficients(stack, levels, spacing, (9, 9)), strict=True
    ):
        by_tractions = fields_at(stack, level, point, cell, reach=np.hypot(*point) + 1.5)
        for traction, expected in enumerate(by_tractions.T):
            for field in range(len(FIELDS)):
                scale = max(1e-3, np.abs(expected).max())
                assert found[field, traction][place] == pytest.approx(
                    expected[field], abs=1e-11 * scale
                ), (FIELDS[field], TRACTIONS[traction])
