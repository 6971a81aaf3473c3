"""The laws that any surface FRF obeys, numbered P1 to P20, over random stacks."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from stack_strategies import (
    ANGLES,
    FILMS,
    HALF_SPACES,
    MODULI,
    RATIOS,
    THICKNESSES,
    WAVE_VECTORS,
    WAVENUMBERS,
    stacks,
)

from semi_analytical.frf.matrix import composite_frf_matrix, frf_matrix
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import half_space_scalars, remainder_scalars, scalars
from semi_analytical.influence.layered import LayeredCoefficients

# Rounding of one evaluation, relative to the largest entry: the FRFs are right to about 1e-15.
ROUNDING = 1e-14
# Bound of the echo of whatever lies below the outer layer, in units of 1/(G alpha): 24 (1 - nu) is
# reached on the softest base at x = 1.
ECHO = 50.0
FACTORS = st.floats(-3, 3).map(lambda decade: 10**decade)


def assert_same(F, expected, tolerance=ROUNDING):
    """Equal up to a tolerance relative to the largest entry."""
    assert np.abs(F - expected).max() <= tolerance * np.abs(expected).max()


def assert_grows(larger, smaller, tolerance=ROUNDING):
    """larger - smaller is positive semidefinite up to rounding (Loewner order)."""
    assert np.linalg.eigvalsh(larger - smaller).min() >= -tolerance * np.abs(larger).max()


def with_film(stack, index, film):
    return Stack([*stack.layers[:index], film, *stack.layers[index + 1 :]], stack.base)


@given(stacks(), WAVE_VECTORS)
def test_p1_frf_is_hermitian(stack, k):
    """Betti's reciprocity."""
    F = frf_matrix(stack, *k)
    np.testing.assert_array_equal(F, F.conj().T)


@given(stacks(), WAVE_VECTORS)
def test_p2_real_tractions_give_real_displacements(stack, k):
    m, n = k
    np.testing.assert_array_equal(frf_matrix(stack, -m, -n), frf_matrix(stack, m, n).conj())


@given(stacks(), WAVE_VECTORS)
def test_p3_normal_tangential_coupling_is_imaginary_and_odd(stack, k):
    m, n = k
    F, turned = frf_matrix(stack, m, n), frf_matrix(stack, -m, -n)
    assert np.all(F[[0, 0, 1, 1, 2], [0, 1, 0, 1, 2]].imag == 0)
    np.testing.assert_array_equal(F[:2, 2].real, 0)
    np.testing.assert_array_equal(F[:2, 2], -turned[:2, 2])
    np.testing.assert_array_equal(F[2, :2], -F[:2, 2])


@given(stacks(), WAVE_VECTORS)
def test_p4_strain_energy_is_positive(stack, k):
    F = frf_matrix(stack, *k)
    # Nearly incompressible film on a rigid base: the smallest eigenvalue is (alpha h)^2 of the
    # largest, which rounding may not turn negative but may hide.
    assert np.linalg.eigvalsh(F).min() > -ROUNDING * np.abs(F).max()
    c11, c12, c22, csh = scalars(stack, np.hypot(*k))
    assert c11 > 0
    assert c22 > 0
    assert csh > 0
    assert c11 * c22 > c12**2


@given(HALF_SPACES, WAVENUMBERS)
def test_p4_determinant_of_a_half_space(material, alpha):
    G, nu = material
    c11, c12, c22, _ = half_space_scalars(HalfSpace(G, nu), alpha)
    assert c11 * c22 - c12**2 == pytest.approx((3 - 4 * nu) / (2 * G * alpha) ** 2, rel=1e-13)


@given(stacks(), WAVE_VECTORS, ANGLES, st.booleans())
def test_p5_frf_turns_with_the_axes(stack, k, angle, mirrored):
    cos, sin = np.cos(angle), np.sin(angle)
    Q = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
    if mirrored:
        Q = Q @ np.diag([1, -1, 1])
    m, n = Q[:2, :2] @ k
    assert_same(frf_matrix(stack, m, n), Q @ frf_matrix(stack, *k) @ Q.T)


@given(stacks(), WAVE_VECTORS)
def test_p6_isotropic_layers_do_not_tell_x_from_y(stack, k):
    m, n = k
    F, swapped = frf_matrix(stack, m, n), frf_matrix(stack, n, m)
    order = [1, 0, 2]
    assert_same(swapped, F[np.ix_(order, order)])
    assert F[0, 1] == F[1, 0]


@given(stacks(), WAVE_VECTORS, FACTORS, FACTORS)
def test_p7_lengths_and_moduli_scale_out(stack, k, length, stiffness):
    m, n = k
    films = [(G * stiffness, nu, h * length) for G, nu, h in stack.layers]
    base = None if stack.base is None else (stack.base[0] * stiffness, stack.base[1])
    F = frf_matrix(Stack(films, base), m / length, n / length)
    assert_same(F, frf_matrix(stack, m, n) * length / stiffness)


@given(HALF_SPACES, st.lists(THICKNESSES, min_size=1, max_size=5), WAVENUMBERS)
def test_p8_layers_of_one_material_are_a_half_space(material, thicknesses, alpha):
    layered = Stack([(*material, h) for h in thicknesses], material)
    expected = np.array(half_space_scalars(HalfSpace(*material), alpha))
    assert_same(np.array(scalars(layered, alpha)), expected)


@given(MODULI, RATIOS, HALF_SPACES)
def test_p9_vanishing_layer_leaves_the_substrate_at_first_order(G, nu, base):
    alpha = 1.0
    limit = np.array(scalars(Stack((), base), alpha))
    thin = 1e-4 * min(G / base[0], base[0] / G)
    far, near = (
        np.abs(np.array(scalars(Stack([(G, nu, h)], base), alpha)) - limit).max()
        for h in (2 * thin, thin)
    )
    assert far < 50 * thin * max(G / base[0] ** 2, 1 / G)
    rounding = 1e-15 * limit.max()
    assert far <= 2.5 * near + 20 * rounding


@given(stacks(min_layers=1), st.floats(1, 300))
def test_p10_short_waves_feel_the_outer_layer_alone(stack, x):
    alpha = x / stack.layers[0].thickness
    outer = half_space_scalars(stack.outer, alpha)
    bound = ECHO * (1 + x * x) * np.exp(-2 * x) + ROUNDING
    difference = np.subtract(scalars(stack, alpha), outer)
    assert np.abs(difference).max() <= bound * float(outer.csh)


@given(stacks(min_layers=1), WAVE_VECTORS, st.lists(st.floats(0.05, 1), min_size=2, max_size=6))
def test_p11_cutting_a_layer_changes_nothing(stack, k, parts):
    G, nu, h = stack.layers[0]
    pieces = [(G, nu, h * part / sum(parts)) for part in parts]
    cut = Stack([*pieces, *stack.layers[1:]], stack.base)
    assert_same(frf_matrix(cut, *k), frf_matrix(stack, *k), 1e-11)


@given(stacks(), WAVE_VECTORS, HALF_SPACES, st.integers(0, 5))
def test_p11_a_layer_of_almost_no_thickness_changes_nothing(stack, k, material, place):
    # Thinner than rounding: at most max(G)/min(G) alpha h = 1e6 * 1e4 * 1e-28.
    films = [*stack.layers[:place], (*material, 1e-28), *stack.layers[place:]]
    assert_same(frf_matrix(Stack(films, stack.base), *k), frf_matrix(stack, *k))


@given(stacks(), WAVE_VECTORS, st.floats(1, 1e3), st.integers(0, 5))
def test_p12_stiffer_material_yields_less(stack, k, factor, place):
    if place < len(stack.layers):
        G, nu, h = stack.layers[place]
        stiffer = with_film(stack, place, (factor * G, nu, h))
    elif stack.base is not None:
        stiffer = Stack(stack.layers, (factor * stack.base[0], stack.base[1]))
    else:
        return
    assert_grows(frf_matrix(stack, *k), frf_matrix(stiffer, *k))


@given(stacks(min_layers=1), WAVE_VECTORS, RATIOS)
def test_p12_larger_poisson_ratio_at_fixed_shear_modulus_yields_less(stack, k, other):
    G, nu, h = stack.layers[0]
    low, high = sorted([nu, other])
    assert_grows(
        frf_matrix(with_film(stack, 0, (G, low, h)), *k),
        frf_matrix(with_film(stack, 0, (G, high, h)), *k),
    )


@given(HALF_SPACES, st.floats(1, 1e3), THICKNESSES, st.floats(1, 10), WAVE_VECTORS)
def test_p13_thicker_soft_layer_yields_more(base, softer, h, factor, k):
    G, nu = base
    thin, thick = (Stack([(G / softer, nu, t)], base) for t in (h, factor * h))
    assert_grows(frf_matrix(thick, *k), frf_matrix(thin, *k))


@given(FILMS, HALF_SPACES, WAVE_VECTORS)
def test_p13_response_lies_between_the_two_half_spaces(film, base, k):
    G, nu, h = film
    stiffer = (max(G, base[0]), max(nu, base[1]))
    F = frf_matrix(Stack([(min(G, base[0]), min(nu, base[1]), h)], stiffer), *k)
    assert_grows(frf_matrix(Stack((), (min(G, base[0]), min(nu, base[1]))), *k), F)
    assert_grows(F, frf_matrix(Stack((), stiffer), *k))


@given(FILMS, WAVE_VECTORS)
def test_p13_rigid_base_yields_less_than_the_half_space(film, k):
    G, nu, _ = film
    assert_grows(frf_matrix(Stack((), (G, nu)), *k), frf_matrix(Stack([film]), *k))


@given(st.lists(FILMS, min_size=1, max_size=4), RATIOS, st.floats(0.01, 10))
def test_p14_rigid_base_is_the_limit_of_stiff_ones(films, nu, x):
    alpha = x / films[-1][2]
    rigid = np.array(scalars(Stack(films), alpha))
    G = films[-1][0] * 1e5 * max(1.0, 1 / x)
    far, near = (
        np.abs(np.array(scalars(Stack(films, (stiff, nu)), alpha)) - rigid).max()
        for stiff in (G, 10 * G)
    )
    noise = 1e-14 * rigid.max()
    assert 9 * near <= far + 20 * noise
    assert far <= 11 * near + 20 * noise


@given(MODULI, THICKNESSES, st.floats(-0.95, 0.49))
def test_p14_long_waves_over_a_rigid_base_compress_and_shear_the_layer(G, h, nu):
    c11, _, c22, csh = scalars(Stack([(G, nu, h)]), 1e-6 / h)
    assert c11 == pytest.approx(h / G, rel=1e-9)
    assert csh == pytest.approx(h / G, rel=1e-9)
    assert c22 == pytest.approx(h * (1 - 2 * nu) / (2 * G * (1 - nu)), rel=1e-9)


@given(MODULI, THICKNESSES)
def test_p14_long_waves_over_a_rigid_base_squeeze_an_incompressible_layer(G, h):
    x = 1e-5
    _, c12, c22, _ = scalars(Stack([(G, 0.5, h)]), x / h)
    assert c22 == pytest.approx(x**2 * h / (3 * G), rel=1e-9)
    assert c12 == pytest.approx(-x * h / (2 * G), rel=1e-9)


@given(stacks(min_layers=1), WAVENUMBERS)
def test_p15_nothing_happens_at_the_incompressible_limit(stack, alpha):
    G, _, h = stack.layers[0]
    limit = np.array(scalars(with_film(stack, 0, (G, 0.5, h)), alpha))
    close = np.array(scalars(with_film(stack, 0, (G, 0.5 - 1e-13, h)), alpha))
    # d(1/M)/d(nu) = -4/G per unit thickness, at most, and a few more for c11 and c12.
    assert np.abs(close - limit).max() <= 1e-12 * limit.max() + 1e-12 * min(h, 1 / alpha) / G


@given(stacks(min_layers=1, max_layers=1), st.floats(1, 1e3))
def test_p16_remainder_of_one_layer_dies_like_its_echo(stack, x):
    G, _, h = stack.layers[0]
    echo = np.array(remainder_scalars(stack, x / h)) * (x / h) * G
    assert np.abs(echo).max() <= (ECHO if x < 2 else ECHO / 3) * (1 + x * x) * np.exp(-2 * x)


@given(stacks(), st.floats(3, 6))
def test_p17_nothing_overflows(stack, decade):
    F = frf_matrix(stack, 10**decade, -(10**decade))
    assert np.all(np.isfinite(F))
    assert np.all(np.isfinite(np.array(remainder_scalars(stack, 10**decade))))


def depth_system(G, nu, alpha):
    """Matrix of d/dz (U, W, tau_s, tau_z) in a layer."""
    ratio, modulus = nu / (1 - nu), 2 * G / (1 - nu)
    return np.array(
        [
            [0, -alpha, -1 / G, 0],
            [ratio * alpha, 0, 0, -(1 - 2 * nu) / (2 * G * (1 - nu))],
            [-(alpha**2) * modulus, 0, 0, -alpha * ratio],
            [0, 0, alpha, 0],
        ]
    )


@given(stacks(min_layers=1, max_layers=3), st.floats(0.1, 3))
def test_p18_equilibrium_over_the_depth_gives_the_surface_response(stack, x):
    """Integrate equilibrium with continuous displacement and traction from the base upward."""
    alpha = x / sum(film.thickness for film in stack.layers)
    response = np.zeros((2, 2))
    if stack.base is not None:
        c11, c12, c22, _ = half_space_scalars(stack.base, alpha)
        response = np.array([[c11, c12], [c12, c22]])
    for G, nu, h in reversed(stack.layers):
        # Unit displacement G / alpha keeps the exponential well scaled.
        scale = np.array([1 / (G * alpha), 1 / (G * alpha), 1, 1])
        system = depth_system(G, nu, alpha) * scale / scale[:, None]
        state = expm(-system * h) @ np.vstack([response * G * alpha, np.eye(2)])
        response = np.linalg.solve(state[2:].T, state[:2].T).T / (G * alpha)
    c11, c12, c22, _ = scalars(stack, alpha)
    assert_same(np.array([[c11, c12], [c12, c22]]), response, 1e-8)


@given(stacks(), WAVE_VECTORS, st.integers(0, 2**32 - 1))
def test_p19_any_traction_does_positive_work(stack, k, seed):
    t = np.random.default_rng(seed).normal(size=(3, 2)) @ [1, 1j]
    F = frf_matrix(stack, *k)
    assert (t.conj() @ F @ t).real > -ROUNDING * np.abs(F).max() * np.linalg.norm(t) ** 2


def dense_operator(K, shape):
    """All three displacements of every cell by all three tractions on every cell."""
    i, j = (index.ravel() for index in np.indices(shape))
    di, dj = i[:, None] - i, j[:, None] - j
    at = abs(di), abs(dj)
    odd_x, odd_y = np.sign(di), np.sign(dj)
    xy, zx, zy = K.xy[at] * odd_x * odd_y, K.zx[at] * odd_x, K.zy[at] * odd_y
    return np.block([[K.xx[at], xy, -zx], [xy, K.yy[at], -zy], [zx, zy, K.zz[at]]])


@given(stacks(), st.floats(0.1, 10), st.floats(0.2, 5))
def test_p19_discrete_operator_is_symmetric_and_does_positive_work(stack, size, aspect):
    spacing = (size, size * aspect)
    operator = dense_operator(LayeredCoefficients(stack, spacing, (4, 3)), (4, 3))
    assert_same(operator, operator.T, 1e-15)
    assert np.linalg.eigvalsh(operator).min() > -1e-11 * np.abs(operator).max()


@given(stacks(), WAVE_VECTORS)
def test_p20_identical_bodies_do_not_couple(stack, k):
    F = composite_frf_matrix(stack, stack, *k)
    assert not np.any(F[:2, 2])
    assert not np.any(F[2, :2])
    twice = 2 * frf_matrix(stack, *k)
    assert_same(F[:2, :2], twice[:2, :2])
    assert F[2, 2] == twice[2, 2]


@given(HALF_SPACES, WAVE_VECTORS)
def test_p20_two_identical_half_spaces_are_one_of_half_the_stiffness(material, k):
    G, nu = material
    body = Stack((), material)
    soft = frf_matrix(Stack((), (G / 2, nu)), *k)
    soft[:2, 2] = soft[2, :2] = 0
    assert_same(composite_frf_matrix(body, body, *k), soft)


@given(stacks(), stacks(), WAVE_VECTORS)
def test_p20_bodies_change_roles_by_reflection_in_the_contact_plane(lower, upper, k):
    J = np.diag([1, 1, -1])
    F = composite_frf_matrix(lower, upper, *k)
    np.testing.assert_array_equal(composite_frf_matrix(upper, lower, *k), J @ F @ J)
