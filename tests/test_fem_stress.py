"""Tests of the stress by finite elements: surface, interfaces, the indenter, and refusals."""

from dataclasses import replace

import numpy as np
import pytest
from fem_scenes import elements

import slipstick
from contact_errors.stress_errors import largest_stresses
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import state_of_result
from contact_scene import (
    RIGID,
    Body,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    RevolvedProfile,
    Scene,
    SurfaceDiscretisation,
)
from fem_reference.mesh.section_mesh import section_mesh
from fem_reference.stress import SurfaceTractions, subsurface
from fem_reference.stress.recovery import recovery_of

A = 1e-3
P0 = 1e9
MU = 0.3
STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FILM = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.2)
COATED = Body(material=STEEL, layers=(Layer(thickness=0.5 * A, material=FILM),))
RINGS = A * np.sin(np.linspace(0, np.pi / 2, 200))
PRESSURE = P0 * np.cos(np.linspace(0, np.pi / 2, 200))
RR, TT, ZZ, TZ, RZ, RT = range(6)

PRESSED = SurfaceTractions(RINGS, PRESSURE)
OUTWARD = replace(PRESSED, shear_radial=MU * PRESSURE * RINGS / A)
AROUND = replace(PRESSED, shear_circumferential=MU * PRESSURE * RINGS / A)
ALONG = replace(PRESSED, shear_along_load=MU * PRESSURE)


@pytest.mark.parametrize("solver", ["fem", "fem-complementarity"])
def test_the_stress_on_the_axis_of_a_flat_punch_is_that_of_its_force(solver):
    """Sneddon (1946): σ_zz = -p_m/2 (1 + 3ζ²)/(1 + ζ²)², with ζ = z/a and the mean pressure p_m.
    The last Gauss point lies inside the rim, where the pressure is infinite."""
    force = 1e3
    posed = Scene(
        indenter=FlatPunch(radius=A, material=RIGID),
        body=Body(material=STEEL),
        loading=(LoadStep(normal_force=force),),
    )
    result = slipstick.solve(posed, solver, elements(16))
    axis = body_response(state_of_result(result, None)).stress().axis
    deep = axis.depth > 2 * A
    square = (axis.depth[deep] / A) ** 2
    exact = -force / (2 * np.pi * A**2) * (1 + 3 * square) / (1 + square) ** 2
    assert axis.stress[2, deep] == pytest.approx(exact, rel=0.02)


def test_stress_below_a_contact_with_a_hole_has_no_pressure_there():
    """A flat tip on a stiff film of a soft body bears on a ring."""
    r = np.linspace(0.0, 2.5 * A, 401)
    tip = RevolvedProfile(file=np.stack([r, 3e-3 * A * (r / A) ** 6], axis=1), material=RIGID)
    stiff = IsotropicMaterial(young_modulus=4e12, poisson_ratio=0.3)
    film = Layer(thickness=0.3 * A, material=stiff)
    posed = Scene(
        indenter=tip,
        body=Body(material=STEEL, layers=(film,)),
        loading=(LoadStep(normal_force=1e3),),
    )
    names = ["max_principal@layer 1", "von_mises@layer 1", "von_mises@base"]
    cells = slipstick.solve(posed, "semi-analytical", SurfaceDiscretisation(cells=(96, 96)))
    exact = largest_stresses(cells, None, names)
    assert cells.steps[-1].pressure[48, 48] == 0.0
    for solver in ("fem", "fem-complementarity"):
        result = slipstick.solve(posed, solver, elements(32))
        found = largest_stresses(result, None, names)
        for name, (value, _) in exact.items():
            assert found[name][0] == pytest.approx(value, rel=0.02), name


def test_the_force_that_tractions_lack_is_that_of_the_last_three_rings():
    """With the edge resolved between rings, and without: rings beyond it have no pressure."""
    loaded = RINGS[PRESSURE > 0]
    assert PRESSED.extrapolated_from == pytest.approx(loaded[-4])
    assert replace(PRESSED, rooted=True).extrapolated_from == pytest.approx(loaded[-4])


def test_force_that_the_tractions_lack_does_not_act_on_a_ridge_that_just_touches():
    """Beyond a hole, at Gauss points. The tractions of the disc carry 2 % less than the force."""
    rings = A * np.linspace(0.02, 1.58, 40)
    pressure = np.where(rings < A, P0, 0.0)
    pressure[-2:] = 1e-4 * P0
    force = 1.02 * np.pi * A**2 * P0
    touching = SurfaceTractions(rings, pressure, rooted=True, normal_force=force)
    field = subsurface(Body(material=STEEL), touching, elements(16))
    r, z = field.points
    assert np.max(np.abs(field.stress()[ZZ, (z == 0) & (r > 1.3 * A)])) < 0.01 * P0


@pytest.fixture(scope="module", params=[OUTWARD, AROUND, ALONG], ids=["out", "around", "along"])
def coated(request):
    return request.param, subsurface(COATED, request.param, elements(12))


def test_stress_at_the_surface_is_the_traction(
    coated,
):
    tractions, field = coated
    r, z = field.points
    inside = (z == 0) & (r > 0.1 * A) & (r < 0.8 * A)

    def at(traction):
        return np.zeros(inside.sum()) if traction is None else np.interp(r[inside], RINGS, traction)

    along = at(tractions.shear_along_load)
    ahead, across = field.stress(0.0)[:, inside], field.stress(np.pi / 2)[:, inside]
    around = at(tractions.shear_circumferential)
    for found, expected in (
        (ahead[ZZ], -at(PRESSURE)),
        (ahead[RZ], -at(tractions.shear_radial) - along),
        (ahead[TZ], -around),
        (across[TZ], along - around),
    ):
        assert np.max(np.abs(found - expected)) < 0.02 * P0


def test_tractions_are_continuous_across_an_interface_and_the_rest_jumps(
    coated,
):
    _, field = coated
    above, below = (field.interface_points(0.5 * A, material) for material in (0, 1))
    near = field.points[0, above] < 2 * A
    for theta in (0.0, 1.0):
        one, other = (field.stress(theta)[:, side][:, near] for side in (above, below))
        jump = np.abs(one - other) / P0
        assert np.max(jump[[ZZ, RZ, TZ]]) < 0.02
        assert np.max(jump[RR]) > 0.2
        # In-plane strains are continuous: from those below follows the stress above.
        E, nu = STEEL.young_modulus, STEEL.poisson_ratio
        e_rr = (other[RR] - nu * (other[TT] + other[ZZ])) / E
        e_tt = (other[TT] - nu * (other[RR] + other[ZZ])) / E
        E, nu = FILM.young_modulus, FILM.poisson_ratio
        demanded = E / (1 - nu**2) * (e_rr + nu * e_tt) + nu / (1 - nu) * one[ZZ]
        assert np.max(np.abs(one[RR] - demanded)) < 0.02 * P0


def test_the_indenter_carries_the_shear_reversed():
    lower = subsurface(COATED, OUTWARD, elements(8))
    turned = replace(OUTWARD, shear_radial=-OUTWARD.shear_radial)
    upper = subsurface(COATED, turned, elements(8), upper=True)
    np.testing.assert_array_equal(upper.stress(), lower.stress())


def test_the_grid_of_gauss_points_has_an_element_everywhere():
    """Although coordinates of a mesh line differ by round-off from element to element."""
    film = Layer(thickness=1.23, material=IsotropicMaterial(young_modulus=2.0, poisson_ratio=0.3))
    base = IsotropicMaterial(young_modulus=1.0, poisson_ratio=0.3)
    mesh = section_mesh(Body(material=base, layers=[film]), 16).refined()
    assert len(np.unique(mesh.points[0])) > np.sum(mesh.points[1] == 0.0)
    recovery = recovery_of(mesh)
    column, row = (places.ravel() for places in recovery.places)
    elements = np.zeros((recovery.across.shape[1], recovery.down.shape[1]))
    np.add.at(elements, (column, row), 1)
    assert np.all(elements == 1)
