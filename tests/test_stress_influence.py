"""Fields by a unit traction on one cell: closed form and layers, against laws and quadrature."""

import numpy as np
import pytest
from polar_synthesis import cell_transform, fields_at

from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.influence.closed_form import HalfSpaceCoefficients, RectangleIntegrals
from semi_analytical.stress.cells import depth_coefficients
from semi_analytical.stress.components import FIELDS, TRACTIONS
from semi_analytical.stress.levels import interfaces
from semi_analytical.stress.rectangle import RectanglePotentials, half_space_response

DX, DY = 1.0, 0.6
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
    return half_space_response(RectanglePotentials(*corners, z), HalfSpace(G, nu), z)[..., 0, 0]


def tensor(fields):
    """Stress tensors (3, 3, ...) of fields (9, ...)."""
    stress = np.zeros((3, 3, *fields.shape[1:]))
    for (i, j), values in zip(PLACES, fields[3:], strict=True):
        stress[i, j] = stress[j, i] = values
    return stress


@pytest.mark.parametrize("nu", [-0.3, 0.0, 0.28])
@pytest.mark.parametrize("point", [(0.2, 0.1, 0.3), (1.3, -0.7, 0.5), (0.1, 0.9, 0.2)])
def test_closed_form_obeys_hooke_and_equilibrium(nu, point):
    step, G = 1e-3, 1.7

    def slope(axis):
        shifts = [np.array(point) + k * step * np.eye(3)[axis] for k in (-2, -1, 1, 2)]
        a, b, c, d = (under_cell(*shifted, nu) for shifted in shifts)
        return (a - 8 * b + 8 * c - d) / (12 * step)

    slopes = np.stack([slope(axis) for axis in range(3)])
    gradient = slopes[:, :3]
    strain = (gradient + gradient.transpose(1, 0, 2)) / 2
    volume = np.einsum("kkt->t", strain) * np.eye(3)[..., None]
    hooke = 2 * G * (strain + nu / (1 - 2 * nu) * volume)
    np.testing.assert_allclose(tensor(under_cell(*point, nu)), hooke, atol=1e-8)
    divergence = np.einsum("iijt->jt", np.stack([tensor(each) for each in slopes]))
    np.testing.assert_allclose(divergence, 0, atol=1e-8)


def test_closed_form_carries_the_traction_at_the_surface():
    loaded, beside = under_cell(0.2, 0.1, 0.0, 0.3), under_cell(0.8, 0.1, 0.0, 0.3)
    # zz, yz, xz by (q_x, q_y, p)
    np.testing.assert_allclose(loaded[5:8], [[0, 0, -1], [0, -1, 0], [-1, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(beside[5:8], 0, atol=1e-15)


def test_closed_form_moves_the_surface_like_the_surface_coefficients():
    surface = HalfSpaceCoefficients(RectangleIntegrals(DX, DY, (3, 2)), 1.7, 0.3)
    moved = under_cell(2 * DX, DY, 0.0, 0.3)[:3]
    xx, yy, zz, xy, zx, zy = (
        getattr(surface, name)[2, 1] for name in ("xx", "yy", "zz", "xy", "zx", "zy")
    )
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
    for found, expected in pairs:
        # Rounding of the corners does not fall with the depth as the coefficients do: 1e-16 each,
        # where one cell at the surface has 1.
        assert np.all(np.abs(found - expected) <= 1e-14 + 1e-12 * scales(expected))


@pytest.mark.parametrize("name", BODIES)
def test_tractions_and_displacements_are_continuous_across_interfaces(name):
    stack = BODIES[name]
    for sides in interfaces(stack):
        above, *below = depth_coefficients(stack, sides, (0.05, 0.07), (40, 30))
        if not below:  # on a rigid base
            assert np.all(np.abs(above[:3]) < 1e-14)
            continue
        for field in (0, 1, 2, 5, 6, 7):
            scale = np.abs(above[field]).max()
            np.testing.assert_allclose(above[field], below[0][field], rtol=0, atol=1e-11 * scale)


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
    for level, found in zip(
        levels, depth_coefficients(stack, levels, spacing, (9, 9)), strict=True
    ):
        for traction in range(len(TRACTIONS)):
            transforms = [0.0, 0.0, 0.0]

            def applied(m, n, transforms=transforms, traction=traction):
                return [cell(m, n) if k == traction else 0.0 for k in range(len(transforms))]

            expected = fields_at(stack, level, point, applied, reach=np.hypot(*point) + 1.5)
            for field in range(len(FIELDS)):
                scale = max(1e-3, np.abs(expected).max())
                assert found[field, traction][place] == pytest.approx(
                    expected[field], abs=1e-11 * scale
                ), (FIELDS[field], TRACTIONS[traction])
