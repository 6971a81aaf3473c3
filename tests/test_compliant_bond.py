"""Tests of layers whose bond to the material below is compliant."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from stack_strategies import stacks

import slipstick
from contact_scene import (
    Body,
    InterfaceStiffness,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.normal_form import normal_form
from semi_analytical.frf.depth import Descent, Level
from semi_analytical.frf.surface import half_space_scalars, scalars
from verification.laws.limit_laws import apart

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
HARD = IsotropicMaterial(young_modulus=400e9, poisson_ratio=0.25)
BOND = InterfaceStiffness(normal=4e15, shear=1e15)


def scene(*layers: Layer) -> Scene:
    return Scene(
        indenter=Paraboloid(radius=10e-3, material="rigid"),
        body=Body(material=STEEL, layers=layers),
        loading=[LoadStep(normal_force=100.0)],
    )


def test_layers_merge_through_rigid_bonds_alone():
    glued = Layer(thickness=100e-6, material=STEEL, interface_stiffness=BOND)
    plain = Layer(thickness=50e-6, material=STEEL)
    assert normal_form(scene(plain, plain)).body.layers == ()
    (merged,) = normal_form(scene(plain, glued)).body.layers
    assert merged.thickness == pytest.approx(150e-6)
    assert merged.interface_stiffness == BOND
    assert normal_form(scene(glued, plain)).body.layers == (glued,)
    assert scene(glued, plain).body.thinnest == 100e-6
    assert scene(plain, glued).body.thinnest == pytest.approx(150e-6)


def test_a_bond_without_stiffness_is_rigid():
    layer = Layer(thickness=1e-4, material=HARD, interface_stiffness={})
    assert layer.interface_stiffness is None


def test_stiffnesses_have_units_and_stiff_bonds_are_no_contrast():
    """A bond far stiffer than its layer is solved as a rigid one."""
    stiff = InterfaceStiffness.model_validate({"normal": "1e16 N/mm^3", "shear": "1e10 GPa/um"})
    assert stiff.given == (1e25, 1e25)
    layer = Layer(thickness=100e-6, material=HARD, interface_stiffness=stiff)
    plain = Layer(thickness=100e-6, material=HARD)
    ends = [slipstick.solve(scene(one), "radial").steps[0] for one in (layer, plain)]
    assert ends[0].approach == pytest.approx(ends[1].approach, rel=1e-9)


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
def test_equilibrium_over_the_depth_gives_the_surface_response(stack, x):
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
