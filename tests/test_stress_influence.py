"""Tests of the fields of a unit traction on one cell: closed form, layers, laws and quadrature."""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from stack_strategies import WAVENUMBERS, stacks

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.frf.depth import Descent, Level, in_plane_stresses, material_at
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.grid import SurfaceGrid
from semi_analytical.influence.closed_form import HalfSpaceCoefficients, RectangleIntegrals
from semi_analytical.stress import default_depths, interfaces, subsurface, subsurface_section
from semi_analytical.stress.components import FIELDS, TRACTIONS
from semi_analytical.stress.convolution import mirror_planes
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
    depth = level.depth
    limit = DYING / depth
    panels = int(limit * reach / 8) + 40
    bounds = np.concatenate([[0.0], limit * 2.0 ** -np.arange(40.0, 10.0, -1)])
    bounds = np.concatenate([bounds, np.linspace(0, limit, panels)[1:]])
    bounds = np.unique(bounds)
    middle, half = (bounds[1:] + bounds[:-1]) / 2, np.diff(bounds) / 2
    alpha = (middle[:, None] + half[:, None] * GAUSS[0]).ravel()
    weight = (half[:, None] * GAUSS[1]).ravel() * alpha
    waves = [w[..., None] for w in _wave_fields(stack, level, alpha)]
    count = int(limit * reach / 2 + 40)
    total = np.zeros((9, 3))
    for part in np.array_split(np.arange(count), max(1, count * len(alpha) // 400_000)):
        theta = np.pi * part / count
        m, n = np.outer(alpha, np.cos(theta)), np.outer(alpha, np.sin(theta))
        response = _in_scene_axes(waves, np.cos(theta), np.sin(theta))
        shift = transform(m, n) * np.exp(1j * (m * point[0] + n * point[1])) * weight[:, None]
        for field, traction in np.ndindex(total.shape):
            total[field, traction] += np.real(np.sum(response[field][traction] * shift))
    return total / (4 * np.pi**2) * 2 * np.pi / count


def _wave_fields(stack, level, alpha):
    fields = Descent(stack, alpha).at(level)
    plane = in_plane_stresses(fields, material_at(stack, level), alpha)
    return (
        *fields.displacement.reshape(4, -1),
        *fields.traction.reshape(4, -1),
        *plane.along,
        *plane.across,
        fields.transverse_displacement,
        fields.transverse_traction,
        plane.shear,
    )


def _in_scene_axes(waves, c, s):
    """Complex responses [field][traction], by the projections of each traction on s and t."""
    U_q, U_p, W_q, W_p, s_q, s_p, n_q, n_p = waves[:8]
    along_q, along_p, across_q, across_p, u_t, t_t, shear = waves[8:]
    rows = []
    # t_s = iQ: a traction t_s along the wave vector is Q = -i t_s.
    for t_s, t_t_load, p in ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)):
        Q = -1j * t_s
        us, uz = 1j * (U_q * Q + U_p * p), W_q * Q + W_p * p
        ut = u_t * t_t_load
        sz, zz = -1j * (s_q * Q + s_p * p), -(n_q * Q + n_p * p)
        tz = -t_t * t_t_load
        ss, tt = along_q * Q + along_p * p, across_q * Q + across_p * p
        st = 1j * shear * t_t_load
        rows.append(
            [
                *(c * us - s * ut, s * us + c * ut, uz),
                c * c * ss - 2 * s * c * st + s * s * tt,
                s * s * ss + 2 * s * c * st + c * c * tt,
                zz,
                *(s * sz + c * tz, c * sz - s * tz),
                s * c * (ss - tt) + (c * c - s * s) * st,
            ]
        )
    return list(zip(*rows, strict=True))


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


# ---- Fields below a contact: Hertz, Hamilton, coated quadrature, interfaces, equilibrium, e


NU = 0.3
MU = 0.25
HALF_SPACE = Stack((), (1.0, NU))
COATED = Stack([(3.0, 0.2, 0.3), (0.5, 0.5, 0.4)], (1.0, 0.3))
XX, YY, ZZ, YZ, XZ, XY = range(6)
GRID = SurfaceGrid((8, 8), (1.0, 1.0))
LOAD = np.ones((8, 8))


@pytest.mark.parametrize("stack", [HALF_SPACE, COATED], ids=["homogeneous", "coated"])
def test_every_plane_carries_the_load(stack):
    """Sum of the tractions on a plane; beyond a window of half side L about (z/L)^3 is missing."""
    grid = SurfaceGrid((100, 100), (40.0, 40.0))
    pressure = np.where(np.hypot(*grid.coordinates()) < 1.5, 1.0, 0.0)
    field = subsurface(stack, grid, pressure, None, [0.2, 0.6, 1.2])
    carried = field.stress.sum(axis=(2, 3)) / pressure.sum()
    np.testing.assert_allclose(carried[:, ZZ], -1, atol=1e-3)
    np.testing.assert_allclose(carried[:, [XZ, YZ, XY]], 0, atol=1e-12)


def test_section_is_the_plane_at_y(rng):
    for cells in ((24, 20), (24, 21)):
        grid = SurfaceGrid(cells, (2.4, 2.0))
        pressure, shear = rng.random(cells), rng.normal(size=(2, *cells))
        levels = default_depths(COATED, 0.5)[::5]
        whole = subsurface(COATED, grid, pressure, shear, levels)
        for y in (0.0, 0.43, grid.y[0]):
            section = subsurface_section(COATED, grid, pressure, shear, levels, y=y)
            np.testing.assert_allclose(section.stress, whole.along_x(y).stress, atol=1e-12)
            np.testing.assert_allclose(
                section.displacement, whole.along_x(y).displacement, atol=1e-12
            )


@pytest.mark.parametrize("cells", [(12, 10), (11, 10)])
@pytest.mark.parametrize("axes", [(0,), (1,), (0, 1)], ids=["x", "y", "both"])
def test_mirrored_tractions_have_the_sum_of_the_fields_of_their_parts(axes, cells, rng):
    """The parts are not symmetric; the sum uses its mirror planes."""
    grid = SurfaceGrid(cells, (1.2, 1.0))
    tractions = rng.normal(size=(3, *cells))
    for axis in axes:
        image = np.flip(tractions, 1 + axis).copy()
        image[axis] *= -1
        tractions = tractions + image
    assert np.flatnonzero(mirror_planes(tractions)).tolist() == list(axes)
    part = rng.random(cells) * tractions
    whole, one, other = (
        subsurface(COATED, grid, p, np.stack([q_x, q_y]), [0.05, 0.5])
        for q_x, q_y, p in (tractions, part, tractions - part)
    )
    np.testing.assert_allclose(whole.stress, one.stress + other.stress, atol=1e-12)
    np.testing.assert_allclose(
        whole.displacement, one.displacement + other.displacement, atol=1e-12
    )


def test_a_number_on_an_interface_is_its_upper_side():
    field = subsurface(COATED, GRID, LOAD, None, [0.1, 0.3 * (1 + 1e-15), 0.5, 0.7, 0.8])
    assert [level.layer for level in field.levels] == [0, 0, 1, 1, 2]


STEEL = IsotropicMaterial(young_modulus=2.6, poisson_ratio=0.3)


def test_default_depths_reach_both_sides_of_every_interface():
    body = Body(material=STEEL, layers=[Layer(thickness=0.02, material=STEEL)])
    levels = default_depths(body, 1.0)
    assert levels[0] == Level(0.0, 0)
    assert {Level(0.02, 0), Level(0.02, 1)} <= set(levels)
    assert [level.depth for level in levels] == sorted(level.depth for level in levels)
    assert sum(level.layer == 0 for level in levels) >= 5
    rigid = Body(material=RIGID, layers=[Layer(thickness=0.5, material=STEEL)])
    assert max(level.depth for level in default_depths(rigid, 1.0)) == 0.5
    assert interfaces(rigid) == ((Level(0.5, 0),),)


@pytest.mark.parametrize(
    ("stack", "depth", "complaint"),
    [
        (COATED, -0.1, "expected a finite length >= 0"),
        (COATED, float("nan"), "expected a finite length >= 0"),
        (Stack([(1.0, 0.3, 0.5)]), 0.6, "rigid base"),
        (COATED, Level(0.1, 2), "outside of its layer"),
        (COATED, Level(0.1, 3), "does not exist"),
        (Stack([(1.0, 0.3, 0.5)]), Level(0.5, 1), "does not exist"),
        (Stack(), 0.1, "the body is rigid"),
    ],
)
def test_depths_outside_of_the_body_are_refused(stack, depth, complaint):
    with pytest.raises(ValueError, match=complaint):
        subsurface(stack, GRID, LOAD, None, [depth])


# ---- Fields at depth in wavenumber space: multi-precision values, the differential equations,


# Rounding of one evaluation, relative to the largest entry of its kind.
ROUNDING = 1e-14


class Case(NamedTuple):
    layers: list[tuple[float, float, float]]
    base: tuple[float, float] | None
    alpha: float
    level: Level
    # (U, u_z) and (tau_s, tau_z) row by row, then u_t and tau_t
    values: list[float]


# fmt: off
CASES = {
    "one layer": Case(
        [(3.0, 0.2, 0.7)], (1.0, 0.4), 2.5, Level(0.3, 0),
        [
            0.028148142464754423, -0.0030108494533656223,
            0.062247562239409804, 0.10807935687313466,
            0.04287858094110001, -0.4778028122139896,
            0.317600368997999, 0.7654308471871463,
            0.06827492651293669, 0.4471540634896838,
        ],
    ),
    "one layer below": Case(
        [(3.0, 0.2, 0.7)], (1.0, 0.4), 2.5, Level(1.1, 1),
        [
            -0.01451876133526405, -0.02406618367570404,
            0.027026762235145555, 0.03764717254650364,
            -0.08152809303337848, -0.13003162471480564,
            0.12619952481866956, 0.1785351563962328,
            0.012981577071468265, 0.03245394267867066,
        ],
    ),
    "interface above": Case(
        [(3.0, 0.2, 0.7), (0.25, 0.5, 0.4)], (1.0, 0.5), 1.3, Level(0.7, 0),
        [
            0.0050257868788697, -0.1750990648976181,
            0.1459443643588708, 0.36653455249191286,
            0.059875916657044184, -0.009814909918034817,
            0.34025226614897935, 0.7830334746959788,
            0.20915490953165303, 0.1045668547205866,
        ],
    ),
    "incompressible layer": Case(
        [(3.0, 0.2, 0.7), (0.25, 0.5, 0.4)], (1.0, 0.5), 1.3, Level(0.9, 1),
        [
            -0.04689444400575478, -0.20117376175291993,
            0.13906898282240918, 0.31500016709912043,
            -0.02071998735566202, -0.14451690997217073,
            0.3449897604406819, 0.7626654606295605,
            0.13166508934716178, 0.09024778313569115,
        ],
    ),
    "incompressible base": Case(
        [(3.0, 0.2, 0.7), (0.25, 0.5, 0.4)], (1.0, 0.5), 1.3, Level(2.0, 2),
        [
            -0.04422306543197002, -0.09314889400296825,
            0.07251182639069205, 0.1441132791707962,
            -0.11497997012312206, -0.24218712440771745,
            0.18853074861579933, 0.37469452584407015,
            0.019592249028584207, 0.02546992373715947,
        ],
    ),
    "rigid base": Case(
        [(1.0, 0.5, 0.7)], None, 0.01, Level(0.5, 0),
        [
            0.19997716871283824, -0.0011999037418827828,
            -0.00019997656876285377, 1.266567922089108e-06,
            0.9998975091710525, -0.004999572538346768,
            0.004999712525211277, 0.9999875011467695,
            0.19999523343013303, 0.9999775004518661,
        ],
    ),
    "stiff thin film": Case(
        [(1000000.0, 0.3, 1e-06)], (1.0, 0.3), 1.0, Level(5e-07, 0),
        [
            0.2333333888889796, 0.06666667063484337,
            0.06666705158712795, 0.6619045929704778,
            0.666666563491477, -0.0952385515871048,
            4.166666388887105e-07, 0.9999999761903424,
            0.5000000000001459, 0.7499999999998229,
        ],
    ),
    "stiff thin film base": Case(
        [(1000000.0, 0.3, 0.01)], (1.0, 0.3), 1.0, Level(0.3, 1),
        [
            -0.0003230356295791996, -0.06878413602782889,
            0.0024260508708490937, 0.4828460790101539,
            -0.0015807446997227967, -0.3215958022700245,
            0.00391742830113379, 0.7816646278059411,
            7.481762765430411e-05, 7.481762765430411e-05,
        ],
    ),
    "soft thin film": Case(
        [(1e-06, 0.3, 1e-06)], (1.0, 0.3), 1.0, Level(5e-07, 0),
        [
            1.2000002999963162, 0.19999992499928929,
            0.20000060357064645, 0.8428570142854755,
            0.999999999997875, -2.14286000000156e-07,
            4.999999999994435e-07, 0.9999999999999464,
            1.499999999997896, 0.999999999999125,
        ],
    ),
    "soft film": Case(
        [(1e-06, 0.49, 1.0)], (1.0, 0.3), 0.001, Level(1.2, 1),
        [
            699.9581835711068, 199.18760995218554,
            200.7594540374327, 699.7674433744572,
            0.9995974170939738, -0.0011603593519146167,
            0.0011999580266256213, 0.9999993074926288,
            999.7995190990658, 0.9997995190990658,
        ],
    ),
    "thick": Case(
        [(3.0, -0.5, 10.0)], (1.0, 0.3), 20.0, Level(9.0, 0),
        [
            -9.9034218251121e-79, -9.959373360847196e-79,
            1.0183179503787584e-78, 1.0239131039522681e-78,
            -1.2018389875898753e-76, -1.2085531718780868e-76,
            1.2085531718780868e-76, 1.2152673561662983e-76,
            1.1190307147019321e-80, 6.714184288211594e-79,
        ],
    ),
}
# fmt: on


def flat(fields):
    """Displacements, tractions, transverse displacement and traction as four rows of entries."""
    return [np.asarray(part).reshape(-1, np.shape(part)[-1]) for part in fields]


def assert_same(one, other, tolerance=ROUNDING):
    """Equal up to a tolerance relative to the largest entry of the same kind and wavenumber."""
    for a, b in zip(flat(one), flat(other), strict=True):
        assert np.all(np.abs(a - b) <= tolerance * np.abs(b).max(axis=0) + 1e-300)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_fields_agree_with_sixty_digits(case):
    fields = Descent(Stack(case.layers, case.base), np.array([case.alpha])).at(case.level)
    values = np.array(case.values)[:, None]
    expected = values[:4].reshape(2, 2, 1), values[4:8].reshape(2, 2, 1), values[8], values[9]
    assert_same(fields, expected)


@st.composite
def placed(draw, **kinds):
    """A stack and a level in it."""
    stack = draw(stacks(**kinds))
    last = len(stack.layers) - (stack.base is None)
    layer = draw(st.integers(0, last))
    top = sum(film.thickness for film in stack.layers[:layer])
    thickness = stack.layers[layer].thickness if layer < len(stack.layers) else 10.0
    return stack, Level(top + draw(st.floats(0, 1)) * thickness, layer)


@given(stacks(), WAVENUMBERS)
def test_surface_carries_the_applied_tractions_and_moves_as_the_surface_frf_says(stack, alpha):
    alpha = np.array([alpha])
    fields, surface = Descent(stack, alpha).at(Level(0.0, 0)), scalars(stack, alpha)
    np.testing.assert_array_equal(fields.traction[..., 0], np.eye(2))
    assert fields.transverse_traction[0] == 1
    expected = np.array([[surface.c11, surface.c12], [surface.c12, surface.c22]])
    assert_same(fields, (expected, fields.traction, surface.csh, fields.transverse_traction))


@given(stacks(min_layers=1), WAVENUMBERS)
def test_displacement_and_traction_are_continuous_across_interfaces(stack, alpha):
    descent = Descent(stack, np.array([alpha]))
    assert stack.layers
    depth = 0.0
    for k, film in enumerate(stack.layers[: len(stack.layers) - (stack.base is None)]):
        depth = depth + film.thickness
        # The exponents add up in another order on either side.
        tolerance = 1e-12 + ROUNDING * (1 + alpha * depth) ** 2
        assert_same(descent.at(Level(depth, k)), descent.at(Level(depth, k + 1)), tolerance)


@given(placed(), WAVENUMBERS)
def test_in_plane_stresses_follow_hooke(where, alpha):
    """sigma_ss - nu (sigma_tt + sigma_zz) = E eps_ss, eps_ss = -alpha U; eps_tt = 0."""
    stack, level = where
    fields = Descent(stack, np.array([alpha])).at(level)
    G, nu = material = material_at(stack, level)
    plane = in_plane_stresses(fields, material, np.array([alpha]))
    normal = -fields.traction[1]
    E = 2 * G * (1 + nu)
    stretch = -alpha * fields.displacement[0]
    scale = ROUNDING * (np.abs(normal).max() + np.abs(E * stretch).max()) / (1 - nu)
    np.testing.assert_allclose(
        plane.along - nu * (plane.across + normal), E * stretch, rtol=0, atol=4 * scale
    )
    np.testing.assert_allclose(plane.across, nu * (plane.along + normal), rtol=0, atol=4 * scale)


@given(stacks(min_layers=1), WAVENUMBERS, st.floats(0, 1))
def test_remainder_is_the_difference_to_the_half_space(stack, alpha, part):
    film = stack.layers[0]
    depth = part * film.thickness
    x = alpha * film.thickness
    assume(x <= 300)
    alpha = np.array([alpha])
    whole = Descent(stack, alpha).at(Level(depth, 0))
    alone = Descent(Stack((), stack.outer), alpha).at(Level(depth, 0))
    added = Descent(stack, alpha).remainder(Level(depth, 0))
    assert len(flat(added)) == 4
    for a, b, c in zip(flat(whole), flat(alone), flat(added), strict=True):
        scale = np.abs(a).max() + np.abs(b).max()
        # The waves have the relative error of their exponents.
        assert np.all(np.abs(a - b - c) <= ROUNDING * (1 + x) ** 2 * scale)


@given(placed(), st.floats(4, 8))
def test_short_waves_die_out_without_overflow(where, decade):
    stack, level = where
    fields = Descent(stack, np.array([10**decade])).at(level)
    assert np.all(np.isfinite(np.concatenate(flat(fields))))


def test_nothing_is_known_within_a_rigid_base():
    stack = Stack([(1.0, 0.3, 1.0)])
    assert np.all(Descent(stack, np.array([1.0])).at(Level(1.0, 0)).displacement == 0)
    with pytest.raises(ValueError, match="rigid base"):
        Descent(stack, np.array([1.0])).at(Level(1.0, 1))
