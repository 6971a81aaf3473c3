"""Tests of the finite-element contact solver on points (r, θ): harmonics, laws and limits."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from fem_scenes import elements

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
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import ContactNotResolved, GrossSliding, NotConverged
from contact_solver import dense_inverse
from fem_reference.compliance.angular_grid import (
    AngularGrid,
    axisymmetric_grid,
    end_grid,
    grid_at,
    mid_grid,
    whole_grid,
)
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.compliance.ring_compliance import RingCompliance, ring_compliance
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.increment import advance
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.loads import Loads, NormalTarget, TangentialTarget
from fem_reference.model import ContactModel
from fem_reference.plan import Path

RINGS = 12  # on the contact radius
HIGHEST = 7
TOLERANCE = 1e-8
MU = 0.1
SPRINGS_ALONE = Penalty(augmentations=0, overlap=np.inf)
STEEL, NU_ZERO, FILM, HARD = (
    IsotropicMaterial(young_modulus=2 * G * (1 + nu), poisson_ratio=nu)
    for G, nu in ((1.0, 0.3), (1.0, 0.0), (2.0, 0.3), (3.0, 0.1))
)
COATED = Body(material=STEEL, layers=(Layer(thickness=1.0, material=FILM),))
# Body, and material of the indenter of radius 1.
BODIES = {
    "coated": (COATED, RIGID),
    "dissimilar": (Body(material=STEEL), HARD),
}


@cache
def known(body: Body, indenter, path: Path) -> RingCompliance:
    ball = Paraboloid(radius=1.0, material=indenter)
    scene = Scene(indenter=ball, body=body, loading=(LoadStep(normal_force=1.0),))
    return ring_compliance(ContactModel.of(scene, elements(RINGS), 1.0), path, HIGHEST)


def contact(
    body: Body, indenter=RIGID, mu: float = MU, grid: AngularGrid | None = None, springs=0.0
) -> PointContact:
    grid = grid or end_grid(HIGHEST)
    rings = known(body, indenter, Path.WHOLE_CIRCLE if grid.whole else Path.HARMONICS)
    law = SPRINGS_ALONE if springs else None
    compliance = PointCompliance(rings, grid, springs)
    return PointContact(compliance, CoulombFriction(coefficient=mu), law)


def hertz_force(nu: float) -> float:
    """Force that makes a contact of radius 1 of a rigid ball."""
    return 4 / 3 * 2 / (1 - nu)


def pressed(of: PointContact, force: float, increments: int) -> PointState:
    """Pressed by the force in increments of equal contact radius, and set on the points of `of`."""
    ring = replace(of, compliance=replace(of.compliance, grid=axisymmetric_grid()))
    state = None
    for k in range(1, increments + 1):
        target = NormalTarget(force=force * (k / increments) ** 3)
        state = advance(ring, state, Loads(target), TOLERANCE)
    assert state is not None
    return of.extend_to_points(state)


def along(load: float | None = None, motion: float | None = None) -> TangentialTarget:
    """Force or shift along the load; no shift across, and no twist."""
    return TangentialTarget((load, None, None), (motion, 0.0, 0.0))


def sheared(of: PointContact, state: PointState, *forces: float) -> PointState:
    """Sheared by forces, one increment each, under the normal force of the state."""
    normal = NormalTarget(force=state.normal_force)
    for force in forces:
        state = advance(of, state, Loads(normal, along(load=force)), TOLERANCE)
    return state


def cartesian(grid, vector):
    """x and y components of r and θ components (2, rings, angles)."""
    cos, sin = np.cos(grid.angles), np.sin(grid.angles)
    return vector[0] * cos - vector[1] * sin, vector[0] * sin + vector[1] * cos


GRIDS = (end_grid(2), end_grid(7), mid_grid(2), mid_grid(7), whole_grid(2), whole_grid(7))


def grid_name(grid):
    kind = "whole" if grid.whole else "end" if grid.angles[0] == 0 else "mid"
    return f"{kind}{grid.highest}"


@pytest.mark.parametrize("grid", GRIDS, ids=grid_name)
def test_harmonics_between_points_pass_through_the_point_values(grid):
    again = grid_at(grid.angles)  # as the stress of a stored result finds it
    np.testing.assert_array_equal((*again.angles, again.highest), (*grid.angles, grid.highest))
    values = np.random.default_rng(1).normal(size=(3, 5, grid.points))
    if not grid.whole:
        values[1, :, ~np.any(grid.sines, axis=0)] = 0.0
    modes = grid.modes(grid.angles)
    found = np.einsum("fcrn,fcnk->crk", grid.amplitudes(values), modes)
    np.testing.assert_allclose(found, values, atol=1e-13)


def tractions(compliance):
    """Any that mirror symmetry allows (3, points)."""
    t = np.random.default_rng(2).normal(size=(3, len(compliance.areas)))
    if not compliance.grid.whole:
        rings, _ = compliance.shape
        forbidden = np.tile(~np.any(compliance.grid.sines, axis=0), rings - 1)
        t[1, np.concatenate([[True], forbidden])] = 0.0
    return t


@pytest.mark.parametrize("springs", [0.0, 0.3])
@pytest.mark.parametrize("grid", GRIDS, ids=grid_name)
def test_displacement_by_harmonics_is_that_of_the_matrix(grid, springs):
    compliance = contact(COATED, grid=grid, springs=springs).compliance
    t = tractions(compliance)
    u_t, u_z = compliance.displacement(t[2], t[:2])
    found, given = (
        np.stack([*compliance.vector_on_grid(v[:2]), compliance.scalar_on_grid(v[2])])[:, 1:]
        for v in (np.stack([*u_t, u_z]), t)
    )
    rings = compliance.rings
    loads = np.stack([*compliance.vector_on_grid(t[:2]), compliance.scalar_on_grid(t[2])])
    weak = np.einsum(
        "naibk,fbkn->fain", rings.harmonics[: grid.highest + 1], grid.amplitudes(loads)
    )
    by_harmonics = np.einsum("fain,fanj->aij", weak, grid.modes(grid.angles))
    by_harmonics = (by_harmonics / rings.areas[:, None])[:, 1:] + springs * given
    np.testing.assert_allclose(found, by_harmonics, atol=1e-12 * np.max(found))


@pytest.mark.parametrize("grid", GRIDS, ids=grid_name)
def test_shear_along_has_the_resultant_of_its_profile(grid):
    compliance = contact(COATED, grid=grid).compliance
    f = np.random.default_rng(3).normal(size=compliance.shape[0])
    q = f[compliance.ring_of_point] * compliance.motions[0]
    resultant = compliance.tangential_loads(q)[0]
    assert resultant == pytest.approx(2 * np.pi * np.sum(compliance.rings.areas * f), rel=1e-13)
    q_x, q_y = cartesian(grid, compliance.vector_on_grid(q))
    np.testing.assert_allclose(q_x, f[:, None] + 0 * q_x, atol=1e-14)
    np.testing.assert_allclose(q_y, 0 * q_y, atol=1e-14)


@pytest.fixture(scope="module", params=BODIES)
def coupled(request):
    of = contact(*BODIES[request.param])
    return of, pressed(of, hertz_force(0.3), 5)


def test_force_and_displacement_lead_to_the_same_state(coupled):
    of, start = coupled
    by_force = advance(
        of,
        start,
        Loads(
            NormalTarget(force=1.1 * start.normal_force), along(load=0.6 * MU * start.normal_force)
        ),
        1e-10,
    )
    by_motion = advance(
        of,
        start,
        Loads(NormalTarget(approach=by_force.approach), along(motion=by_force.motions[0])),
        1e-10,
    )
    np.testing.assert_allclose(by_motion.pressure, by_force.pressure, atol=1e-9)
    np.testing.assert_allclose(by_motion.shear, by_force.shear, atol=1e-9)


def test_coupling_has_the_sign_of_the_closed_form(coupled):
    """Friction resists the surface that pressure pulls inwards: it points outwards on the softer
    body, and less load is needed without it."""
    of, state = coupled
    q_r = of.compliance.vector_on_grid(state.shear)[0, :, 0]
    assert np.min(q_r) > -1e-9
    assert np.max(q_r) > 0.5 * MU


@pytest.mark.parametrize("mu", [1.0, 2.0, 3.0])
def test_strong_coupling_converges(mu):
    """µ|β| = 1 and beyond, where plain turns between pressure and shear do not."""
    of = contact(Body(material=NU_ZERO), mu=mu)
    state = pressed(of, hertz_force(0.0), 3)
    state = sheared(of, state, *(part * mu * state.normal_force for part in (0.2, 0.5, 0.9)))
    assert state.residuals.worst <= TOLERANCE


def test_singular_equations_are_an_increment_that_does_not_converge(monkeypatch):
    def singular(*_, **__):
        raise np.linalg.LinAlgError("singular")

    monkeypatch.setattr(dense_inverse, "cho_factor", singular)
    monkeypatch.setattr(dense_inverse, "lu_factor", lambda matrix, **_: (0 * matrix, None))
    force, of = hertz_force(0.3), contact(COATED, mu=0.3)
    loads = Loads(NormalTarget(force=force), along(load=0.18 * force))
    with pytest.raises(NotConverged):
        advance(of, None, loads, TOLERANCE)


def test_approach_that_touches_no_point_is_refused():
    of = contact(COATED)
    short = NormalTarget(approach=0.5 * np.min(of.gap))
    with pytest.raises(ContactNotResolved):
        advance(of, None, Loads(short, along(motion=0.1)), TOLERANCE)


def test_force_beyond_the_friction_limit_is_refused(coupled):
    of, state = coupled
    with pytest.raises(GrossSliding, match="exceeds the friction limit"):
        sheared(of, state, 1.001 * MU * state.normal_force)


def test_at_the_friction_limit_all_shear_is_along_the_load(coupled):
    of, state = coupled
    state = sheared(of, state, MU * state.normal_force)
    grid = of.compliance.grid
    q_x, q_y = cartesian(grid, of.compliance.vector_on_grid(state.shear))
    p = of.compliance.scalar_on_grid(state.pressure)
    np.testing.assert_allclose(q_x, MU * p, atol=1e-12)
    assert np.max(np.abs(q_y)) < 1e-12
    assert state.status is ContactStatus.GROSS_SLIDING
    assert state.motions is None
    with pytest.raises(GrossSliding, match="prescribe the shift or twist"):
        sheared(of, state, 0.5 * MU * state.normal_force)


def test_an_error_of_increments_is_the_same_with_angles_and_without():
    of = contact(COATED)
    state = pressed(of, hertz_force(0.3), 5)
    loads = Loads(NormalTarget(force=2.0 * state.normal_force))
    ring = replace(of, compliance=replace(of.compliance, grid=axisymmetric_grid()))
    before = pressed(ring, hertz_force(0.3), 5)
    at_rings, at_points = advance(ring, before, loads, 1e-10), advance(of, state, loads, 1e-10)
    assert at_points.friction_changed == pytest.approx(at_rings.friction_changed, rel=1e-7)
    changed, slipped = at_rings.shear - before.shear, at_rings.slip - before.slip
    by_hand = np.sum(ring.compliance.areas * np.hypot(*changed) * np.hypot(*slipped))
    assert 0 < by_hand == pytest.approx(at_rings.friction_changed)
