"""The contact solver on points (r, θ) with finite-element bodies, as `solve` calls it."""

import numpy as np
import pytest
from fem_scenes import elements, solved
from hankel_responses import Coating
from ring_responses import half_space, rings

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.solver_errors import SurfacesOverlap
from fem_reference import Method, solve
from fem_reference.compliance.ring_compliance import ring_compliance
from fem_reference.model import ContactModel
from fem_reference.plan import Path
from verification.observed.ring_tractions import tractions_at
from verification.quantities import shift_along_x

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
HARD = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.2)
FORCE, MU, RADIUS = 1e3, 0.2, 18e-3
FEW = {"harmonics": 3}


def coated(scale=1.0, stiffness=1.0):
    """A hard layer of about the contact radius on steel."""
    hard, soft = (
        IsotropicMaterial(young_modulus=stiffness * m.young_modulus, poisson_ratio=m.poisson_ratio)
        for m in (HARD, STEEL)
    )
    return Body(material=soft, layers=(Layer(thickness=0.3e-3 * scale, material=hard),))


def sheared(*steps, scale=1.0, stiffness=1.0, indenter=None):
    """A rigid ball pressed on the coating in three increments and then led along `steps`."""
    unit = stiffness * scale**2
    return Scene(
        indenter=indenter or Paraboloid(radius=RADIUS * scale, material=RIGID),
        body=coated(scale, stiffness),
        friction=CoulombFriction(coefficient=MU),
        loading=(
            LoadStep(normal_force=FORCE * unit, increments=3),
            *(
                LoadStep(
                    tangential_force=(x * MU * FORCE * unit, y * MU * FORCE * unit), increments=2
                )
                for x, y in steps
            ),
        ),
    )


def along_x():
    return sheared((0.5, 0.0), (-0.2, 0.0))


@pytest.fixture(scope="module")
def result():
    return solved(along_x(), 8, **FEW)


BODIES = {
    "coated": (Paraboloid(radius=1.0, material=RIGID), (Coating(2.0, 0.2, 1.0, 0.3, 0.5),)),
    "dissimilar": (
        Paraboloid(radius=1.0, material=IsotropicMaterial(young_modulus=9.0, poisson_ratio=0.0)),
        (Coating(2.0, 0.2, 1.0, 0.3, 0.5), half_space(0.0)),
    ),
}


@pytest.mark.parametrize("name", BODIES)
def test_compliance_of_rings_is_that_of_hankel_transforms(name):
    """Energies of smooth tractions in every component, n = 0…3; the signs of what mixes shear
    and pressure are those of two bodies pressed together."""
    indenter, known = BODIES[name]
    if len(known) == 2:
        known = (known[0], Coating(4.5, 0.0, 4.5, 0.0, 1.0))
    layer, base = (
        IsotropicMaterial(young_modulus=2 * G * (1 + nu), poisson_ratio=nu)
        for G, nu in ((2.0, 0.2), (1.0, 0.3))
    )
    body = Body(material=base, layers=(Layer(thickness=0.5, material=layer),))
    scene = Scene(indenter=indenter, body=body, loading=(LoadStep(normal_force=1.0),))
    model = ContactModel.of(scene, elements(8), 1.0)
    ours = ring_compliance(model, Path.HARMONICS, 3)
    theirs = rings(8, float(ours.radii[-1]), 3, *known)
    np.testing.assert_allclose(ours.radii, theirs.radii, atol=1e-12)
    np.testing.assert_allclose(ours.areas, theirs.areas, rtol=1e-12)
    r = ours.radii
    inside = np.maximum(1 - r**2, 0.0) ** 2
    for n, (A, exact) in enumerate(zip(ours.harmonics, theirs.harmonics, strict=True)):
        low, high = r ** abs(n - 1) * inside, r ** (n + 1) * inside
        p = r**n * inside
        for t in ((high + low, high - low, 0 * r), (low, -low, p), (0 * r, 0 * r, p)):
            energy, known = (np.einsum("ai,aibk,bk->", t, C, t) for C in (A, exact))
            assert energy == pytest.approx(known, rel=3e-3)


def test_load_in_any_direction_is_the_same_load(result):
    turned = solved(sheared((0.3, 0.4), (-0.12, -0.16)), 8, **FEW)
    assert turned.plan.direction == pytest.approx((0.6, 0.8))
    for a, b in zip(turned.increments, result.increments, strict=True):
        np.testing.assert_allclose(a.pressure, b.pressure, rtol=1e-9)
        assert a.tangential_shift == pytest.approx(
            (0.6 * b.tangential_shift[0], 0.8 * b.tangential_shift[0]), rel=1e-9
        )
        x, y = np.array([0.05e-3, 0.2e-3]), np.array([0.1e-3, -0.05e-3])
        q, p = tractions_at(b, x, y)
        q_turned, p_turned = tractions_at(a, 0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, (0.6, 0.8))
        np.testing.assert_allclose(p_turned, p, rtol=1e-9)
        expected = [0.6 * q[0] - 0.8 * q[1], 0.8 * q[0] + 0.6 * q[1]]
        np.testing.assert_allclose(q_turned, expected, rtol=1e-7, atol=1e-6 * np.max(np.abs(q)))


def test_penalty_does_not_decide_the_answer():
    """On a soft incompressible film springs alone overlap by 7 % of the approach."""
    film = Layer(
        thickness=0.15e-3, material=IsotropicMaterial(young_modulus=2.1e9, poisson_ratio=0.4999)
    )
    scene = Scene(
        indenter=Paraboloid(radius=0.01, material=RIGID),
        body=Body(material=STEEL, layers=(film,)),
        friction=CoulombFriction(coefficient=0.5),
        loading=[
            LoadStep(normal_force=100.0, increments=2),
            LoadStep(tangential_force=(20.0, 0.0), increments=2),
        ],
    )
    exact = solved(scene, 8, **FEW).steps[-1]
    alone = elements(8, augmentations=0, overlap=1.0, **FEW)
    assert solve(scene, alone, Method.PENALTY).steps[-1].overlap > 0.05 * exact.approach
    for factor in (1.0, 10.0):
        result = solve(scene, elements(8, penalty=factor, **FEW), Method.PENALTY)
        assert all(i.overlap <= 1e-3 * i.approach for i in result.increments)
        assert result.increments[0].augmentations > 0
        end = result.steps[-1]
        assert end.approach == pytest.approx(exact.approach, rel=3e-4)
        assert end.peak_pressure == pytest.approx(exact.peak_pressure, rel=1e-3)
        assert shift_along_x(end) == pytest.approx(shift_along_x(exact), rel=1e-3)
    with pytest.raises(SurfacesOverlap, match="after 1 augmentation, allowed"):
        solve(scene, elements(8, augmentations=1, **FEW), Method.PENALTY)
