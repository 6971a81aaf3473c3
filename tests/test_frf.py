"""Tests of surface FRFs of layered bodies against high-precision solves, and at extreme
wavenumbers."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from stack_strategies import stacks

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.frf.depth import Descent, Level
from semi_analytical.frf.response_matrix import response_matrix
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import half_space_scalars, remainder_scalars, scalars
from verification.laws.limit_laws import (
    LIMIT_LAWS,
    SYMMETRY_LAWS,
    Law,
    apart,
    combined,
    composite_frf_matrix,
    worst_violation,
)
from verification.references import load_reference

ROWS = load_reference("frf")["rows"]
# The claim; the worst found is 4e-16.
ACCURACY = 5e-15


def stack_of_row(row):
    base = None if row["base"] == "rigid" else (row["base"]["G"], row["base"]["nu"])
    return Stack([(film["G"], film["nu"], film["h"]) for film in row["layers_top_down"]], base)


def test_coupling_of_two_bodies_subtracts_and_the_rest_adds():
    """One of them is the other's mirror image: alike, they do not couple and give twice as much."""
    one, other = (scalars(stack_of_row(row), np.array([0.3, 2.0])) for row in ROWS[:2])
    both, swapped, alike = combined(one, other), combined(other, one), combined(one, one)
    for name in ("c11", "c22", "csh"):
        np.testing.assert_array_equal(getattr(alike, name), 2 * getattr(one, name))
        np.testing.assert_array_equal(
            getattr(both, name), getattr(one, name) + getattr(other, name)
        )
    np.testing.assert_array_equal(alike.c12, 0.0)
    np.testing.assert_array_equal(both.c12, -swapped.c12)
    np.testing.assert_array_equal(both.c12, one.c12 - other.c12)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: str(row["id"]))
def test_matrix_agrees_with_reference(row):
    F = {key: float(value) for key, value in row["F"].items()}
    xz, yz = 1j * F["im_xz"], 1j * F["im_yz"]
    expected = np.array([[F["xx"], F["xy"], xz], [F["xy"], F["yy"], yz], [-xz, -yz, F["zz"]]])
    got = response_matrix(stack_of_row(row), row["m"], row["n"])
    assert np.abs(got - expected).max() < ACCURACY * np.abs(expected).max()


# Scalars minus those of the outer half-space, from the hyperbolic form of the recursion evaluated
# with 60 digits and more than it cancels; layers (G, nu, h), base, alpha, (c11, c12, c22, csh).
REMAINDERS = [
    (
        [(2.0, 0.3, 1.0)],
        (1.0, 0.25),
        50.0,
        (
            6.7175471646338116e-43,
            6.8532320410223611e-43,
            6.9916580260248206e-43,
            2.4800506506805573e-46,
        ),
    ),
    (
        [(1e-3, 0.5, 1.0), (10.0, 0.0, 0.1)],
        None,
        20.0,
        (
            -1.6161837900675594e-13,
            -1.699010535121736e-13,
            -1.7860848037278371e-13,
            -4.247535228113661e-16,
        ),
    ),
    (
        [(1e3, -0.5, 1.0), (1.0, 0.45, 2.0), (5.0, 0.2, 0.3)],
        (1e-3, 0.5),
        1.0,
        (
            0.0016609256372583497,
            0.0038366811597408231,
            0.0093293858148117927,
            0.00031230723193340723,
        ),
    ),
    (
        [(1.0, 0.3, 1.0)],
        (1.1, 0.3),
        4.5,
        (
            -4.2405457318629283e-5,
            -5.2709026985438466e-5,
            -6.5588511266489008e-5,
            -2.6118323566944105e-6,
        ),
    ),
]


@pytest.mark.parametrize(("layers", "base", "alpha", "expected"), REMAINDERS)
def test_remainder_keeps_its_digits(layers, base, alpha, expected):
    got = np.array(remainder_scalars(Stack(layers, base), alpha))
    assert np.abs(got - expected).max() < 3e-14 * np.abs(expected).max()


@pytest.mark.parametrize("x", [0.49999, 0.50001])
def test_remainder_is_the_difference_on_both_sides_of_its_switch(x):
    stack = Stack([(3.0, 0.3, 1.0), (0.1, 0.5, 2.0)], (1.0, 0.2))
    difference = np.subtract(scalars(stack, x), half_space_scalars(stack.outer, x))
    np.testing.assert_allclose(np.array(remainder_scalars(stack, x)), difference, rtol=1e-14)


@pytest.mark.parametrize("alpha", [0.0, -1.0, np.nan, np.inf])
def test_wavenumbers_without_a_response_are_refused(alpha):
    with pytest.raises(ValueError, match="positive and finite"):
        scalars(Stack((), (1.0, 0.3)), [1.0, alpha])


def test_rigid_body_does_not_deform():
    rigid = stack_of(Body(material=RIGID))
    assert rigid.is_rigid
    assert not np.any(scalars(rigid, [1.0, 2.0]))
    elastic = Stack((), (1.0, 0.3))
    F = composite_frf_matrix(elastic, rigid, 1.0, 2.0)
    np.testing.assert_array_equal(F, response_matrix(elastic, 1.0, 2.0))


def test_stack_of_a_body_keeps_the_order():
    steel, coating = (
        IsotropicMaterial(young_modulus=200e9, poisson_ratio=0.25),
        IsotropicMaterial(young_modulus=400e9, poisson_ratio=0.0),
    )
    films = (Layer(thickness=1e-6, material=coating), Layer(thickness=2e-6, material=steel))
    body = Body(material=coating, layers=films)
    expected = Stack([(200e9, 0.0, 1e-6), (80e9, 0.25, 2e-6)], (200e9, 0.0))
    assert stack_of(body) == expected


@pytest.mark.parametrize(
    ("layers", "base", "message"),
    [
        ([(1.0, 0.3, -1.0)], (1.0, 0.3), "thickness"),
        ([(1.0, 0.3, np.inf)], (1.0, 0.3), "thickness"),
        ([(0.0, 0.3, 1.0)], (1.0, 0.3), "shear modulus is 0.0"),
        ([], (-1.0, 0.3), "shear modulus is -1.0"),
        ([], (np.nan, 0.3), "shear modulus"),
        ([], (1.0, -1.0), "Poisson's ratio is -1.0"),
        ([], (1.0, 0.51), "Poisson's ratio is 0.51"),
        ([], (1.0, np.nan), "Poisson's ratio"),
    ],
)
def test_impossible_materials_are_named(layers, base, message):
    with pytest.raises(ValueError, match=message):
        Stack(layers, base)


# ---- The laws that any surface FRF obeys


LAWS = {law.name: replace(law, draws=10) for law in SYMMETRY_LAWS + LIMIT_LAWS}


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_law_holds(law: Law) -> None:
    assert worst_violation(law) <= law.allowed


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


@given(stacks(min_layers=1, max_layers=3, bonds=True), st.floats(0.1, 3))
def test_p18_equilibrium_over_the_depth_gives_the_surface_response(stack, x):
    """Integrate equilibrium with continuous traction from the base upward.

    The displacement is continuous, or jumps in proportion to the traction at a compliant bond."""
    alpha = x / sum(film.thickness for film in stack.layers)
    response = np.zeros((2, 2))
    if stack.base is not None:
        c11, c12, c22, _ = half_space_scalars(stack.base, alpha)
        response = np.array([[c11, c12], [c12, c22]])
    for G, nu, h, opening, jump in reversed(stack.layers):
        response = response + np.diag([jump, opening])
        # Unit displacement G / alpha keeps the exponential well scaled.
        scale = np.array([1 / (G * alpha), 1 / (G * alpha), 1, 1])
        system = depth_system(G, nu, alpha) * scale / scale[:, None]
        state = expm(-system * h) @ np.vstack([response * G * alpha, np.eye(2)])
        response = np.linalg.solve(state[2:].T, state[:2].T).T / (G * alpha)
    c11, c12, c22, _ = scalars(stack, alpha)
    assert apart(np.array([[c11, c12], [c12, c22]]), response) <= 1e-8


@given(stacks(min_layers=1, max_layers=2, bonds=True), st.floats(0.01, 30))
def test_a_compliant_bond_is_a_thin_soft_layer(stack, x):
    """Its modulus goes to zero with its thickness: G and E(1-ν)/((1+ν)(1-2ν)) over the thickness
    are the stiffnesses of the bond."""
    thinnest = min(film.thickness for film in stack.layers)
    alpha, thin = np.array([x / thinnest]), 1e-5 * thinnest
    layers = []
    for film in stack.layers:
        both = film.normal_opening, film.tangential_jump
        layers.append(film[:3])
        if all(both):
            # The ratio of both moduli, 2(1-ν)/(1-2ν), exceeds 4/3 if ν is above -1.
            jump = max(film.tangential_jump, 2 * film.normal_opening)
            ratio = jump / film.normal_opening
            layers.append((thin / jump, (ratio - 2) / (2 * ratio - 2), thin))
    bonded = Stack(
        [
            (*film[:4], max(film[4], 2 * film[3])) if all(film[3:]) else film[:3]
            for film in stack.layers
        ],
        stack.base,
    )
    found, expected = (scalars(one, alpha) for one in (bonded, Stack(layers, stack.base)))
    # Squeezed out between stiffer sides, the thin layer errs by the square of its slenderness.
    assert apart(np.array(found), np.array(expected)) <= 1e-2


@given(stacks(min_layers=1, max_layers=3, bonds=True), st.floats(0.01, 10))
def test_displacements_jump_at_bonds_in_proportion_to_the_traction(stack, x):
    alpha = np.array([x / min(film.thickness for film in stack.layers)])
    fields, depth = Descent(stack, alpha), 0.0
    for k, film in enumerate(stack.layers):
        depth += film.thickness
        if k + 1 == len(stack.layers) and stack.base is None:
            break
        above, below = (fields.at(Level(depth, layer)) for layer in (k, k + 1))
        jump = np.diag([film.tangential_jump, film.normal_opening])
        largest = np.max(np.abs(above.displacement)) + 1e-300
        moved = above.displacement[..., 0] - below.displacement[..., 0]
        np.testing.assert_allclose(
            moved / largest, jump @ above.traction[..., 0] / largest, atol=1e-9
        )
        np.testing.assert_allclose(above.traction, below.traction, rtol=0, atol=1e-12)
        across = above.transverse_displacement - below.transverse_displacement
        np.testing.assert_allclose(
            across,
            film.tangential_jump * above.transverse_traction,
            atol=1e-9 * np.max(above.transverse_displacement),
        )
